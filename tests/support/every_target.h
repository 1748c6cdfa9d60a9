// Runs checks with the vector kernels held to one instruction set after the other.
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace skybake::test {

// Does some work with the kernels held to one instruction set.
template <class Work>
void on_target(std::int64_t target, const Work& work) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    work();
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// Calls check(name) for each instruction set that this machine has and kernels are compiled for.
// With any other one, Highway takes the scalar kernels, which are among these.
template <class Check>
void on_every_target(const Check& check) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        on_target(target, [&] { check(hwy::TargetName(target)); });
    }
}

}  // namespace skybake::test
