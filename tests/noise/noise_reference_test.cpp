// The double-precision reference against textbook formulas written once more, and by identities.
#include "bakers/noise/noise_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/math/quadrature.h"
#include "bakers/noise/lattice_hash.h"
#include "tests/noise/noises.h"
#include "tests/noise/perlin_2002.h"

namespace skybake::noise {
namespace {

using config::CurlComponent;
using config::WorleyFeature;
using config::WorleyValue;
using namespace test;

constexpr int kPoints = 2000;

// A place of the tile and of those about it.
Place place_at(int index) {
    Place place = low_discrepancy_point(index);
    for (double& p : place) p = 3 * p - 1;
    return place;
}

// --- Gradient noise -----------------------------------------------------------------------------

TEST(NoiseReference, IsPerlinsImprovedNoise) {
    for (const test::Frequency frequency :
         {test::Frequency{1, 1, 1}, {4, 4, 4}, {3, 5, 7}, {300, 1, 17}}) {
        const config::Noise noise = noise_of({perlin({frequency})}, 99);
        const std::uint64_t key = octave_key(99, 0, Purpose::gradient, frequency);
        for (int i = 0; i < kPoints; ++i) {
            const Place place = place_at(i);
            EXPECT_NEAR(noise_reference(noise, place)[0],
                        0.5 + 0.5 * perlin_2002(key, frequency, place), 1e-14)
                << i;
        }
    }
}

TEST(NoiseReference, PerlinIsZeroAtLatticePoints) {
    const config::Noise noise = noise_of({perlin({{8, 4, 16}}, NoiseFractal::billow)});
    for (int z = -3; z < 19; ++z) {
        for (int y = -1; y < 5; ++y) {
            for (int x = -2; x < 10; ++x) {
                EXPECT_EQ(noise_reference(noise, {x / 8.0, y / 4.0, z / 16.0})[0], 0);
            }
        }
    }
}

// The most that any choice of the eight gradients makes of a place in the cell: with each corner's
// best, the sum of its two larger distances.
double most_at(const Place& t) {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        Place d;
        for (std::size_t i = 0; i < 3; ++i) {
            const int side = (corner >> i) & 1;
            weight *= side == 0 ? 1 - fade(t[i]) : fade(t[i]);
            d[i] = std::fabs(t[i] - side);
        }
        sum += weight * (d[0] + d[1] + d[2] - std::min({d[0], d[1], d[2]}));
    }
    return sum;
}

TEST(NoiseReference, PerlinKeepsItsRangeAndItsRms) {
    const config::Noise noise = noise_of({perlin({{64, 64, 64}})});
    double largest = 0;
    double squares = 0;
    constexpr int kMany = 100000;
    for (int i = 0; i < kMany; ++i) {
        const double n = 2 * noise_reference(noise, low_discrepancy_point(i))[0] - 1;
        largest = std::max(largest, std::fabs(n));
        squares += n * n;
    }
    double most = 0;
    for (int z = 0; z <= 40; ++z) {
        for (int y = 0; y <= z; ++y) {
            for (int x = 0; x <= y; ++x)
                most = std::max(most, most_at({x / 80.0, y / 80.0, z / 80.0}));
        }
    }
    EXPECT_NEAR(most, 1.036, 1e-3);
    EXPECT_LE(largest, most + 1e-3);
    EXPECT_GE(largest, 0.85);
    EXPECT_NEAR(std::sqrt(squares / kMany), 0.27, 0.01);
}

// --- Fractals, by hand from single octaves ------------------------------------------------------

double single(const test::Frequency& frequency, const Place& place) {
    return 2 * noise_reference(noise_of({perlin({frequency})}), place)[0] - 1;
}

TEST(NoiseReference, FractalsAreTheirDefinitions) {
    const test::Frequency first = {3, 4, 5};
    const test::Frequency second = {6, 8, 10};
    const auto of = [&](NoiseFractal fractal, const Place& place) {
        NoiseChannel channel = perlin({first, second}, fractal);
        channel.octaves.gains = {3, 1};
        return noise_reference(noise_of({channel}), place)[0];
    };
    bool negative = false;
    for (int i = 0; i < kPoints; ++i) {
        const Place place = place_at(i);
        const double a = single(first, place);
        const double b = single(second, place);
        const double sum = 0.75 * a + 0.25 * b;
        negative = negative || sum < 0;
        EXPECT_NEAR(of(NoiseFractal::fbm, place), 0.5 + 0.5 * sum, 1e-14);
        EXPECT_NEAR(of(NoiseFractal::rectified, place), sum > 0 ? sum : 0, 1e-14);
        EXPECT_NEAR(of(NoiseFractal::billow, place), 0.75 * std::fabs(a) + 0.25 * std::fabs(b),
                    1e-14);
        EXPECT_NEAR(of(NoiseFractal::ridged, place),
                    0.75 * (1 - std::fabs(a)) + 0.25 * (1 - std::fabs(b)), 1e-14);
    }
    EXPECT_TRUE(negative);
}

TEST(NoiseReference, FbmOfOneOctaveIsTheOctaveWhateverItsGain) {
    NoiseChannel channel = perlin({{5, 5, 5}});
    channel.octaves.gains = {0.3};
    for (int i = 0; i < 100; ++i) {
        EXPECT_NEAR(noise_reference(noise_of({channel}), place_at(i))[0],
                    0.5 + 0.5 * single({5, 5, 5}, place_at(i)), 1e-15);
    }
}

TEST(NoiseReference, PerlinWorleyRemapsPerlinOntoWorley) {
    NoiseChannel both = test::channel_of(NoiseType::perlin_worley, {{3, 3, 3}, {6, 6, 6}});
    both.worley_octaves = test::octaves_of({{4, 4, 4}, {9, 9, 9}});
    NoiseChannel cells = worley({{4, 4, 4}, {9, 9, 9}}, both.feature, both.value_form);
    const NoiseChannel gradient = perlin({{3, 3, 3}, {6, 6, 6}});
    for (int i = 0; i < kPoints; ++i) {
        const Place place = place_at(i);
        const double p = noise_reference(noise_of({gradient}), place)[0];
        const double w = noise_reference(noise_of({cells}), place)[0];
        // remap(p, 0, 1, w, 1)
        EXPECT_NEAR(noise_reference(noise_of({both}), place)[0], w + (p - 0) / (1 - 0) * (1 - w),
                    1e-14);
    }
}

// --- Cellular noise -----------------------------------------------------------------------------

TEST(NoiseReference, ValueFormsAreTheirFormulas) {
    for (const WorleyFeature feature :
         {WorleyFeature::f1, WorleyFeature::f2, WorleyFeature::f2_minus_f1}) {
        const auto of = [&](WorleyValue form, const Place& place) {
            return noise_reference(noise_of({worley({{4, 5, 3}}, feature, form)}), place)[0];
        };
        for (int i = 0; i < 500; ++i) {
            const Place place = place_at(i);
            const double d = of(WorleyValue::distance, place);
            EXPECT_NEAR(of(WorleyValue::one_minus_distance, place), d < 1 ? 1 - d : 0, 1e-15);
            EXPECT_NEAR(of(WorleyValue::one_minus_distance_over_sqrt3, place), 1 - d / std::sqrt(3),
                        1e-15);
            EXPECT_NEAR(of(WorleyValue::one_minus_distance_squared, place), d < 1 ? 1 - d * d : 0,
                        1e-15);
        }
    }
}

TEST(NoiseReference, FeaturesAreOrderedAndBounded) {
    const auto of = [](WorleyFeature feature, const Place& place) {
        return noise_reference(noise_of({worley({{32, 32, 32}}, feature)}), place)[0];
    };
    for (int i = 0; i < kPoints; ++i) {
        const Place place = place_at(i);
        const double f1 = of(WorleyFeature::f1, place);
        const double f2 = of(WorleyFeature::f2, place);
        EXPECT_GE(f1, 0);
        EXPECT_GE(f2, f1);
        EXPECT_LE(f2, std::sqrt(3.0));
        EXPECT_NEAR(of(WorleyFeature::f2_minus_f1, place), f2 - f1, 1e-15);
    }
}

// A lattice of one cell: all points are copies of one, the nearest a lattice's nearest point.
TEST(NoiseReference, OneCellIsACubicLatticeOfPoints) {
    const config::Noise noise = noise_of({worley({{1, 1, 1}})}, 5);
    const CellPoint point =
        cell_point(row_key(octave_key(5, 0, Purpose::cells, {1, 1, 1}), 0, 0), 0);
    for (int i = 0; i < 500; ++i) {
        const Place place = place_at(i);
        const auto apart = [](double a, double b) { return a - b - std::round(a - b); };
        EXPECT_NEAR(noise_reference(noise, place)[0],
                    std::hypot(apart(place[0], point.x), apart(place[1], point.y),
                               apart(place[2], point.z)),
                    1e-14);
    }
}

// --- Curl ---------------------------------------------------------------------------------------

Place curl_at(const std::vector<test::Frequency>& frequencies, const Place& place) {
    return {noise_reference(noise_of({test::curl(frequencies, CurlComponent::x)}), place)[0],
            noise_reference(noise_of({test::curl(frequencies, CurlComponent::y)}), place)[0],
            noise_reference(noise_of({test::curl(frequencies, CurlComponent::z)}), place)[0]};
}

// Fourth-order central differences, of error h^4 times fifth derivatives, cells being 1/f wide.
TEST(NoiseReference, CurlHasNoDivergence) {
    for (const auto& frequencies : {std::vector<test::Frequency>{{4, 4, 4}, {8, 8, 8}},
                                    std::vector<test::Frequency>{{3, 5, 2}, {9, 5, 4}}}) {
        constexpr double kStep = 1e-4;
        double mean_slope = 0;
        for (int i = 0; i < 300; ++i) {
            const Place place = place_at(i);
            double divergence = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto at = [&](int steps) {
                    Place moved = place;
                    moved[axis] += steps * kStep;
                    return curl_at(frequencies, moved)[axis];
                };
                const double slope = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * kStep);
                divergence += slope;
                mean_slope += std::fabs(slope) / 900;
            }
            // At lattice planes the third derivative jumps: h^2 remains.
            EXPECT_NEAR(divergence, 0, 1e-3) << i;
        }
        EXPECT_GE(mean_slope, 1);  // there was something to cancel
    }
}

// Against the definition, by differences of the potentials.
TEST(NoiseReference, CurlIsTheCurlOfItsPotentials) {
    using enum Purpose;
    const test::Frequency frequency = {4, 6, 3};
    for (int i = 0; i < 300; ++i) {
        const Place place = place_at(i);
        const Place found = curl_at({frequency}, place);
        const Place wanted =
            curl_of_perlin_2002({potential_x, potential_y, potential_z}, frequency, place);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(found[axis], wanted[axis], 1e-6) << i;
        }
    }
}

// --- What becomes of values ---------------------------------------------------------------------

TEST(NoiseReference, RemapsStepsInvertsBiasesThenClamps) {
    NoiseChannel channel = worley({{4, 4, 4}});
    for (int i = 0; i < 100; ++i) {
        channel.remap = {0, 1, 0, 1};
        channel.invert = false;
        channel.bias = 0.5;
        channel.smoothstep.reset();
        channel.clamp = NoiseChannel().clamp;
        const Place place = place_at(i);
        const double v = noise_reference(noise_of({channel}), place)[0];
        channel.remap = {0.25, 2.25, 1, 0};
        channel.invert = true;
        channel.bias = 0.2;
        const double remapped = 1 - (v - 0.25) / 2;
        const double inverted = 1 - remapped;
        // The formula has a pole beyond [0, 1], where bias leaves values as they are.
        const bool inside = inverted >= 0 && inverted <= 1;
        const double wanted = inside ? inverted / ((1 / 0.2 - 2) * (1 - inverted) + 1) : inverted;
        EXPECT_NEAR(noise_reference(noise_of({channel}), place)[0], wanted, 1e-13);

        channel.smoothstep = {0.6, 0.9};
        const double in_step = (1 - (v - 0.25) / 2 - 0.6) / 0.3;
        const double t = in_step < 0 ? 0 : in_step > 1 ? 1 : in_step;
        const double fallen = 1 - t * t * (3 - 2 * t);
        const double stepped = fallen / (3 * (1 - fallen) + 1);
        EXPECT_NEAR(noise_reference(noise_of({channel}), place)[0], stepped, 1e-12);
        channel.clamp = {0.2, 0.3};
        EXPECT_NEAR(noise_reference(noise_of({channel}), place)[0],
                    stepped < 0.2   ? 0.2
                    : stepped > 0.3 ? 0.3
                                    : stepped,
                    1e-12);
    }
}

// A frequency that comes again is another field, not the same one under two names.
TEST(NoiseReference, RepeatedFrequenciesAreOtherFields) {
    const NoiseChannel once = worley({{4, 4, 4}});
    const NoiseChannel twice = worley({{4, 4, 4}, {4, 4, 4}});
    double largest = 0;
    for (int i = 0; i < 20; ++i) {
        const Place place = place_at(i);
        largest = std::max(largest, std::fabs(noise_reference(noise_of({once}), place)[0] -
                                              noise_reference(noise_of({twice}), place)[0]));
    }
    EXPECT_GT(largest, 0.05);
}

TEST(NoiseReference, BiasIsTheValueAtOneHalf) {
    NoiseChannel channel;
    channel.type = NoiseType::constant;
    channel.value = 0.5;
    for (const double bias : {0.001, 0.3, 0.5, 0.7, 0.999}) {
        channel.bias = bias;
        EXPECT_NEAR(noise_reference(noise_of({channel}), {0.1, 0.2, 0.3})[0], bias, 1e-15);
    }
}

TEST(NoiseReference, PacksByTheFormulas) {
    std::vector<NoiseChannel> channels = {perlin({{2, 2, 2}}), worley({{3, 3, 3}}),
                                          worley({{5, 5, 5}}), worley({{7, 7, 7}})};
    config::Noise noise = noise_of(channels);
    for (int i = 0; i < 100; ++i) {
        const Place place = place_at(i);
        noise.pack = config::NoisePacking::none;
        const std::vector<double> v = noise_reference(noise, place);
        ASSERT_EQ(v.size(), 4u);
        noise.pack = config::NoisePacking::detail;
        ASSERT_EQ(noise_reference(noise, place).size(), 1u);
        EXPECT_NEAR(noise_reference(noise, place)[0], 0.625 * v[0] + 0.25 * v[1] + 0.125 * v[2],
                    1e-15);
        noise.pack = config::NoisePacking::shape;
        ASSERT_EQ(noise_reference(noise, place).size(), 1u);
        // remap(R, -(1 - w), 1, 0, 1)
        const double low = -(1 - (0.625 * v[1] + 0.25 * v[2] + 0.125 * v[3]));
        EXPECT_NEAR(noise_reference(noise, place)[0], (v[0] - low) / (1 - low), 1e-15);
    }
}

}  // namespace
}  // namespace skybake::noise
