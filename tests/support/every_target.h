// Runs checks with the vector kernels held to one instruction set after the other.
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace skybake::test {

// Calls check(name) for each instruction set that this machine has and kernels are compiled for.
// With any other one, Highway takes the scalar kernels, which are among these.
template <class Check>
void on_every_target(const Check& check) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        check(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(0);
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace skybake::test
