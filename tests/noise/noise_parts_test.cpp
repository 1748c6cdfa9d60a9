// Small parts: positions on lattices, the functions of noise_plan.h, values of distances.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "bakers/noise/noise_bounds.h"
#include "bakers/noise/noise_plan.h"
#include "tests/noise/noises.h"

namespace skybake::noise {
namespace {

using config::WorleyFeature;
using config::WorleyValue;

// __int128 says what 64 bits must not lose.
__extension__ using Wide = __int128;

TEST(TileAxis, PositionsAreExactAndRepeat) {
    EXPECT_TRUE(rc::check([] {
        const TileAxis axis{*rc::gen::inRange(1, 16385), *rc::gen::inRange(0, 2)};
        const int frequency = *rc::gen::inRange(1, 1048577);
        const std::int64_t voxel = *rc::gen::inRange<std::int64_t>(-40000, 40000);
        const LatticePosition at = lattice_position(axis, frequency, voxel);
        RC_ASSERT(at.numerator >= 0);
        RC_ASSERT(at.numerator < at.denominator);
        RC_ASSERT(Wide{at.cell} * at.denominator + at.numerator ==
                  Wide{2 * voxel + axis.offset} * frequency);
        RC_ASSERT(at.denominator == 2 * axis.size);
        const LatticePosition next = lattice_position(axis, frequency, voxel + axis.size);
        RC_ASSERT(next.cell == at.cell + frequency);
        RC_ASSERT(next.numerator == at.numerator);
        RC_ASSERT(wrapped_cell(next.cell, frequency) == wrapped_cell(at.cell, frequency));
        RC_ASSERT(wrapped_cell(at.cell, frequency) < static_cast<std::uint32_t>(frequency));
        RC_ASSERT(cell_fraction(at) >= 0 && cell_fraction(at) < 1);
    }));
}

TEST(TileAxis, SamplingsAreWhereTheySay) {
    const auto offsets = [](config::NoiseSampling sampling) {
        const auto axes = tile_axes({4, 5, 6}, sampling);
        EXPECT_EQ(axes[0].size, 4);
        EXPECT_EQ(axes[1].size, 5);
        EXPECT_EQ(axes[2].size, 6);
        return std::array<int, 3>{axes[0].offset, axes[1].offset, axes[2].offset};
    };
    EXPECT_EQ(offsets(config::NoiseSampling::centers), (std::array<int, 3>{1, 1, 1}));
    EXPECT_EQ(offsets(config::NoiseSampling::corners), (std::array<int, 3>{0, 0, 0}));
    EXPECT_EQ(offsets(config::NoiseSampling::slices_at_corners), (std::array<int, 3>{1, 1, 0}));
}

double fade(double u) { return u * u * u * (u * (6 * u - 15) + 10); }

TEST(GradientBasis, IsFadeTimesDistanceRoundedOnce) {
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i) {
        const double u = static_cast<double>(i) / kSteps;
        const GradientBasis basis = gradient_basis({0, i, kSteps});
        const double w = fade(u);
        EXPECT_NEAR(basis.weight_0, 1 - w, 0x1p-25 + 1e-15);
        EXPECT_NEAR(basis.weight_1, w, 0x1p-25 + 1e-15);
        EXPECT_NEAR(basis.distance_0, u * (1 - w), 0x1p-25 + 1e-15);
        EXPECT_NEAR(basis.distance_1, (u - 1) * w, 0x1p-25 + 1e-15);
    }
}

TEST(GradientBasis, DerivativeIsTheSlope) {
    constexpr int kSteps = 1 << 16;
    for (int i = 1; i < kSteps - 1; i += 97) {
        // The functions' own differences in double.
        const auto at = [&](int k) {
            const double u = static_cast<double>(i + k) / kSteps;
            const double w = fade(u);
            return std::array<double, 4>{1 - w, w, u * (1 - w), (u - 1) * w};
        };
        const GradientBasis slope = gradient_basis_derivative({0, i, kSteps});
        const std::array<float, 4> found = {slope.weight_0, slope.weight_1, slope.distance_0,
                                            slope.distance_1};
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(found[k], (at(1)[k] - at(-1)[k]) * kSteps / 2, 2e-7) << i;
        }
    }
}

TEST(NoisePlan, SharesEqualCellularOctavesAmongChannels) {
    using test::worley;
    const auto fields = [](const std::vector<config::NoiseChannel>& channels) {
        return make_noise_plan(test::noise_of(channels), {32, 32, 32}).fields.size();
    };
    // Octaves of shapes of clouds: each channel's octaves are the next one's, one up.
    EXPECT_EQ(fields({worley({{4, 4, 4}, {8, 8, 8}, {16, 16, 16}}),
                      worley({{8, 8, 8}, {16, 16, 16}}), worley({{16, 16, 16}})}),
              3u);
    EXPECT_EQ(fields({worley({{4, 4, 4}}), worley({{4, 4, 8}})}), 2u);
    EXPECT_EQ(fields({worley({{4, 4, 4}}), worley({{4, 4, 4}}, WorleyFeature::f2)}), 2u);
    EXPECT_EQ(fields({worley({{4, 4, 4}}),
                      worley({{4, 4, 4}}, WorleyFeature::f1, WorleyValue::one_minus_distance)}),
              2u);
    config::NoiseChannel other_seed = worley({{4, 4, 4}});
    other_seed.seed = 1;
    EXPECT_EQ(fields({worley({{4, 4, 4}}), other_seed}), 2u);
}

TEST(NoisePlan, NominalRangeFollowsWhatBecomesOfValues) {
    config::NoiseChannel channel = test::worley({{4, 4, 4}});
    EXPECT_EQ(nominal_range(channel), (std::array<double, 2>{0, 1}));
    channel.remap = {0.5, 1, 0, 2};
    EXPECT_EQ(nominal_range(channel), (std::array<double, 2>{-2, 2}));
    channel.invert = true;
    EXPECT_EQ(nominal_range(channel), (std::array<double, 2>{-1, 3}));
    config::NoiseChannel curl = test::curl({{4, 4, 4}}, config::CurlComponent::z);
    EXPECT_EQ(nominal_range(curl), (std::array<double, 2>{-1, 1}));
    config::NoiseChannel constant;
    constant.type = config::NoiseType::constant;
    constant.value = 5;
    EXPECT_EQ(nominal_range(constant), (std::array<double, 2>{0, 5}));
    // Never empty, whatever remap and bias do: a histogram lies over it.
    config::NoiseChannel flat;
    flat.remap = {0, 1, 0.5, 0.5};
    EXPECT_EQ(nominal_range(flat), (std::array<double, 2>{0, 1}));
    config::NoiseChannel steep = curl;
    steep.bias = 2.0 / 3;
    EXPECT_EQ(nominal_range(steep), (std::array<double, 2>{-1, 1}));
}

}  // namespace
}  // namespace skybake::noise
