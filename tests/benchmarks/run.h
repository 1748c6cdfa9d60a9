// Runs the benchmarks that a program registers, with memory as the program has it.
#pragma once

#include <benchmark/benchmark.h>

#include "bakers/math/memory.h"

namespace skybake {

inline int run_benchmarks(int argc, char** argv, void (*register_all)()) {
    keep_freed_memory();
    register_all();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

}  // namespace skybake
