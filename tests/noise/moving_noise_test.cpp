// Noise that loops in time and drifts with the wind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bakers/math/quadrature.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/noise_reference.h"
#include "tests/noise/every_target.h"

namespace skybake::noise {
namespace {

const std::vector<test::Frequency> kOctaves = {{4, 4, 4}, {9, 5, 7}};
constexpr std::array<int, 3> kSize = {24, 17, 9};

std::vector<Noise> all_kinds() {
    std::vector<Noise> noises = test::noises_of_all_kinds(kOctaves);
    noises.push_back(
        test::noise_of({test::alligator(kOctaves), test::displaced(test::alligator(kOctaves), 0.1),
                        test::displaced(test::perlin(kOctaves), 0.1),
                        test::displaced(test::worley(kOctaves), 0.1)}));
    return noises;
}

Noise at_time(Noise noise, int period, int time, int cells = 4) {
    noise.period = period;
    noise.time = time;
    noise.time_cells = cells;
    return noise;
}

test::Planes frame(const Noise& noise) { return test::whole(noise, kSize); }

TEST(MovingNoise, EqualsTheSpecificationOnEveryTarget) {
    for (Noise noise : all_kinds()) {
        noise.drift = {1, -2, 3};
        for (const std::array<int, 3>& size : {std::array{33, 20, 11}, {32, 16, 16}, {3, 2, 1}}) {
            test::expect_specified(at_time(noise, 7, 3, 2), size, {{}, size});
        }
    }
}

// Frames outside the loop are repeats, also of a loop of one frame, of more cells than frames, and
// where the wind carries the noise on.
TEST(MovingNoise, RepeatsAfterItsPeriodBitForBit) {
    for (Noise noise : all_kinds()) {
        noise.drift = {1, -2, 0};
        for (const auto& [period, cells] : {std::pair{1, 1}, {7, 2}, {48, 3}, {5, 16}}) {
            for (const int time : {0, 3, 4}) {
                const test::Planes first = frame(at_time(noise, period, time, cells));
                for (const int loops : {1, -1, 1000000}) {
                    EXPECT_EQ(frame(at_time(noise, period, time + loops * period, cells)), first);
                }
            }
        }
    }
}

TEST(MovingNoise, StandsStillInALoopOfOneFrameOnly) {
    for (const Noise& noise : all_kinds()) {
        EXPECT_EQ(frame(at_time(noise, 1, 0)), frame(at_time(noise, 1, 17)));
        const test::Planes first = frame(at_time(noise, 8, 0));
        const test::Planes later = frame(at_time(noise, 8, 3));
        for (std::size_t c = 0; c < first.size(); ++c) {
            EXPECT_GT(test::rms_difference(first[c], later[c]), 0.05) << c;
        }
    }
}

// A hundredth of the time makes a hundredth of the difference.
TEST(MovingNoise, IsContinuousInTime) {
    for (const Noise& noise : all_kinds()) {
        const test::Planes from = frame(at_time(noise, 4000, 900));
        const test::Planes near = frame(at_time(noise, 4000, 901));
        const test::Planes far = frame(at_time(noise, 4000, 1000));
        for (std::size_t c = 0; c < from.size(); ++c) {
            const double ratio =
                test::rms_difference(from[c], far[c]) / test::rms_difference(from[c], near[c]);
            EXPECT_GT(ratio, 30) << c;
            EXPECT_LT(ratio, 130) << c;
        }
    }
}

// From frame to frame, and from the last to the first, the change is about the same: nothing pops.
TEST(MovingNoise, ChangesSteadilyAllAround) {
    constexpr int kPeriod = 32;
    std::vector<Noise> noises = all_kinds();
    noises.push_back(test::noise_of({test::curl(kOctaves, config::CurlComponent::z)}));
    for (Noise noise : noises) {
        noise.drift = {1, 0, 0};
        const test::Planes first = frame(at_time(noise, kPeriod, 0));
        std::vector<double> mean(first.size()), largest(first.size());
        test::Planes here = first;
        for (int time = 1; time <= kPeriod; ++time) {
            const test::Planes next = time < kPeriod ? frame(at_time(noise, kPeriod, time)) : first;
            for (std::size_t c = 0; c < first.size(); ++c) {
                const double change = test::rms_difference(here[c], next[c]);
                mean[c] += change / kPeriod;
                largest[c] = std::max(largest[c], change);
            }
            here = next;
        }
        for (std::size_t c = 0; c < first.size(); ++c) {
            EXPECT_LT(largest[c], 1.6 * mean[c]) << static_cast<int>(noise.channels[c].type);
            RecordProperty("largest_over_mean", std::to_string(largest[c] / mean[c]));
        }
    }
}

// The first frame of cellular noise is the noise that stands still, whose points have not moved.
TEST(MovingNoise, OfCellsBeginsWithTheNoiseThatStandsStill) {
    const Noise noise = test::noise_of({test::worley(kOctaves), test::alligator(kOctaves)});
    EXPECT_EQ(frame(at_time(noise, 48, 0)), frame(noise));
}

// No part of a loop is played twice, whatever the cells along time: all frames are far from the first but
// its neighbours.
TEST(MovingNoise, PlaysALoopOnce) {
    constexpr int kPeriod = 24;
    for (const int cells : {2, 4, 6, 8}) {
        for (const Noise& noise :
             {test::noise_of({test::worley({{8, 8, 8}}), test::alligator({{8, 8, 8}})}),
              test::noise_of({test::worley(kOctaves), test::perlin(kOctaves)})}) {
            const test::Planes first = frame(at_time(noise, kPeriod, 0, cells));
            for (int time = 3; time <= kPeriod - 3; ++time) {
                const test::Planes later = frame(at_time(noise, kPeriod, time, cells));
                for (std::size_t c = 0; c < first.size(); ++c) {
                    EXPECT_GT(test::rms_difference(first[c], later[c]), 0.03)
                        << c << " at " << time << " of " << cells << " cells";
                }
            }
        }
    }
}

// Octaves whose cells are 8 times smaller change 4 times as much in a short time, for their size 8^(2/3).
TEST(MovingNoise, TurnsSmallEddiesOverFaster) {
    for (const Noise& both :
         {test::noise_of({test::worley({{2, 2, 2}}), test::worley({{16, 16, 16}})}),
          test::noise_of({test::alligator({{2, 2, 2}}), test::alligator({{16, 16, 16}})})}) {
        const auto at = [&](int time) {
            return test::whole(at_time(both, 1000, time, 4), {64, 64, 64});
        };
        const test::Planes here = at(300), next = at(301);
        const double coarse = test::rms_difference(here[0], next[0]);
        EXPECT_NEAR(test::rms_difference(here[1], next[1]) / coarse, 4, 1);
    }
}

// --- Points of cells ----------------------------------------------------------------------------

// A point moves at constant speed between the faces of its cell: over a path its offset is equally
// distributed, the places of a path are those of the path backwards, and the path closes.
TEST(CellPath, GoesToAndFroAtConstantSpeed) {
    const RowKey row = row_key(octave_key(1, 2, Purpose::cells, {8, 8, 8}), 3, 4);
    constexpr int kSteps = 1 << 10;
    constexpr std::uint32_t kStep = kPathSteps / kSteps;
    int forwards = 0;
    for (std::uint32_t x = 0; x < 64; ++x) {
        double mean = 0;
        for (int i = 0; i < kSteps; ++i) {
            const auto shift = static_cast<std::uint32_t>(i) * kStep;
            const std::uint32_t then = (shift + kStep) % kPathSteps;
            const double here = cell_point(row, x, {shift, shift}).x;
            const double next = cell_point(row, x, {then, then}).x;
            EXPECT_GE(here, 0);
            EXPECT_LT(here, 1);
            mean += here / kSteps;
            const double moved = std::fabs(next - here);
            const bool turns =
                std::min(here, next) < 2.0 / kSteps || std::max(here, next) > 1 - 2.0 / kSteps;
            if (!turns) {
                EXPECT_NEAR(moved, 2.0 / kSteps, 1e-6);
            }
            if (i == 0 && !turns && next > here) ++forwards;
        }
        EXPECT_NEAR(mean, 0.5, 1e-3);
        EXPECT_EQ(cell_point(row, x).height, cell_point(row, x, {kStep, kStep}).height);
    }
    EXPECT_NEAR(forwards, 32, 16) << "half of them begin one way";
}

// --- Wind ---------------------------------------------------------------------------------------

// A quarter of a loop carries a noise that drifts by a tile a quarter of a tile on: voxels have the
// values of the same frame without wind that were a quarter of a tile behind.
TEST(Drift, CarriesValuesAlong) {
    for (const Noise& noise : all_kinds()) {
        for (const int tiles : {1, -1, 3}) {
            Noise windy = at_time(noise, 12, 3, 2);
            windy.drift = {tiles, 0, 2};
            const NoisePlan still = make_noise_plan(at_time(noise, 12, 3, 2), {8, 5, 6});
            const NoisePlan carried = make_noise_plan(windy, {8, 5, 6});
            for (int i = 0; i < 60; ++i) {
                const Voxel voxel = {i % 8, i % 5, i % 6};
                const Voxel behind = {voxel[0] - 2 * tiles, voxel[1], voxel[2] - 3};
                EXPECT_EQ(noise_at(carried, voxel), noise_at(still, behind)) << i;
            }
        }
    }
}

// A third of a tile per frame of 8 voxels does not fall on voxels; the reference has it, too.
TEST(Drift, FallsBetweenVoxels) {
    Noise noise = at_time(test::noise_of({test::perlin(kOctaves)}), 3, 1);
    const Noise calm = noise;
    noise.drift = {1, 0, 0};
    const NoisePlan plan = make_noise_plan(noise, {8, 5, 6});
    for (int i = 0; i < 40; ++i) {
        const Voxel voxel = {i % 8, i % 5, i % 6};
        std::array<double, 3> place = test::place_of(plan.axes, voxel);
        EXPECT_NEAR(noise_at(plan, voxel)[0], noise_reference(noise, place)[0], 2e-6);
        place[0] -= 1.0 / 3;
        EXPECT_NEAR(noise_reference(noise, test::place_of(plan.axes, voxel))[0],
                    noise_reference(calm, place)[0], 1e-12);
    }
}

// --- Statistics over the loop -------------------------------------------------------------------

double deviation(const std::vector<float>& values) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0;
    for (const float value : values) squares += (value - mean) * (value - mean) / count;
    return std::sqrt(squares);
}

// Over a cell along time the noises' deviations stay what they are: points are equally distributed at
// all times, and gradients make up for being blended by their own component along time.
TEST(MovingNoise, LooksAlikeAtAllTimes) {
    const Noise noise =
        test::noise_of({test::worley({{16, 16, 16}}), test::alligator({{16, 16, 16}}),
                        test::perlin({{16, 16, 16}})});
    std::array<std::array<double, 2>, 3> ranges;
    for (auto& range : ranges) range = {1e9, 0};
    for (int time = 0; time < 8; ++time) {
        const test::Planes planes = test::whole(at_time(noise, 32, time), {64, 64, 64});
        for (std::size_t c = 0; c < 3; ++c) {
            const double here = deviation(planes[c]);
            ranges[c] = {std::min(ranges[c][0], here), std::max(ranges[c][1], here)};
        }
    }
    for (const auto& [least, most] : ranges) EXPECT_LT(most / least, 1.05);
}

}  // namespace
}  // namespace skybake::noise
