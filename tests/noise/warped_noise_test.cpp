// Alligator noise, noise that is displaced, and the vector noise that displaces it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "bakers/math/quadrature.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/noise_reference.h"
#include "tests/noise/every_target.h"
#include "tests/noise/perlin_2002.h"

namespace skybake::noise {
namespace {

using config::CurlComponent;
using config::NoiseWarp;

const std::vector<test::Frequency> kOctaves = {{4, 4, 4}, {9, 5, 7}};

// --- Alligator noise ----------------------------------------------------------------------------

// The definition for one cell per tile, whose point and its periodic images are all there is: the
// two nearest images have the greatest bumps, as all have one height.
TEST(Alligator, OfOnePointIsTheDifferenceOfItsNearestImages) {
    const CellPoint point =
        cell_point(row_key(octave_key(7, 0, Purpose::alligator, {1, 1, 1}), 0, 0), 0);
    ASSERT_GT(point.height, 0);
    const Noise noise = test::noise_of({test::alligator({{1, 1, 1}})});
    double greatest = 0;
    for (int i = 0; i < 500; ++i) {
        const std::array<double, 3> place = low_discrepancy_point(i);
        std::vector<double> distances;
        for (int image = 0; image < 125; ++image) {
            distances.push_back(std::hypot(image % 5 - 2 + double{point.x} - place[0],
                                           image / 5 % 5 - 2 + double{point.y} - place[1],
                                           image / 25 - 2 + double{point.z} - place[2]));
        }
        std::sort(distances.begin(), distances.end());
        const auto bump = [&](double distance) {
            const double t = std::max(0.0, 1 - distance);
            return point.height * t * t * (3 - 2 * t);
        };
        const double wanted = bump(distances[0]) - bump(distances[1]);
        EXPECT_NEAR(noise_reference(noise, place)[0], wanted, 1e-12) << i;
        greatest = std::max(greatest, wanted);
    }
    EXPECT_GT(greatest, 0.1 * point.height) << "there was something to see";
}

// At a point of cells the bump has the point's height, less the bumps of others.
TEST(Alligator, IsAtMostTheHeightOfItsPoint) {
    const std::uint64_t key = octave_key(7, 0, Purpose::alligator, {5, 5, 5});
    const Noise noise = test::noise_of({test::alligator({{5, 5, 5}})});
    int alone = 0;
    testing::for_each_voxel({5, 5, 5}, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const CellPoint point = cell_point(row_key(key, y, z), x);
        const double found = noise_reference(
            noise,
            {(x + double{point.x}) / 5, (y + double{point.y}) / 5, (z + double{point.z}) / 5})[0];
        EXPECT_GE(found, 0);
        EXPECT_LE(found, 1);
        alone += std::fabs(found - point.height) < 1e-9 ? 1 : 0;
    });
    EXPECT_GT(alone, 0) << "a point that no other bump reaches";
}

// The definition with points and heights of the standard library's random numbers: mean and
// quantiles of a tile are those of any such points.
double any_alligator(std::mt19937& random) {
    const auto unit = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
    const std::array<double, 3> place = {1 + unit(), 1 + unit(), 1 + unit()};
    std::array<double, 2> bumps = {0, 0};
    for (int cell = 0; cell < 27; ++cell) {
        const double distance =
            std::hypot(cell % 3 + unit() - place[0], cell / 3 % 3 + unit() - place[1],
                       cell / 9 + unit() - place[2]);
        const double t = std::max(0.0, 1 - distance);
        const double bump = unit() * (3 * t * t - 2 * t * t * t);
        bumps = bump > bumps[0] ? std::array{bump, bumps[0]}
                                : std::array{bumps[0], std::max(bumps[1], bump)};
    }
    return bumps[0] - bumps[1];
}

TEST(Alligator, HasTheStatisticsOfItsDefinition) {
    std::vector<float> values =
        test::whole(test::noise_of({test::alligator({{12, 12, 12}})}), {48, 48, 48})[0];
    std::mt19937 random(5);
    std::vector<double> wanted;
    for (int i = 0; i < 40000; ++i) wanted.push_back(any_alligator(random));
    std::sort(values.begin(), values.end());
    std::sort(wanted.begin(), wanted.end());
    for (const double share : {0.1, 0.25, 0.5, 0.75, 0.9, 0.99}) {
        const auto quantile = [&](const auto& sorted) {
            return double{sorted[static_cast<std::size_t>(share * double(sorted.size() - 1))]};
        };
        EXPECT_NEAR(quantile(values), quantile(wanted), 0.02) << share;
    }
    EXPECT_EQ(values.front(), 0) << "on the borders between bumps";
}

TEST(Alligator, EqualsTheSpecificationOnEveryTarget) {
    const Noise noise =
        test::noise_of({test::alligator(kOctaves), test::displaced(test::alligator(kOctaves), 0.13),
                        test::displaced(test::alligator({{1, 1, 1}}), 0.3),
                        test::displaced(test::alligator({{40, 3, 1}}), 0.1, NoiseWarp::gradient)});
    for (const std::array<int, 3> size : {std::array{33, 20, 11}, {32, 16, 16}, {3, 1, 1}}) {
        test::expect_specified(make_noise_plan(noise, size), {{}, size});
    }
}

// --- Displaced noise ----------------------------------------------------------------------------

std::vector<NoiseChannel> all_that_may_be_displaced() {
    NoiseChannel curly = test::alligator(kOctaves);
    curly.type = NoiseType::curly_alligator;
    return {test::perlin(kOctaves),
            test::perlin(kOctaves, config::NoiseFractal::ridged),
            test::worley(kOctaves),
            test::worley(kOctaves, config::WorleyFeature::f2_minus_f1),
            test::channel_of(NoiseType::perlin_worley, kOctaves),
            curly};
}

// A displacement of 0 changes no bit; one of a ten-millionth of a tile moves values by less than the
// steepest slope times it and the rounding of the two ways to fill a box.
TEST(Warp, OfNoStrengthIsThePlainNoise) {
    for (const NoiseChannel& channel : all_that_may_be_displaced()) {
        NoiseChannel plain = channel;
        if (plain.type == NoiseType::curly_alligator) plain.type = NoiseType::alligator;
        const std::array<int, 3> size = {19, 16, 9};
        const test::Planes still = test::whole(test::noise_of({plain}), size);
        EXPECT_EQ(test::whole(test::noise_of({test::displaced(channel, 0)}), size), still);
        const test::Planes moved =
            test::whole(test::noise_of({test::displaced(channel, 1e-7)}), size);
        EXPECT_LT(test::largest_difference(moved[0], still[0]), 3e-5);
        const test::Planes curled =
            test::whole(test::noise_of({test::displaced(channel, 0.1)}), size);
        EXPECT_GT(test::largest_difference(curled[0], still[0]), 0.1) << "it displaces";
    }
}

// The vector noise of one octave by its definition.
test::Place vector_noise(NoiseWarp by, const test::Frequency& frequency, const test::Place& place) {
    using enum Purpose;
    const std::array<Purpose, 3> purposes = {warp_x, warp_y, warp_z};
    if (by == NoiseWarp::curl) return test::curl_of_perlin_2002(purposes, frequency, place);
    test::Place vector;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        vector[axis] =
            test::perlin_2002(octave_key(7, 0, purposes[axis], frequency), frequency, place);
    }
    return vector;
}

TEST(Warp, ReadsThePlainNoiseElsewhere) {
    constexpr double kStrength = 0.2;
    const test::Frequency frequency = {3, 2, 4};
    const NoiseChannel plain = test::worley({{3, 4, 5}});
    for (const NoiseWarp by : {NoiseWarp::gradient, NoiseWarp::curl}) {
        NoiseChannel displaced = test::displaced(plain, kStrength, by);
        displaced.warp_octaves = test::octaves_of({frequency});
        double farthest = 0;
        for (int i = 0; i < 100; ++i) {
            const std::array<double, 3> place = low_discrepancy_point(i);
            const std::array<double, 3> by_how_much = vector_noise(by, frequency, place);
            std::array<double, 3> elsewhere = place;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                elsewhere[axis] += kStrength * by_how_much[axis];
                farthest = std::max(farthest, std::fabs(kStrength * by_how_much[axis]));
            }
            EXPECT_NEAR(noise_reference(test::noise_of({displaced}), place)[0],
                        noise_reference(test::noise_of({plain}), elsewhere)[0], 1e-5)
                << i;
        }
        EXPECT_GT(farthest, 0.1);
    }
}

// The displacement is a float, 2^-24 of up to half a tile, that octaves of f cells per tile magnify:
// largest errors of a tile against the reference, and their root mean square.
TEST(Warp, IsAsNearToTheReferenceAsItsDisplacement) {
    for (const double strength : {0.05, 0.5, 16.0}) {
        for (const NoiseChannel& channel : all_that_may_be_displaced()) {
            const Noise noise = test::noise_of({test::displaced(channel, strength)});
            const std::array<int, 3> size = {16, 15, 9};
            const NoisePlan plan = make_noise_plan(noise, size);
            double largest = 0;
            double squares = 0;
            for (int i = 0; i < 16 * 15 * 9; ++i) {
                const Voxel voxel = {i % 16, i / 16 % 15, i / 240};
                const double error = noise_at(plan, voxel)[0] -
                                     noise_reference(noise, test::place_of(plan.axes, voxel))[0];
                largest = std::max(largest, std::fabs(error));
                squares += error * error;
            }
            // Slopes of curls are up to 7.5 per cell of 7; noises' up to 4 per cell of 9.
            const double bound = 2e-6 + strength * 9 * 4 * 8 * 0x1p-24;
            EXPECT_LT(largest, bound) << strength;
            EXPECT_LT(std::sqrt(squares / (16 * 15 * 9)), bound / 8) << strength;
        }
    }
}

// --- Laws of tiles ------------------------------------------------------------------------------

TEST(Warp, RepeatsBitForBit) {
    for (const NoiseChannel& channel : all_that_may_be_displaced()) {
        const NoisePlan plan =
            make_noise_plan(test::noise_of({test::displaced(channel, 0.7)}), {7, 12, 5});
        for (int i = 0; i < 40; ++i) {
            const Voxel near = {i % 7, i % 12, i % 5};
            const Voxel far = {near[0] - 21, near[1] + 12, near[2] + 500};
            EXPECT_TRUE(test::same_bits(noise_at(plan, near)[0], noise_at(plan, far)[0]));
        }
    }
}

// The mean over a tile of a derivative along the tile is 0; sums over the midpoints of voxels are as
// near to it as quadrature of a function that is twice differentiable, but for jumps of its third
// derivative.
TEST(CurlNoise, HasAMeanOfZero) {
    for (const CurlComponent component : {CurlComponent::x, CurlComponent::y, CurlComponent::z}) {
        const std::vector<float> values =
            test::whole(test::noise_of({test::curl({{2, 3, 2}}, component)}), {48, 48, 48})[0];
        const double sum = std::accumulate(values.begin(), values.end(), 0.0);
        double squares = 0;
        for (const float value : values) squares += double{value} * value;
        const auto count = static_cast<double>(values.size());
        EXPECT_GT(squares / count, 0.1);
        EXPECT_NEAR(sum / count, 0, 2e-5);
    }
}

}  // namespace
}  // namespace skybake::noise
