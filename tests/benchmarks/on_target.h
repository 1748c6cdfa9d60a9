// Benchmarks of kernels that are held to one instruction set.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>

#include "tests/support/every_target.h"

namespace skybake {

template <class Work>
void on_target(benchmark::State& state, std::int64_t target, const Work& work) {
    if ((hwy::SupportedTargets() & target) == 0) return state.SkipWithError("no such processor");
    test::on_target(target, work);
}

}  // namespace skybake
