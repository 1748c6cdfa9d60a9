// The light that marches of pictures look up, against paths of light through the same cloud.
#include "bakers/assets/cloud_light/march_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_light/cloud_paths.h"
#include "bakers/assets/cloud_light/depth_reference.h"
#include "bakers/march/cloud_light.h"
#include "bakers/march/layer_march.h"
#include "bakers/math/parallel.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/sections/cloud.h"
#include "tests/support/volumes.h"

namespace skybake::cloud_light {
namespace {

constexpr int kThreads = 2;
constexpr double kBase_m = 1000;
constexpr int kViews = 96;
constexpr int kPaths = 3000;
constexpr std::array<int, 3> kSize = {96, 96, 32};
constexpr double kVoxel_m = 20;

// Two bodies in a tile of 1920 by 1920 by 640 m, with soft edges and optical depths of up to 30.
CloudLayer two_bodies() {
    CloudLayer layer;
    layer.size = kSize;
    layer.voxel_m = {kVoxel_m, kVoxel_m, kVoxel_m};
    layer.optics.extinction_per_m = 0.06;
    layer.values.resize(occupancy::count_of(layer.size));
    const auto body = [](double x, double y, double z, double wide) {
        const double r = std::sqrt((x * x + y * y) / (wide * wide) + z * z / 25);
        return std::clamp(1.5 - 1.5 * r, 0.0, 1.0);
    };
    testing::for_each_voxel(layer.size, [&](int x, int y, int z) {
        const double value = std::max(body(x / 2.0 - 15, y / 2.0 - 17, z / 2.0 - 7, 10),
                                      body(x / 2.0 - 34, y / 2.0 - 30, z / 2.0 - 6, 7));
        layer.values[occupancy::index_of(layer.size, x, y, z)] = static_cast<float>(value);
    });
    return layer;
}

CloudMedium medium_of(const CloudLayer& layer, bool repeats = true) {
    CloudMedium medium;
    for (std::size_t a = 0; a < 3; ++a) medium.extent_m[a] = layer.size[a] * layer.voxel_m[a];
    medium.base_m = kBase_m;
    medium.repeats = repeats;
    medium.optics = layer.optics;
    medium.volume = padded_volume(layer.values.data(), layer.size, 0, 1, kThreads, repeats);
    medium.leaps = leaps_of_voxels(medium, 4, kThreads);
    return medium;
}

// A ray into the tile from its upper or lower face, in voxels.
struct View {
    glm::dvec3 place{};
    glm::dvec3 look{};
};

View view_of(int i) {
    const double turn = 2 * std::numbers::pi * i * 0.618034;
    const double height = (i % 2 == 0 ? 1 : -1) * (0.35 + 0.6 * i / kViews);
    View view;
    view.look = towards(std::asin(height), turn);
    view.place = {std::fmod(i * 0.754878, 1.0) * kSize[0], std::fmod(i * 0.569840, 1.0) * kSize[1],
                  height > 0 ? 0 : kSize[2]};
    return view;
}

struct Seen {
    double sun = 0;
    double sky = 0;  // with the sky behind
    double ground = 0;
    double covered = 0;
};

// Marches each view from a camera of its own, or each view turned about the middle.
std::vector<Seen> marched(const CloudMedium& medium, const SunDirection& sun,
                          const LightInCloud* light, bool is_turned = false) {
    std::vector<Seen> seen(kViews);
    parallel_for(kViews, kThreads, [&](int i) {
        View view = view_of(i);
        if (is_turned) view = {glm::dvec3(kSize[0], kSize[1], kSize[2]) - view.place, -view.look};
        const glm::dvec3 from = view.place * kVoxel_m + glm::dvec3(0, 0, kBase_m);
        MarchSteps steps;
        steps.step_m = 10;
        steps.light_step_m = 10;
        steps.reach_m = 1e4;
        const LayerMarch march({{&medium, steps, light}}, from, sun, 1);
        std::array<RayBlock, 1> blocks;
        std::array<RayResults, 1> results;
        march.set_ray(blocks, 0, view.look, 0.5F, 0.5F);
        FetchCounts counts;
        march.march(blocks, results, counts);
        const RayResults& found = results[0];
        const double through = double{found.transmittance[0]};
        Seen& one = seen[static_cast<std::size_t>(i)];
        one.sun = double{found.sun_at_base[0]} + double{found.sun_at_top[0]};
        one.sky = double{found.from_sky[0]} + (view.look.z > 0 ? through : 0);
        one.ground = double{found.from_ground[0]} + (view.look.z < 0 ? through : 0);
        one.covered = 1 - through;
    });
    return seen;
}

// The RMS of what is found over the mean of what is traced, without the noise of paths, where the cloud is.
// `corner` is the place of the tile's corner in the layer.
double rms_off(const CloudLayer& layer, const LayerSources& sources, const std::vector<Seen>& seen,
               double Seen::*member, const glm::dvec3& corner = {}) {
    const CloudPaths paths(layer, scattering_of(cloud_phase(layer.optics.particles), 1), sources,
                           kThreads);
    std::vector<TracedRadiance> traced(kViews);
    parallel_for(kViews, kThreads, [&](int i) {
        const View view = view_of(i);
        traced[static_cast<std::size_t>(i)] =
            paths.trace(view.place + corner, view.look, kPaths, 3, static_cast<std::uint32_t>(i));
    });
    double squares = 0;
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < traced.size(); ++i) {
        if (seen[i].covered < 0.01) continue;
        const double off = seen[i].*member - traced[i].sum();
        squares += off * off - traced[i].standard_error * traced[i].standard_error;
        sum += traced[i].sum();
        ++count;
    }
    EXPECT_GT(count, kViews / 8);
    return std::sqrt(std::max(squares, 0.0) * count) / sum;
}

LayerSources sun_of(const SunDirection& sun) {
    LayerSources sources;
    sources.sun = 1;
    sources.sun_direction = direction_of(sun.elevation_degrees, sun.azimuth_degrees);
    return sources;
}

// Less of the light that ice scatters goes into the peak, so that cells of the scaled cloud are thicker.
TEST(MarchLight, SunlitCloudsAreThoseOfPaths) {
    const BakeOptions options{.threads = kThreads};
    for (const auto& [particles, most_off] : {std::pair{config::CloudParticles::droplets, 0.07},
                                              std::pair{config::CloudParticles::ice, 0.09}}) {
        CloudLayer layer = two_bodies();
        layer.optics.particles = particles;
        const CloudMedium medium = medium_of(layer);
        const MarchLight within(medium, kCellsOfPicture, options);
        for (const SunDirection& sun : {SunDirection{50, 20}, SunDirection{10, 200}}) {
            const auto light = within.under(sun, options);
            ASSERT_TRUE(light);
            const std::vector<Seen> seen = marched(medium, sun, &*light);
            EXPECT_LT(rms_off(layer, sun_of(sun), seen, &Seen::sun), most_off);
        }
    }
}

// Where no light is solved, thin ice sends on the octaves of its own phase function.
TEST(LayerMarch, ThinIceScattersByItsOctaves) {
    CloudLayer layer = two_bodies();
    layer.optics.particles = config::CloudParticles::ice;
    layer.optics.extinction_per_m = 1e-6;
    const SunDirection sun = {50, 20};
    const std::vector<Seen> seen = marched(medium_of(layer), sun, nullptr);
    for (int i = 0; i < kViews; ++i) {
        const Seen& one = seen[static_cast<std::size_t>(i)];
        const glm::dvec3 apart = view_of(i).look - sun_of(sun).sun_direction;
        const double wanted =
            sun_scattering(octave_phases(ice_phase()), glm::dot(apart, apart) / 2, 0);
        if (one.covered > 1e-5) {
            EXPECT_NEAR(one.sun / one.covered / wanted, 1, 0.02);
        }
    }
}

// A sun below the horizon lights a layer from below: as the sun opposite to it lights the layer turned about its middle.
TEST(MarchLight, ASunBelowLightsBases) {
    const CloudLayer layer = two_bodies();
    CloudLayer turned_layer = layer;
    std::ranges::reverse(turned_layer.values);
    const BakeOptions options{.threads = kThreads};
    const auto seen_under = [&](const CloudLayer& of, const SunDirection& sun, bool is_turned) {
        const CloudMedium medium = medium_of(of);
        const auto light = MarchLight(medium, kCellsOfPicture, options).under(sun, options);
        EXPECT_TRUE(light);
        return marched(medium, sun, &*light, is_turned);
    };
    const std::vector<Seen> below = seen_under(layer, {-35, 70}, false);
    const std::vector<Seen> above = seen_under(turned_layer, {35, 250}, true);
    for (std::size_t i = 0; i < below.size(); ++i) {
        EXPECT_NEAR(below[i].sun, above[i].sun, 1e-3 * (above[i].sun + 1e-3)) << i;
    }
}

// Less and less sunlight enters a layer that repeats as the sun sinks, and no step is seen.
TEST(MarchLight, SunlightFadesAsTheSunSets) {
    const CloudMedium medium = medium_of(two_bodies());
    const BakeOptions options{.threads = kThreads};
    const MarchLight within(medium, kCellsOfPicture, options);
    std::vector<double> sums;
    for (const double height : {1.01, 0.99, 0.5, 0.25, 0.0, -0.25, -0.99, -1.01}) {
        const auto light = within.under({height, 70}, options);
        ASSERT_TRUE(light);
        EXPECT_EQ(sun_depth_at(*light, {0.3F, 0.3F, -0.1F}), 0);  // below the layer
        sums.push_back(0);
        for (const Seen& one : marched(medium, {height, 70}, &*light)) sums.back() += one.sun;
    }
    EXPECT_NEAR(sums[1] / sums[0], 1, 0.05);
    EXPECT_TRUE(std::is_sorted(sums.begin(), sums.begin() + 5, std::greater()));
    EXPECT_TRUE(std::is_sorted(sums.begin() + 4, sums.end()));
    EXPECT_NEAR(sums[7] / sums[6], 1, 0.05);
}

// The same cloud in a tile that stands alone, by paths through a tile with margins without cloud that are wider than
// its shadow.
TEST(MarchLight, LoneTilesHaveNoNeighbours) {
    const CloudLayer layer = two_bodies();
    CloudLayer wide = layer;
    constexpr int kMargin = 2;  // tiles
    const std::array<int, 2> margin = {kMargin * layer.size[0], kMargin * layer.size[1]};
    const glm::dvec3 corner(margin[0], margin[1], 0);
    wide.size = {(2 * kMargin + 1) * layer.size[0], (2 * kMargin + 1) * layer.size[1],
                 layer.size[2]};
    wide.values.assign(occupancy::count_of(wide.size), 0);
    testing::for_each_voxel(layer.size, [&](int x, int y, int z) {
        wide.values[occupancy::index_of(wide.size, x + margin[0], y + margin[1], z)] =
            layer.value(x, y, z);
    });
    const CloudMedium medium = medium_of(layer, false);
    const BakeOptions options{.threads = kThreads};
    const MarchLight within(medium, kCellsOfPicture, options);
    const SunDirection sun{12, 200};
    const auto light = within.under(sun, options);
    ASSERT_TRUE(light);
    const std::vector<Seen> seen = marched(medium, sun, &*light);
    EXPECT_LT(rms_off(wide, sun_of(sun), seen, &Seen::sun, corner), 0.08);

    // Shadows are three tiles long.
    const auto low = within.under({4, 180}, options);
    ASSERT_TRUE(low);
    for (int i = 0; i < low->cells[0]; ++i) {
        const glm::dvec3 share =
            (glm::dvec3(i, 11, 2) + 0.5) / glm::dvec3(low->cells[0], low->cells[1], low->cells[2]);
        const glm::dvec3 place = share * glm::dvec3(layer.size[0], layer.size[1], layer.size[2]);
        EXPECT_NEAR(sun_depth_at(*low, {static_cast<float>(share.x), static_cast<float>(share.y),
                                        static_cast<float>(share.z)}),
                    optical_depth_reference(wide, corner + place, direction_of(4, 180)), 1e-3)
            << i;
    }
    EXPECT_TRUE(within.under({0.1, 0}, options));
}

// Sunlight that a layer of the optical depth 8 above has scattered before is what diffuse light would be.
TEST(MarchLight, LayersAboveDimLight) {
    const CloudLayer layer = two_bodies();
    const CloudMedium medium = medium_of(layer);
    const SunDirection sun{50, 20};
    const BakeOptions options{.threads = kThreads};
    const auto light = MarchLight(medium, kCellsOfDraft, options).under(sun, options);
    ASSERT_TRUE(light);
    const LitRay ray = lit_ray(*light, towards(0.3, 2), 1);
    const std::array<float, 3> place = {0.32F, 0.36F, 0.5F};
    const PointLight alone = light_of(*light, ray, {place, 200, 0, 0.1F});
    const PointLight shaded = light_of(*light, ray, {place, 208, 8, 0.1F});
    EXPECT_NEAR(shaded.sun / alone.sun, 2 / (2 + (1 - mean_cosine(droplet_phase(12))) * 8), 1e-6);
    EXPECT_EQ(shaded.sky, alone.sky);
}

TEST(MarchLight, SkyAndGroundLightCloudsAsByPaths) {
    const CloudLayer layer = two_bodies();
    const CloudMedium medium = medium_of(layer);
    const BakeOptions options{.threads = kThreads};
    const SunDirection sun{50, 20};
    const auto light = MarchLight(medium, kCellsOfPicture, options).under(sun, options);
    ASSERT_TRUE(light);
    const std::vector<Seen> seen = marched(medium, sun, &*light);
    LayerSources sky;
    sky.sky = 1;
    EXPECT_LT(rms_off(layer, sky, seen, &Seen::sky), 0.06);
    LayerSources ground;
    ground.ground = 1;
    EXPECT_LT(rms_off(layer, ground, seen, &Seen::ground), 0.06);
}

}  // namespace
}  // namespace skybake::cloud_light
