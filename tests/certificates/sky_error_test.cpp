// Whether error.sky is small for right files, large for wrong ones, and what a denser measurement
// with many more paths finds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "bakers/assets/sky/sky_comparison.h"
#include "bakers/field/voxel_array.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/sky_view.h"
#include "tests/certificates/random_cases.h"
#include "tests/support/atmospheres.h"
#include "tests/support/volumes.h"

namespace skybake::test {
namespace {

constexpr BakeOptions kOptions{.threads = 2, .certification = Certification::quick};

// An asset of Earth's sky, and how far it may be off.
struct SkyAsset {
    const char* name;
    const char* section;
    double largest_median;
    bool of_all_damages = true;  // or of a shift alone
};

constexpr SkyAsset kAssets[] = {
    {"sky_view",
     "asset = \"sky_view\"\nsun_elevations = [\"50 deg\", \"3 deg\"]\nsize = [96, 108]\n", 6e-3},
    {"environment", "asset = \"environment\"\nsun_elevation = \"20 deg\"\nsize = [256, 128]\n",
     1e-2, false},
    {"aerial_perspective",
     "asset = \"aerial_perspective\"\nsun_elevation = \"20 deg\"\nheading = \"50 deg\"\n"
     "size = [24, 24, 24]\n",
     1e-2},
    {"irradiance",
     "asset = \"irradiance\"\ncontent = \"sky\"\nsize = [32, 16]\nmax_texel_error = 0.02\n", 2e-2},
    {"solved table", "asset = \"multiple_scattering\"\n", 4e-2, false},
    {"moments",
     "asset = \"multiple_scattering\"\ncontent = \"moments\"\ndegree = 4\nsize = [64, 32]\n", 2e-2},
    {"bruneton",
     "asset = \"bruneton\"\ntable = \"scattering\"\ncombined = true\nsize = [128, 64, 16]\n", 4e-2},
    {"bruneton apart", "asset = \"bruneton\"\ntable = \"scattering\"\nsize = [128, 64, 16]\n",
     4e-2},
    {"bruneton higher orders",
     "asset = \"bruneton\"\ntable = \"higher_orders\"\nsize = [128, 64, 16]\n", 6e-2, false},
    {"bruneton irradiance", "asset = \"bruneton\"\ntable = \"irradiance\"\n", 8e-2, false}};

config::Recipe recipe_with(const std::string& section) {
    return recipe_of("preset = \"earth_hillaire\"\n[bake.a]\n" + section);
}

Baked baked_from(const config::Recipe& recipe) {
    auto outcome = bake_asset(recipe, recipe.parameters.bakes.front(), kOptions);
    EXPECT_TRUE(outcome.value) << (outcome.diagnostics.empty() ? std::string("interrupted")
                                                               : outcome.diagnostics[0].message);
    return std::move(outcome.value).value();
}

// Returns the damaged value at a voxel. It reads values of the right file.
using Damage = std::function<float(const std::function<float(int x, int y, int z)>& right,
                                   const std::array<int, 3>& size, int x, int y, int z)>;

Baked damaged(Baked baked, const Damage& damage) {
    Level& level = baked.levels.front();
    const std::size_t channels = baked.channel_names.size();
    const auto right = testing::planes_of(baked);
    auto wrong = right;
    Image2<float> image(level.size[0], level.size[1], static_cast<int>(channels));
    for (std::size_t c = 0; c < channels; ++c) {
        const auto value = [&](int x, int y, int z) {
            return right[c][occupancy::index_of(level.size, x, y, z)];
        };
        testing::for_each_voxel(level.size, [&](int x, int y, int z) {
            const float worse = damage(value, level.size, x, y, z);
            wrong[c][occupancy::index_of(level.size, x, y, z)] = worse;
            if (z == 0) image.texel(x, y)[c] = worse;
        });
    }
    if (baked.is_table()) {
        level.voxels = std::make_shared<const DenseTexels>(std::move(image));
    } else {
        level.voxels = std::make_shared<const VoxelArray>(level.size, std::move(wrong));
    }
    return baked;
}

struct NamedDamage {
    const char* name;
    Damage damage;
};

const std::vector<NamedDamage>& damages() {
    static const std::vector<NamedDamage> all = {
        {"shifted by two texels", [](const auto& right, const auto& size, int x, int y,
                                     int z) { return right((x + 2) % size[0], y, z); }},
        {"zeros", [](const auto&, const auto&, int, int, int) { return 0.0f; }},
        {"10 % too bright",
         [](const auto& right, const auto&, int x, int y, int z) { return 1.1f * right(x, y, z); }},
        {"upside down", [](const auto& right, const auto& size, int x, int y,
                           int z) { return right(x, size[1] - 1 - y, z); }},
        {"mirrored", [](const auto& right, const auto& size, int x, int y, int z) {
             return right(size[0] - 1 - x, y, z);
         }}};
    return all;
}

TEST(SkyError, IsSmallForRightFilesAndLargeForWrongOnes) {
    for (const SkyAsset& asset : kAssets) {
        const config::Recipe recipe = recipe_with(asset.section);
        const config::Bake& bake = recipe.parameters.bakes.front();
        const Baked right = baked_from(recipe);
        ASSERT_TRUE(right.certificate.sky) << asset.name;
        const SkyError& sky = *right.certificate.sky;
        EXPECT_LT(sky.median, asset.largest_median) << asset.name;
        EXPECT_GT(sky.points, 60) << asset.name;
        EXPECT_GT(sky.standard_error, 0) << asset.name;
        fmt::print("{:24} {:6.2f} % {:6.2f} % {:7.2f} %, standard error {:.2f} %\n", asset.name,
                   100 * sky.median, 100 * sky.ninth_decile, 100 * sky.max,
                   100 * sky.standard_error);
        const TracedLight light = baker_of(bake).traced(recipe.parameters, bake).value();
        for (const NamedDamage& one : damages()) {
            if (&one != &damages().front() && !asset.of_all_damages) break;
            const SkyError wrong = measure_sky(light, damaged(right, one.damage), kOptions);
            fmt::print("    {:24} {:8.2f} % {:8.2f} %\n", one.name, 100 * wrong.median,
                       100 * wrong.ninth_decile);
            EXPECT_TRUE(wrong.median > 2 * sky.median || wrong.ninth_decile > 3 * sky.ninth_decile)
                << asset.name << ", " << one.name;
        }
    }
}

// Three places whose light is 1, under these suns; lookups are off by so much.
SkyError error_of_three(const std::vector<Place>& places, const std::vector<double>& found) {
    const TraceOfPlace ones = [](std::size_t, const PathTracerSettings&) {
        PathTracedRadiance light;
        light.radiance = light.walked = Spectrum(1.0);
        light.standard_error = Spectrum(1e-4);
        light.flights = 1;
        return light;
    };
    const TracedLight light{1,
                            places,
                            [&](const Baked&, int) {
                                std::vector<Spectrum> values;
                                for (const double value : found) values.emplace_back(value);
                                return values;
                            },
                            {ones},
                            "a finer table"};
    return measure_sky(light, Baked{}, kOptions);
}

TEST(SkyError, SaysUnderWhichSunItIsLargest) {
    const std::vector<Place> suns = {{{"altitude_km", 1}, {"sun_elevation_deg", 30}},
                                     {{"altitude_km", 1}, {"sun_elevation_deg", 3}},
                                     {{"altitude_km", 1}, {"sun_elevation_deg", -4}}};
    EXPECT_EQ(error_of_three(suns, {1.5, 1, 0.9}).worst_sun_deg, 30);
    const SkyError dusk = error_of_three(suns, {1.02, 0.9, 1.3});
    EXPECT_EQ(dusk.worst_sun_deg, -4);
    EXPECT_NEAR(dusk.max, 0.3, 1e-12);
    EXPECT_EQ(dusk.worst, "altitude_km 1, sun_elevation_deg -4");
    EXPECT_EQ(dusk.better, "a finer table");
    const std::vector<Place> froxels(3, {{"distance_km", 2}});
    EXPECT_FALSE(error_of_three(froxels, {1.5, 1, 0.9}).worst_sun_deg);
}

// Directions all over a random sky, most of them next to the horizon and some next to the sun.
std::vector<SkySample> random_samples(const SkyViewCamera& camera, double altitude_km,
                                      double sun_elevation_deg, int count, RandomCase& random) {
    const double dip_deg = camera.dip() * kDegreesPerRadian;
    const double above_deg = camera.range_above() * kDegreesPerRadian;
    const double below_deg = camera.range_below() * kDegreesPerRadian;
    const double sun_deg = sun_elevation_deg + dip_deg;
    std::vector<SkySample> samples;
    for (int i = 0; i < count; ++i) {
        SkySample at;
        at.altitude_km = altitude_km;
        at.sun_elevation_deg = sun_elevation_deg;
        at.above_horizon_deg = above_deg * random.log_uniform(3e-3, 1);
        at.azimuth_deg = random.uniform(0, 180);
        if (i % 8 == 0) at.above_horizon_deg = -below_deg * random.log_uniform(2e-3, 1);
        if (i % 8 == 1 && sun_deg > 0 && sun_deg < above_deg) {
            at.above_horizon_deg = std::min(sun_deg + random.uniform(0.2, 3), 0.999 * above_deg);
            at.azimuth_deg = random.uniform(0.2, 3);
        }
        const double elevation = (at.above_horizon_deg - dip_deg) / kDegreesPerRadian;
        at.sun = sun_at_elevation(sun_elevation_deg / kDegreesPerRadian);
        at.direction = sky_direction(at.sun, sine_of(elevation), cosine_of(elevation),
                                     cosine_of(at.azimuth_deg / kDegreesPerRadian));
        samples.push_back(at);
    }
    return samples;
}

struct SkyClaim {
    SkyError claimed;
    SkyError dense;
};

// A sky_view of random air, whose error is claimed, and measured in twice as many directions with
// eight times as many paths in each.
SkyClaim sky_claim(RandomCase& random) {
    constexpr int kDirections = 144;
    config::Parameters parameters;
    parameters.atmosphere = random.atmosphere();
    const Shell shell = shell_of(parameters.atmosphere);
    config::SkyViewBake bake;
    bake.size = {96, 108};
    bake.altitude = {1000 * shell.thickness_km * random.log_uniform(1e-4, 2)};
    const double sun_deg = random.uniform(-5, 88);
    bake.sun_elevations = {{sun_deg / kDegreesPerRadian}};
    bake.pixel_type = config::PixelType::float32;
    const Baker<config::SkyViewBake>& sky_view = baker(BakerTag<config::SkyViewBake>{});
    AssetLabel label;
    label.name = "a";
    const Baked baked =
        std::move(sky_view.bake(parameters, bake, kOptions, std::move(label)).value).value();
    const SkyError claimed =
        measure_sky(sky_view.traced(parameters, bake).value(), baked, kOptions);

    const double altitude_km = bake.altitude.kilometers();
    const std::vector<SkySample> samples = random_samples(
        SkyViewCamera(shell, altitude_km), altitude_km, sun_deg, kDirections, random);
    std::vector<Place> at;
    for (const SkySample& one : samples) {
        at.push_back({{"azimuth_deg", one.azimuth_deg},
                      {"above_horizon_deg", one.above_horizon_deg},
                      {"sun_elevation_deg", one.sun_elevation_deg}});
    }
    const auto places = [&](const StoredTexels& stored) {
        return sky_view.places(parameters, bake, stored);
    };
    const auto air = std::make_shared<const TracedAir>(parameters.atmosphere);
    const TracedLight dense = {3,
                               places_of(samples),
                               light_looked_up(places, at),
                               {trace_of_sky(air, samples, config::SkyOrders::all, true)}};
    return {claimed,
            measure_sky(dense, baked, {.threads = 2, .certification = Certification::full})};
}

// Measured densely over claimed, for each of a claim's figures.
void compare_claims(int cases) {
    std::vector<double> median, ninth_decile, max;
    for (int i = 0; i < cases; ++i) {
        RandomCase random(static_cast<std::uint64_t>(i) * 104729 + 3);
        const SkyClaim claim = sky_claim(random);
        fmt::print(
            "{:3}: claimed {:.2f} {:.2f} {:.2f} ({:.2f}), dense {:.2f} {:.2f} {:.2f} ({:.2f}) %, "
            "{}\n",
            i, 100 * claim.claimed.median, 100 * claim.claimed.ninth_decile,
            100 * claim.claimed.max, 100 * claim.claimed.standard_error, 100 * claim.dense.median,
            100 * claim.dense.ninth_decile, 100 * claim.dense.max, 100 * claim.dense.standard_error,
            claim.dense.worst);
        median.push_back(claim.dense.median / claim.claimed.median);
        ninth_decile.push_back(claim.dense.ninth_decile / claim.claimed.ninth_decile);
        max.push_back(claim.dense.max / claim.claimed.max);
    }
    for (std::vector<double>* ratios : {&median, &ninth_decile, &max}) {
        std::sort(ratios->begin(), ratios->end());
        fmt::print("dense over claimed: {:.2f} (median), {:.2f} (worst)\n",
                   (*ratios)[ratios->size() / 2], ratios->back());
    }
    EXPECT_LT(median.back(), 1.3);
    EXPECT_LT(ninth_decile.back(), 1.3);
}

TEST(SkyError, IsWhatDenseMeasurementsFind) { compare_claims(3); }
TEST(SlowSkyError, IsWhatDenseMeasurementsFind) { compare_claims(24); }

// Light that is scattered once is exact but for quadrature, and transmittance is no light.
TEST(SkyError, IsLeftOutWhereNoLightIsScatteredTwice) {
    for (const char* section :
         {"asset = \"sky_view\"\nsun_elevations = [\"50 deg\"]\norders = \"single\"\n",
          "asset = \"irradiance\"\ncontent = \"direct\"\n", "asset = \"transmittance\"\n",
          "asset = \"aerial_perspective\"\nsun_elevation = \"20 deg\"\n"
          "content = \"transmittance\"\n",
          "asset = \"bruneton\"\ntable = \"single_mie\"\nsize = [64, 32, 8]\n"}) {
        const config::Recipe recipe = recipe_with(section);
        const config::Bake& bake = recipe.parameters.bakes.front();
        EXPECT_FALSE(baker_of(bake).traced(recipe.parameters, bake)) << section;
    }
}

// The bits do not depend on the number of threads.
TEST(SkyError, IsTheSameOnAnyNumberOfThreads) {
    const config::Recipe recipe = recipe_with(kAssets[0].section);
    const config::Bake& bake = recipe.parameters.bakes.front();
    const Baked baked = baked_from(recipe);
    const TracedLight light = baker_of(bake).traced(recipe.parameters, bake).value();
    const SkyError one = measure_sky(light, baked, {.threads = 1});
    const SkyError three = measure_sky(light, baked, {.threads = 3});
    EXPECT_EQ(one.median, three.median);
    EXPECT_EQ(one.max, three.max);
    EXPECT_EQ(one.worst, three.worst);
}

// Colours take their standard error from replicates, so these must be of the light that is compared.
TEST(TracedLight, ReplicatesOfLightScatteredAgainHaveItForTheirMean) {
    const auto recipe = recipe_with("asset = \"irradiance\"\n");
    const auto air = std::make_shared<const TracedAir>(recipe.parameters.atmosphere);
    const auto trace = trace_of_irradiance(air, level_samples(shell_of(air->medium().air)),
                                           config::SkyOrders::multiple);
    PathTracerSettings settings;
    settings.paths = 1024;
    const PathTracedRadiance light = trace(3, settings);
    Spectrum mean{};
    for (const Spectrum& one : light.replicates) mean += one;
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(mean[c] / kPathReplicates / light.radiance[c], 1, 1e-9);
    }
}

}  // namespace
}  // namespace skybake::test
