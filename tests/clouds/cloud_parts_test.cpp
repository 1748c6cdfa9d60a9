// Height profiles, bounds of noise, and what a cloud's parameters do to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/clouds/cloud_plan.h"
#include "bakers/clouds/cloud_reference.h"
#include "bakers/math/quadrature.h"
#include "bakers/noise/noise_bounds.h"
#include "bakers/noise/noise_reference.h"
#include "tests/clouds/clouds.h"

namespace skybake::cloud {
namespace {

using config::HeightProfile;
using config::HeightProfileType;
using test::densities_of;
using test::plain_case;

TEST(HeightProfile, OfTheThesisHasItsMaximum) {
    HeightProfile profile;
    profile.type = HeightProfileType::thesis;
    EXPECT_NEAR(height_profile(profile, std::log(13.5) / 50), 0.751882, 5e-7);
    EXPECT_EQ(height_profile(profile, 0), 0);
}

TEST(HeightProfile, AgreesWithTheCLibrary) {
    for (const double sharpness : {1e-12, 1e-6, 0.3, 50.0, 1e4, 1e7}) {
        for (const double falloff : {0.0, 4.0, 300.0}) {
            HeightProfile profile;
            profile.type = HeightProfileType::thesis;
            profile.bottom_sharpness = sharpness;
            profile.top_falloff = falloff;
            for (const double h : {1e-9, 1e-3, 0.02, 0.5, 1.0}) {
                const double wanted = -std::expm1(-sharpness * h) * std::exp(-falloff * h);
                EXPECT_NEAR(height_profile(profile, h), wanted, 1e-14 * wanted)
                    << sharpness << ' ' << falloff << ' ' << h;
            }
        }
    }
}

TEST(HeightProfile, OfTheClassicTypesEndsAtZero) {
    for (const double h : {0.0, 1.0}) {
        for (const double value : classic_profiles(h)) EXPECT_EQ(value, 0);
    }
    EXPECT_EQ(classic_profiles(0.07)[0], 1);
    EXPECT_EQ(classic_profiles(0.3)[1], 1);
    EXPECT_EQ(classic_profiles(0.5)[2], 1);
}

TEST(HeightProfile, BlendsNeighbouringTypes) {
    HeightProfile profile;
    profile.type = HeightProfileType::blended;
    for (const double type : {0.0, 0.2, 0.5, 0.75, 1.0}) {
        profile.cloud_type = type;
        const auto weights = type_weights(type);
        EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-15);
        for (int i = 0; i <= 100; ++i) {
            EXPECT_NEAR(height_profile(profile, i / 100.0),
                        height_profile_reference(profile, i / 100.0), 1e-15);
        }
    }
}

TEST(HeightProfile, OfATableIsLinearAndClamped) {
    HeightProfile profile;
    profile.type = HeightProfileType::tabulated;
    profile.table = {{0.2, 1}, {0.4, 3}, {0.9, 0}};
    EXPECT_EQ(height_profile(profile, 0.0), 1);
    EXPECT_EQ(height_profile(profile, 0.2), 1);
    EXPECT_NEAR(height_profile(profile, 0.3), 2, 1e-15);
    EXPECT_EQ(height_profile(profile, 0.4), 3);
    EXPECT_EQ(height_profile(profile, 1.0), 0);
}

// The best of the twelve gradients at each of the eight corners, everywhere in a cell.
TEST(NoiseBounds, OfGradientNoiseHoldInAllOfACell) {
    constexpr int kSteps = 128;
    const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    double largest = 0;
    for (int k = 0; k <= kSteps / 2; ++k) {
        for (int j = 0; j <= kSteps / 2; ++j) {
            for (int i = 0; i <= kSteps / 2; ++i) {
                const std::array<double, 3> t = {i / double{kSteps}, j / double{kSteps},
                                                 k / double{kSteps}};
                double sum = 0;
                for (unsigned corner = 0; corner < 8; ++corner) {
                    std::array<double, 3> d;
                    double weight = 1;
                    for (unsigned a = 0; a < 3; ++a) {
                        const bool far = ((corner >> a) & 1U) != 0;
                        d[a] = far ? 1 - t[a] : t[a];
                        weight *= far ? fade(t[a]) : 1 - fade(t[a]);
                    }
                    sum += weight * (d[0] + d[1] + d[2] - *std::min_element(d.begin(), d.end()));
                }
                largest = std::max(largest, sum);
            }
        }
    }
    config::Noise noise = test::noise_of({test::perlin({{1, 1, 1}})});
    const auto bounds = noise::value_bounds(noise, 0);
    EXPECT_LE(0.5 + 0.5 * largest, bounds[1]);
    EXPECT_GT(0.5 + 0.5 * largest, bounds[1] - 1e-4) << "the bound could be lower";
}

// The same in four dimensions: the greatest blend of sixteen corners, each with the best gradient,
// which leaves out the least distance.
double greatest_blend_at(const std::array<double, 4>& at) {
    const auto fade = [](double u) { return u * u * u * (u * (6 * u - 15) + 10); };
    double sum = 0;
    for (int corner = 0; corner < 16; ++corner) {
        double weight = 1;
        double distances = 0;
        double least = 1;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            const bool far = (corner >> axis & 1) != 0;
            const double distance = far ? 1 - at[axis] : at[axis];
            weight *= far ? fade(at[axis]) : 1 - fade(at[axis]);
            distances += distance;
            least = std::min(least, distance);
        }
        sum += weight * (distances - least);
    }
    return sum;
}

TEST(NoiseBounds, OfNoiseThatMovesIsTheGreatestBlend) {
    double largest = 0;
    std::array<double, 4> best{};
    const auto look_at = [&](const std::array<double, 4>& at) {
        const double blend = greatest_blend_at(at);
        if (blend > largest) best = at;
        largest = std::max(largest, blend);
    };
    for (int i = 0; i < 160000; ++i) {
        look_at({(i % 20) / 19.0, i / 20 % 20 / 19.0, i / 400 % 20 / 19.0, i / 8000 / 19.0});
    }
    for (double step = 0.02; step > 1e-5; step /= 2) {
        for (int i = 0; i < 324; ++i) {
            std::array<double, 4> at = best;
            int digits = i % 81;
            for (double& axis : at) {
                axis = std::clamp(axis + (digits % 3 - 1) * step, 0.0, 1.0);
                digits /= 3;
            }
            look_at(at);
        }
    }
    config::Noise noise = test::noise_of({test::perlin({{1, 1, 1}})});
    noise.period = 8;
    const auto bounds = noise::value_bounds(noise, 0);
    EXPECT_LE(0.5 + 0.5 * largest, bounds[1]);
    EXPECT_GT(0.5 + 0.5 * largest, bounds[1] - 1e-4) << "the bound could be lower";
}

TEST(NoiseBounds, HoldForEveryKind) {
    EXPECT_TRUE(rc::check([] {
        config::Noise noise = test::any_cloud_noise();
        noise.period = *rc::gen::element(0, 6);
        noise.time = *rc::gen::inRange(0, 6);
        for (config::NoiseChannel& channel : noise.channels) {
            if (*rc::gen::inRange(0, 4) == 0) channel.type = config::NoiseType::alligator;
            if (channel.type == config::NoiseType::alligator) {
                channel.warp_strength = *rc::gen::element(0.0, 0.2);
                channel.warp_octaves = channel.octaves;
            }
            channel.invert = *rc::gen::arbitrary<bool>();
            channel.bias = *rc::gen::element(0.5, 0.2, 0.9);
            if (*rc::gen::inRange(0, 3) == 0) channel.clamp = {0.3, 0.6};
        }
        const std::size_t outputs =
            noise.pack == config::NoisePacking::none ? noise.channels.size() : 1;
        for (int i = 0; i < 60; ++i) {
            const auto values =
                noise::noise_reference(noise, low_discrepancy_point(*rc::gen::inRange(0, 100000)));
            for (std::size_t c = 0; c < outputs; ++c) {
                const auto bounds = noise::value_bounds(noise, c);
                RC_ASSERT(values[c] >= bounds[0] - 1e-12);
                RC_ASSERT(values[c] <= bounds[1] + 1e-12);
            }
        }
    }));
}

// A step as steep as can be, at the greatest value that the noise has as a real number: what the
// kernels' floats are above it must not become more than the bound.
TEST(NoiseBounds, HoldForFloatsOfASteepStep) {
    config::Noise noise = test::noise_of({test::worley({{4, 4, 4}, {8, 8, 8}, {3, 3, 3}})});
    config::NoiseChannel& channel = noise.channels[0];
    channel.value_form = config::WorleyValue::one_minus_distance_squared;
    channel.smoothstep = {1, 1 + 1e-6};
    EXPECT_GE(noise::value_bounds(noise, 0)[1], 0.5) << "1 + 2e-7 is 0.1 of the step";
    channel.smoothstep = {1.1, 1.1 + 1e-6};
    EXPECT_EQ(noise::value_bounds(noise, 0)[1], 0);
    channel.type = config::NoiseType::curl;
    channel.smoothstep = {-1, 1};
    EXPECT_EQ(noise::value_bounds(noise, 0), (std::array<double, 2>{0, 1}));
    channel.smoothstep.reset();
    channel.clamp = {-0.25, 0.5};
    EXPECT_EQ(noise::value_bounds(noise, 0), (std::array<double, 2>{-0.25, 0.5}));
}

double share_filled(const std::vector<float>& values) {
    return static_cast<double>(
               std::count_if(values.begin(), values.end(), [](float v) { return v > 0; })) /
           static_cast<double>(values.size());
}

TEST(Cloud, GrowsWithCoverageAndShrinksWithThresholdAndErosion) {
    test::CloudCase any = plain_case({32, 32, 32});
    const double plain = share_filled(densities_of(any));
    EXPECT_GT(plain, 0.5);
    any.cloud.coverage = 0.7;
    const double covered = share_filled(densities_of(any));
    EXPECT_LT(covered, plain);
    EXPECT_GT(covered, 0);
    any.cloud.coverage = 0;
    EXPECT_EQ(share_filled(densities_of(any)), 0);
    any.cloud.coverage = 1;
    any.cloud.threshold = 0.5;
    EXPECT_LT(share_filled(densities_of(any)), plain);
    any.cloud.threshold = 0.3;
    any.detail = test::noise_of({test::perlin({{8, 8, 8}})});
    any.cloud.erosion = {0.3, 0.3};
    EXPECT_LT(share_filled(densities_of(any)), plain);
    any.cloud.erosion = {0, 0};
    EXPECT_EQ(share_filled(densities_of(any)), plain);
}

TEST(Cloud, KeepsTheValueForARuntimesThreshold) {
    test::CloudCase any = plain_case({24, 24, 24});
    any.cloud.threshold_at = config::ThresholdAt::runtime;
    const std::vector<float> values = densities_of(any);
    any.cloud.threshold_at = config::ThresholdAt::bake;
    const std::vector<float> densities = densities_of(any);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double x = std::clamp((values[i] - 0.3) / 0.1, 0.0, 1.0);
        EXPECT_NEAR(densities[i], values[i] * x * x * (3 - 2 * x), 1e-5);
    }
}

TEST(Cloud, IsFullFromAValueOn) {
    test::CloudCase any = plain_case({24, 24, 24});
    const std::vector<float> plain = densities_of(any);
    any.cloud.full_at = 0.5;
    const std::vector<float> full = densities_of(any);
    int saturated = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        EXPECT_EQ(full[i] > 0, plain[i] > 0);
        // Beyond the edge, which ends at 0.4, the plain density is the value.
        if (plain[i] > 0.5F) {
            EXPECT_EQ(full[i], 1);
            ++saturated;
        } else {
            EXPECT_NEAR(full[i], 2 * plain[i], 1e-5);
        }
    }
    EXPECT_GT(saturated, 100);
}

// The liquid water of air that rises unmixed grows with the height above the base, and the extinction of a given
// number of droplets with its power 2/3.
TEST(Cloud, HasTheWaterOfAirThatRises) {
    test::CloudCase any = plain_case({24, 24, 24});
    const std::vector<float> even = densities_of(any);
    any.cloud.water = config::CloudWater::rising;
    const std::vector<float> rising = densities_of(any);
    int filled = 0;
    for (std::size_t i = 0; i < even.size(); ++i) {
        const double height = (static_cast<double>(i / (24 * 24)) + 0.5) / 24;
        EXPECT_NEAR(rising[i], even[i] * std::cbrt(height * height), 1e-6);
        filled += even[i] > 0 ? 1 : 0;
    }
    EXPECT_GT(filled, 1000);
}

// A Gaussian whose neighbours add below 1e-6 where it counts.
config::Tower column_tower() { return test::tower(0.5, 0.5, 0.15, 0.15, 1); }

// The field of the tower at voxel i of 40 x 40 x 40.
double column_field(std::size_t i) {
    const double dx = (static_cast<double>(i % 40) + 0.5) / 40 - 0.5;
    const double dy = (static_cast<double>(i / 40 % 40) + 0.5) / 40 - 0.5;
    return std::exp(-(dx * dx + dy * dy) / 0.045);
}

// Noise of 0.8 everywhere: where the profile takes 0.5 from the tower T, the cloud ends at
// 0.8 (T - 0.5) = 0.3, and where the profile takes 1, there is none.
TEST(Cloud, LosesTowersWhereTheProfileIsBelowZero) {
    test::CloudCase any = plain_case({40, 40, 40});
    any.base.channels = {test::channel_of(config::NoiseType::constant, {})};
    any.base.channels[0].value = 0.8;
    any.cloud.towers = {column_tower()};
    any.cloud.height_profile.table = {{0.49, -0.5}, {0.51, -1}};
    const std::vector<float> values = densities_of(any);
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(values[i] > 0, 0.8 * (column_field(i) - 0.5) > 0.3 && i / 1600 < 20) << i;
    }
}

// Noise from -6 to 6 does not make cloud of what the profile takes: all lies where T > 0.5.
TEST(Cloud, IsNotMadeOfNoiseAndProfileBelowZero) {
    test::CloudCase any = plain_case({40, 40, 40});
    any.base.channels[0].remap = {0, 1, -6, 6};
    any.cloud.towers = {column_tower()};
    any.cloud.height_profile.table = {{0, -0.5}};
    const std::vector<float> values = densities_of(any);
    EXPECT_GT(share_filled(values), 0.01);
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_TRUE(values[i] == 0 || column_field(i) > 0.5) << i;
    }
}

TEST(Cloud, FollowsItsCoverageMap) {
    test::CloudCase any = plain_case({32, 24, 8});
    any.maps.coverage = test::small_map(config::MapWrap::repeat, config::MapFilter::nearest);
    const std::vector<float> values = densities_of(any);
    const std::array<double, 12> pixels = {0, 1, 0, 0.25, 1, 0.5, 0, 0, 0, 0, 0.75, 1};
    std::array<int, 12> filled{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        filled[i / 32 % 24 / 8 * 4 + i % 32 / 8] += values[i] > 0 ? 1 : 0;
    }
    for (std::size_t i = 0; i < 12; ++i) {
        if (pixels[i] == 0) {
            EXPECT_EQ(filled[i], 0) << i;
        } else if (pixels[i] == 1) {
            EXPECT_GT(filled[i], 256) << i;
        }
    }
}

TEST(Cloud, OfFourChannelsShapesTwo) {
    test::CloudCase any = plain_case({16, 16, 16});
    any.cloud.channels = config::CloudChannels::noise;
    any.cloud.height_profile.table = {{0, 0}};
    any.base.channels.assign(4, test::perlin({{4, 4, 4}}));
    const CloudField field(any.plan());
    const auto planes = test::filled(field, {{}, any.size}, 4);
    EXPECT_EQ(share_filled(planes[0]), 0);
    EXPECT_EQ(share_filled(planes[1]), 0);
    EXPECT_GT(share_filled(planes[2]), 0.9);
    EXPECT_EQ(planes[2], planes[3]);
    EXPECT_FALSE(field.is_empty({{}, any.size}));
}

}  // namespace
}  // namespace skybake::cloud
