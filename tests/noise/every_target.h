// The vector kernels of noise on every instruction set, held against the specification.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/noise/noises.h"
#include "tests/support/every_target.h"

namespace skybake::test {

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

// Expects no difference, and returns how many there are.
inline std::int64_t expect_specified(const noise::NoisePlan& plan, const VoxelBox& box) {
    const Mismatches mismatches = unlike_specification(plan, box);
    EXPECT_EQ(mismatches.count, 0) << mismatches.first;
    return mismatches.count;
}

inline std::int64_t expect_specified(const config::Noise& noise, const std::array<int, 3>& size,
                                     const VoxelBox& box) {
    return expect_specified(noise::make_noise_plan(noise, size), box);
}

}  // namespace skybake::test
