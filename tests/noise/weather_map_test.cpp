// The asset weather_map: exact shares, streaks and directions.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "bakers/assets/weather_map/map_channels.h"
#include "bakers/assets/weather_map/weather_map_table.h"
#include "bakers/field/wrong_lookups.h"
#include "bakers/noise/noise_reference.h"
#include "config/assets/weather_map.h"
#include "tests/noise/noises.h"
#include "tests/support/outcomes.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

using config::CoverEdge;
using config::WeatherContent;
using config::WeatherMapBake;

constexpr double kTau = 2 * std::numbers::pi;

config::Noise two_clouds() {
    return test::picture_of({test::perlin({{5, 4, 1}, {10, 8, 1}}), test::perlin({{3, 3, 1}}),
                             test::perlin({{2, 7, 1}})});
}

WeatherMapBake bake_of(const std::array<int, 2>& size, std::vector<double> covered,
                       std::vector<double> full, PixelType type) {
    WeatherMapBake bake;
    bake.noise = "n";
    bake.size = size;
    bake.streaks.assign(covered.size(), 0);
    bake.covered = std::move(covered);
    bake.full = std::move(full);
    bake.pixel_type = type;
    bake.formats = {config::FileFormat::bin};
    bake.mips = 1;
    return bake;
}

Baked baked(const config::Noise& noise, const WeatherMapBake& bake) {
    return test::without_diagnostics(bake_weather_map(noise, bake, {}, {}));
}

// The texels of a map that has no certificate.
Image2<float> texels_of(const config::Noise& noise, const WeatherMapBake& bake) {
    return test::without_diagnostics(
               bake_weather_map(noise, bake, {.certification = Certification::off}, {}))
        .image();
}

// The law: of N texels, round(covered N) are above 0 and round(full N) are 1, as they are stored.
RC_GTEST_PROP(WeatherMap, SharesAreExactInEveryPixelType, ()) {
    // No multiples of frequencies, at which many texels have the same noise.
    const std::array<int, 2> size = {*rc::gen::element(13, 17, 31), *rc::gen::element(11, 19, 37)};
    std::vector<double> covered, full;
    for (int c = 0; c < 3; ++c) {
        covered.push_back(*rc::gen::inRange(0, 1001) / 1000.0);
        full.push_back(covered.back() * *rc::gen::inRange(0, 1001) / 1000.0);
    }
    config::Noise noise = two_clouds();
    noise.seed = *rc::gen::arbitrary<std::uint64_t>();
    WeatherMapBake bake = bake_of(size, covered, full, PixelType::unorm8);
    bake.edge = *rc::gen::element(CoverEdge::linear, CoverEdge::smooth);
    for (const PixelType type :
         {PixelType::unorm8, PixelType::unorm16, PixelType::half, PixelType::float32}) {
        bake.pixel_type = type;
        const auto outcome =
            bake_weather_map(noise, bake, {.certification = Certification::off}, Baked{});
        // On so few texels three equal ones may be too many.
        if (!outcome.value) {
            RC_ASSERT(outcome.diagnostics.front().code == "E0411");
            RC_DISCARD();
        }
        const Image2<float>& map = outcome.value->image();
        for (std::size_t c = 0; c < 3; ++c) {
            long above = 0, whole = 0;
            for (std::size_t i = c; i < map.texels.size(); i += 3) {
                RC_ASSERT(map.texels[i] >= 0 && map.texels[i] <= 1);
                above += map.texels[i] > 0 ? 1 : 0;
                whole += map.texels[i] == 1 ? 1 : 0;
            }
            const double texels = size[0] * size[1];
            const long wanted = std::lround(covered[c] * texels);
            RC_ASSERT(above == wanted);
            // If no texel is to be 1, the greatest one is, and those that round to it.
            const long ones = std::lround(full[c] * texels);
            if (ones > 0) RC_ASSERT(whole == ones);
            if (ones == 0) RC_ASSERT(whole >= std::min(wanted, 1L));
        }
    }
}

// Against the noise's definition: where a texel is among the greatest it is covered.
TEST(WeatherMap, CoversTheGreatestNoise) {
    const config::Noise noise = two_clouds();
    const Baked map =
        baked(noise, bake_of({40, 30}, {0.3, 0.6, 1}, {0.1, 0, 0.5}, PixelType::float32));
    for (std::size_t c = 0; c < 3; ++c) {
        double least_covered = 1e9, greatest_free = -1e9, least_full = 1e9, greatest_thin = -1e9;
        testing::for_each_voxel({40, 30, 1}, [&](int x, int y, int) {
            const double n =
                noise::noise_reference(noise, {(x + 0.5) / 40, (y + 0.5) / 30, 0.5})[c];
            const float value = map.image().texel(x, y)[c];
            if (value > 0) least_covered = std::min(least_covered, n);
            if (value == 0) greatest_free = std::max(greatest_free, n);
            if (value == 1) least_full = std::min(least_full, n);
            if (value < 1) greatest_thin = std::max(greatest_thin, n);
        });
        EXPECT_GT(least_covered, greatest_free - 1e-6) << c;
        EXPECT_GT(least_full, greatest_thin - 1e-6) << c;
    }
    EXPECT_LT(map.certificate.texel.max, 1e-5);
    EXPECT_LT(map.certificate.lookup.rms, 0.04);
}

TEST(WeatherMap, RampGoesFromItsThresholdsInEqualSteps) {
    const FittedRamp fitted =
        fit_cover_ramp({0.1F, 0.9F, 0.3F, 0.5F, 0.7F}, 0.6, 0.2, CoverEdge::linear);
    ASSERT_FALSE(fitted.tied);
    EXPECT_NEAR(fitted.ramp.low, 0.4, 1e-6);
    EXPECT_NEAR(fitted.ramp.high, 0.8, 1e-6);
    EXPECT_EQ(fitted.ramp(0.3), 0);
    EXPECT_NEAR(fitted.ramp(0.6), (1 + 253 * 0.5) / 255, 1e-6);
    EXPECT_EQ(fitted.ramp(0.85), 1);
    const CoverRamp smooth{0.4, 0.8, 0.4, CoverRamp::kInfinity, CoverEdge::smooth};
    EXPECT_NEAR(smooth(0.5), (1 + 254 * (3 * 0.0625 - 2 * 0.015625)) / 255, 1e-6);
    EXPECT_EQ(fit_cover_ramp({0.2F, 0.4F}, 0, 0, CoverEdge::linear).ramp(1e30), 0);
}

// Equal texels at a threshold are divided by their order, if they are few.
TEST(WeatherMap, FewTiesAreDividedByTheirOrder) {
    std::vector<float> noise(1000);
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<float>(i % 250) / 250;
    std::vector<float> texels = noise;
    noise[3] = noise[700] = noise[499];  // six are equal: 499 % 250 and two more
    texels = noise;
    const FittedRamp three = fit_cover_ramp(noise, 0.003, 0, CoverEdge::linear);
    EXPECT_TRUE(three.tied) << "6 of 1000 are more than one in 255";
    texels.resize(4000, -1);
    noise = texels;
    const FittedRamp few = fit_cover_ramp(noise, 0.00075, 0.0005, CoverEdge::linear);
    ASSERT_FALSE(few.tied);
    apply(few, texels);
    std::vector<std::size_t> above, full;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (texels[i] > 0) above.push_back(i);
        if (texels[i] == 1) full.push_back(i);
    }
    EXPECT_EQ(above, (std::vector<std::size_t>{3, 249, 499}));
    EXPECT_EQ(full, (std::vector<std::size_t>{3, 249}));
    EXPECT_NEAR(texels[499], 254.0 / 255, 1e-6);
}

TEST(WeatherMap, ConstantsAreCoveredWholeOrNotAtAll) {
    config::NoiseChannel constant;
    constant.name = "Y";
    constant.value = 0.25;
    const config::Noise noise = test::picture_of({constant});
    for (const double covered : {0.0, 1.0}) {
        const auto map = texels_of(noise, bake_of({4, 4}, {covered}, {covered}, PixelType::unorm8));
        for (const float value : map.texels) EXPECT_EQ(value, covered);
    }
    const auto refused = test::expect_refused(
        bake_weather_map(noise, bake_of({4, 4}, {0.5}, {0}, PixelType::unorm8), {}, Baked{}),
        "E0411");
    EXPECT_NE(refused.message.find("0.25"), std::string::npos);
}

// Low clouds are less likely where there are middle ones, and cover what they should all the same.
TEST(WeatherMap, AChannelYieldsToAnother) {
    const config::Noise noise = two_clouds();
    WeatherMapBake bake = bake_of({64, 64}, {0.3, 0.3, 0.3}, {0, 0, 0}, PixelType::float32);
    const auto overlap = [&] {
        const Image2<float> map = baked(noise, bake).image();
        int both = 0, first = 0;
        for (std::size_t i = 0; i < map.texels.size(); i += 3) {
            first += map.texels[i] > 0 ? 1 : 0;
            both += map.texels[i] > 0 && map.texels[i + 1] > 0.3F ? 1 : 0;
        }
        EXPECT_EQ(first, std::lround(0.3 * 64 * 64));
        return both;
    };
    EXPECT_GT(overlap(), 200);
    bake.yields_to = {"G", "", ""};
    EXPECT_EQ(overlap(), 0);
    EXPECT_LT(baked(noise, bake).certificate.texel.max, 1e-5);
}

Image2<float> wave(int size, int k, int l) {
    Image2<float> plane(size, size, 1);
    testing::for_each_texel(size, size, [&](int x, int y) {
        *plane.texel(x, y) =
            static_cast<float>(std::cos(kTau * (k * (x + 0.5) / size + l * (y + 0.5) / size)));
    });
    return plane;
}

// exp(-s), cut at 8, has a transform in closed form.
TEST(WindStreaks, WavesHaveTheTransformOfAnExponential) {
    const int size = 128;
    for (const double angle : {0.0, 0.7, 2.0, -1.6}) {
        for (const double length : {0.02, 0.15}) {
            const Streaks streaks{length, wind_direction(angle)};
            const double turns = 3 * std::cos(angle) - 2 * std::sin(angle);  // per tile
            const std::complex<double> rate(1, kTau * length * turns);
            const std::complex<double> factor =
                (1.0 - std::exp(-8.0 * rate)) / rate / (1 - std::exp(-8.0));
            const Image2<float> found = streaked(wave(size, 3, -2), streaks, {});
            double largest = 0, largest_of_reference = 0;
            for (int y = 0; y < size; y += 5) {
                for (int x = 0; x < size; x += 7) {
                    const double u = (x + 0.5) / size, v = (y + 0.5) / size;
                    const auto at = std::polar(1.0, kTau * (3 * u - 2 * v));
                    const double wanted = (at * factor).real();
                    largest = std::max(largest, std::fabs(double{*found.texel(x, y)} - wanted));
                    const double reference = streaked_reference(
                        [](double a, double b) { return std::cos(kTau * (3 * a - 2 * b)); },
                        streaks, u, v);
                    largest_of_reference =
                        std::max(largest_of_reference, std::fabs(reference - wanted));
                }
            }
            EXPECT_LT(largest, 2e-4) << angle << " " << length;
            EXPECT_LT(largest_of_reference, 1e-6) << angle << " " << length;
        }
    }
}

TEST(WindStreaks, LeadDownwindAndKeepTheMean) {
    Image2<float> point(64, 32, 1);
    *point.texel(60, 5) = 1;  // its streak goes on across the seam
    const Image2<float> found = streaked(point, {4.0 / 64, {1, 0}}, {});
    double sum = 0;
    for (const float value : found.texels) sum += double{value};
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_NEAR(*found.texel(2, 5) / *found.texel(62, 5), std::exp(-1), 2e-3);
    EXPECT_EQ(*found.texel(58, 5), 0);
    EXPECT_EQ(*found.texel(62, 6), 0);
    EXPECT_EQ(streaked(point, {0, {1, 0}}, {}).texels, point.texels);
}

TEST(WeatherMap, StreaksAreThoseOfTheReference) {
    const config::Noise noise = two_clouds();
    WeatherMapBake bake = bake_of({128, 96}, {1, 1, 1}, {0, 0, 0}, PixelType::float32);
    bake.streaks = {0, 0.05, 0.2};
    bake.wind.radians = 0.5;
    const Baked map = baked(noise, bake);
    EXPECT_LT(map.certificate.texel.max, 5e-3);
    bake.wind.radians = 0.5 + std::numbers::pi;
    const Baked turned = baked(noise, bake);
    EXPECT_NE(map.levels.front().content_hash, turned.levels.front().content_hash);
}

// Fine octaves change the faster the coarser the coarsest one of all channels is.
TEST(WeatherMap, AMovingNoiseIsThatOfTheReference) {
    config::Noise noise = two_clouds();
    noise.period = 5;
    noise.time = 2;
    noise.time_cells = 4;
    const WeatherMapBake bake = bake_of({40, 24}, {1, 1, 1}, {0, 0, 0}, PixelType::float32);
    EXPECT_LT(baked(noise, bake).certificate.texel.max, 1e-5);
}

TEST(WeatherMap, OneTexelIsCoveredOrNot) {
    for (const double covered : {0.0, 0.4, 0.6, 1.0}) {
        const auto map = texels_of(test::picture_of({test::perlin({{1, 1, 1}})}),
                                   bake_of({1, 1}, {covered}, {0}, PixelType::unorm8));
        EXPECT_EQ(map.texels.front(), covered < 0.5 ? 0.0F : 1.0F);
    }
}

TEST(WeatherMap, DirectionsHaveLengthOne) {
    const config::Noise noise =
        test::picture_of({test::curl({{4, 4, 4}}, config::CurlComponent::x),
                          test::curl({{4, 4, 4}}, config::CurlComponent::y),
                          test::curl({{4, 4, 4}}, config::CurlComponent::z)});
    WeatherMapBake bake = bake_of({32, 32}, {1, 1, 1}, {0, 0, 0}, PixelType::float32);
    bake.content = WeatherContent::directions;
    const Baked map = baked(noise, bake);
    double sum = 0;
    for (std::size_t i = 0; i < map.image().texels.size(); i += 3) {
        double squares = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double part = 2 * double{map.image().texels[i + c]} - 1;
            squares += part * part;
            sum += part;
        }
        EXPECT_NEAR(squares, 1, 1e-6);
    }
    EXPECT_LT(std::fabs(sum) / (3 * 32 * 32), 0.1);  // no direction is preferred
    EXPECT_LT(map.certificate.texel.max, 1e-4);
}

TEST(WeatherMap, NoDirectionIsTheMiddle) {
    config::NoiseChannel nothing;
    const config::Noise noise = test::picture_of({nothing, nothing, nothing});
    WeatherMapBake bake = bake_of({4, 4}, {1, 1, 1}, {0, 0, 0}, PixelType::float32);
    bake.content = WeatherContent::directions;
    for (const float value : texels_of(noise, bake).texels) EXPECT_EQ(value, 0.5F);
}

TEST(WeatherMap, SaysWhereSamplesLie) {
    config::Noise noise = two_clouds();
    noise.sampling = config::NoiseSampling::corners;
    const WeatherMapBake bake = bake_of({16, 8}, {1, 1, 1}, {0, 0, 0}, PixelType::float32);
    const Baked map = baked(noise, bake);
    EXPECT_EQ(weather_map_shift(noise, bake), (std::array<double, 2>{1 / 32.0, 1 / 16.0}));
    EXPECT_TRUE(map.is_table());
    EXPECT_LT(map.certificate.texel.max, 1e-5);
    for (const Probe& probe : map.levels.front().probes) {
        const double u = probe.at[0].second + 1 / 32.0;
        EXPECT_NEAR(u - std::floor(u), probe.uvw[0] - std::floor(probe.uvw[0]), 1e-9);
        EXPECT_EQ(probe.uvw[2], 0.5);
    }
}

// A map has no third coordinate that a lookup could exchange for another.
TEST(WeatherMap, ProbesDetectFaultsOfTwoCoordinates) {
    for (const std::array<int, 2>& size : {std::array{64, 64}, std::array{48, 20}}) {
        const Baked map =
            baked(two_clouds(), bake_of(size, {0.5, 0.5, 0.5}, {0.1, 0.1, 0.1}, PixelType::unorm8));
        const Level& level = map.levels.front();
        std::set<std::string> possible;
        for (const WrongLookup& wrong : wrong_lookups({level.size, level.repeats, false}, 2)) {
            possible.insert(wrong.name);
        }
        const std::set<std::string> caught(level.catches.begin(), level.catches.end());
        for (const std::string& name : caught) EXPECT_TRUE(possible.contains(name)) << name;
        for (const char* name : {"zeros", "flip_u", "flip_v", "swap_uv"}) {
            EXPECT_TRUE(caught.contains(name)) << name;
        }
    }
}

}  // namespace
}  // namespace skybake
