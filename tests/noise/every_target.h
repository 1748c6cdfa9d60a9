// The vector kernels on every instruction set of the machine, held against the specification.
#pragma once

#include <fmt/format.h>
#include <hwy/targets.h>

#include <string>

#include "tests/noise/noises.h"

namespace skybake::test {

// Calls check(name) with the kernels held to one instruction set after the other.
template <class Check>
void on_every_target(const Check& check) {
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        const std::int64_t target = left & -left;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        check(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(0);
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

inline int target_count() {
    return std::popcount(static_cast<std::uint64_t>(hwy::SupportedTargets()));
}

// Values that differ in a bit, and words on the first of them.
struct Mismatches {
    std::int64_t count = 0;
    std::string first;

    void compare(const Planes& made, const Planes& wanted, const VoxelBox& box,
                 const std::string& by) {
        for (std::size_t c = 0; c < wanted.size(); ++c) {
            for (std::size_t i = 0; i < wanted[c].size(); ++i) {
                if (same_bits(made[c][i], wanted[c][i])) continue;
                ++count;
                if (!first.empty()) continue;
                const auto at = static_cast<int>(i);
                first = fmt::format("{}: channel {} voxel {} {} {} of box {} {} {}: {} for {}", by,
                                    c, box.origin[0] + at % box.size[0],
                                    box.origin[1] + at / box.size[0] % box.size[1],
                                    box.origin[2] + at / box.size[0] / box.size[1], box.size[0],
                                    box.size[1], box.size[2], made[c][i], wanted[c][i]);
            }
            for (std::size_t i = wanted[c].size(); i < made[c].size(); ++i) {
                if (same_bits(made[c][i], kCanary)) continue;
                ++count;
                if (first.empty()) first = fmt::format("{}: wrote beyond the box", by);
            }
        }
    }
};

// Holds a box of the noise, as NoiseField makes it, to noise_at on every instruction set.
inline Mismatches unlike_specification(const noise::NoisePlan& plan, const VoxelBox& box) {
    const noise::NoiseField field(plan);
    const Planes wanted = specified(plan, box);
    Mismatches mismatches;
    on_every_target([&](const char* name) {
        mismatches.compare(filled_with_canaries(field, box, plan.output_channels()), wanted, box,
                           name);
    });
    return mismatches;
}

}  // namespace skybake::test
