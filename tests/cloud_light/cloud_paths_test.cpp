// The paths of light through a layer, against published slabs, doubling, exact single scattering and the
// conservation of energy.
#include "bakers/assets/cloud_light/cloud_paths.h"
#include "config/sections/layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "bakers/assets/cloud_light/depth_reference.h"
#include "bakers/math/parallel.h"
#include "tests/cloud_light/layers.h"
#include "tests/published/published_slabs.h"
#include "tests/support/volumes.h"

namespace skybake::cloud_light {
namespace {

CloudScattering closed(config::Phase phase, double g, double albedo) {
    return {{{1, make_phase_function(phase, g)}}, albedo};
}

// A slab of a vertical optical depth, 4 voxels of 8 m high.
CloudLayer slab(double depth) { return test::layer_of({3, 5, 4}, 1, depth / 32); }

glm::dvec3 direction_of(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

// Traced from above where the eye looks down, from below where it looks up.
TracedRadiance leaving(const CloudPaths& paths, const CloudLayer& layer, const glm::dvec3& look,
                       int count) {
    const double z = look.z < 0 ? layer.size[2] : 0;
    return paths.trace({1.3, 2.2, z}, look, count, 5, 0);
}

void expect_near(const TracedRadiance& found, double wanted, const std::string& what) {
    EXPECT_NEAR(found.sum(), wanted, 4 * found.standard_error) << what;
    EXPECT_LT(found.standard_error, 0.04 * std::fabs(wanted)) << what;
}

// The test problems of DISORT, whose values are those of Sweigart 1970 and van de Hulst 1980: isotropic
// scattering in a slab of depth 32, and Henyey and Greenstein's with g = 0.75, both without absorption.
TEST(CloudPaths, LeaveSlabsAsPublished) {
    for (const char* name : {"1e", "3a"}) {
        const test::Slab& wanted = test::slab_named(name);
        const CloudLayer layer = slab(wanted.depth);
        LayerSources sources;
        sources.sun = wanted.beam;
        sources.sun_direction = direction_of(wanted.sun_cosine, 1);
        const double g = wanted.moments.size() > 1 ? 0.75 : 0;
        const CloudPaths paths(layer, closed(config::Phase::henyey_greenstein, g, 1), sources, 2);
        for (std::size_t i = 1; i < wanted.cosines.size(); ++i) {
            const double cosine = wanted.cosines[i];
            const double turn = 1 + std::numbers::pi / 2;
            expect_near(leaving(paths, layer, direction_of(-cosine, turn), 4000), wanted.up[i],
                        std::string(name) + " up");
            if (wanted.depth < 2) {  // little of the light comes through the other
                expect_near(leaving(paths, layer, direction_of(cosine, turn), 4000), wanted.down[i],
                            std::string(name) + " down");
            }
        }
    }
}

TEST(CloudPaths, LeaveASlabAsDoublingSays) {
    for (const double albedo : {1.0, 0.9}) {
        const std::vector<double> cosines = {0.9, 0.4};
        const test::DoubledSlab wanted(2, albedo, {1, 0, 0.1}, 0.6, std::numbers::pi, cosines);
        const CloudLayer layer = slab(2);
        LayerSources sources;
        sources.sun = std::numbers::pi;
        sources.sun_direction = direction_of(0.6, 0.3);
        const CloudPaths paths(layer, closed(config::Phase::rayleigh, 0, albedo), sources, 2);
        for (std::size_t i = 0; i < cosines.size(); ++i) {
            for (const double turn : {1.0, -0.4}) {
                const double azimuth = 0.3 + std::acos(turn);
                for (const bool up : {true, false}) {
                    const glm::dvec3 look = direction_of(up ? -cosines[i] : cosines[i], azimuth);
                    expect_near(
                        leaving(paths, layer, look, 4000), wanted.leaving(i, up, turn),
                        "cosine " + std::to_string(look.z) + ", turn " + std::to_string(turn));
                }
            }
        }
    }
}

// With an albedo of 1 the layer neither takes nor gives: where all around has the radiance 1, all has.
TEST(CloudPaths, KeepAllLightOfAFurnace) {
    const CloudLayer layer = test::rough_layer({9, 6, 7}, 0.4);
    LayerSources sources;
    sources.sky = 1;
    sources.ground = 1;
    const CloudPaths paths(layer, scattering_of(droplet_phase(12), 1), sources, 2);
    for (const double z : {0.0, 3.4, 7.0}) {
        const TracedRadiance found =
            paths.trace({2, 3, z}, {0.6, 0, z > 3.5 ? -0.8 : 0.8}, 50, 1, 0);
        EXPECT_DOUBLE_EQ(found.sum(), 1) << z;
    }
}

// Light that is scattered once, integrated along the ray with exact depths: 4000 steps of the midpoint
// rule.
double single_scattering(const CloudLayer& layer, const CloudScattering& scattering,
                         const LayerSources& sources, const glm::dvec3& place,
                         const glm::dvec3& look) {
    const double nu = glm::dot(look, sources.sun_direction);
    const glm::dvec3 along = in_voxels(layer, look);
    const double length = (look.z > 0 ? layer.size[2] - place.z : -place.z) / along.z;
    constexpr int kSteps = 4000;
    double depth = 0;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const glm::dvec3 at = place + along * (length * (i + 0.5) / kSteps);
        const double step = extinction_at(layer, at) * length / kSteps;
        sum += step * std::exp(-depth - step / 2 -
                               optical_depth_reference(layer, at, sources.sun_direction));
        depth += step;
    }
    return scattering.albedo * sources.sun * phase_value(scattering, 1 - nu, 1 + nu) * sum;
}

TEST(CloudPaths, ScatterOnceExactly) {
    constexpr int kPaths = 20000;
    CloudLayer layer = test::lone_cloud({12, 10, 8}, {2, 1, 1}, {9, 8, 7});
    for (const bool has_edge : {false, true}) {
        if (has_edge) test::add_edge(0.05, 0.2, layer);
        LayerSources sources;
        sources.sun = 2;
        sources.sun_direction = direction_of(0.5, 1);
        const CloudScattering scattering = scattering_of(droplet_phase(12), 0.95);
        const CloudPaths paths(layer, scattering, sources, 2);
        for (const glm::dvec3& look : {direction_of(0.3, 2), direction_of(-0.7, 4)}) {
            const glm::dvec3 place(4.2, 5.1, look.z > 0 ? 0 : 8);
            const TracedRadiance found = paths.trace(place, look, kPaths, 3, 1);
            const double wanted = single_scattering(layer, scattering, sources, place, look);
            // Each path brings this light or none.
            const double nu = glm::dot(look, sources.sun_direction);
            const double light =
                sources.sun * scattering.albedo * phase_value(scattering, 1 - nu, 1 + nu);
            const double error = std::sqrt(wanted * (light - wanted) / kPaths);
            EXPECT_NEAR(found.first, wanted, 3.5 * error) << has_edge << ' ' << look.z;
            EXPECT_LT(error, 0.05 * wanted);
            EXPECT_GT(found.higher, 0);
        }
    }
}

TEST(CloudPaths, PassWithTheExponentialOfTheDepth) {
    const CloudLayer layer = test::rough_layer({13, 7, 5}, 0.5);
    const CloudPaths paths(layer, scattering_of(droplet_phase(12), 0), {.sky = 1}, 2);
    for (const double cosine : {1.0, 0.3}) {
        const glm::dvec3 place(0.2, 6.9, 0);
        const glm::dvec3 direction = direction_of(cosine, 2);
        const double wanted = std::exp(-optical_depth_reference(layer, place, direction));
        EXPECT_NEAR(paths.trace(place, direction, 40000, 9, 0).seen, wanted, 0.01) << cosine;
        EXPECT_GT(wanted, 0.03);
    }
}

// A layer that is one tile moved over, and one that is four tiles, are the same layer.
TEST(CloudPaths, RepeatTheLayer) {
    const CloudLayer one = test::rough_layer({5, 6, 4}, 0.6);
    CloudLayer four = test::layer_of({10, 12, 4}, 0);
    testing::for_each_voxel({10, 12, 4}, [&](int x, int y, int z) {
        four.values[occupancy::index_of(four.size, x, y, z)] = one.value(x % 5, y % 6, z);
    });
    LayerSources sources;
    sources.sun = 1;
    sources.sun_direction = direction_of(0.4, 1);
    const CloudScattering scattering = closed(config::Phase::henyey_greenstein, 0.5, 1);
    const CloudPaths of_one(one, scattering, sources, 1);
    const CloudPaths of_four(four, scattering, sources, 1);
    const glm::dvec3 look = direction_of(-0.3, 5);
    const TracedRadiance wanted = of_one.trace({1.5, 2.5, 4}, look, 2000, 1, 0);
    for (const glm::dvec3& shift : {glm::dvec3(-10, 12, 0), glm::dvec3(5, -6, 0)}) {
        const TracedRadiance same = of_one.trace(glm::dvec3(1.5, 2.5, 4) + shift, look, 2000, 1, 0);
        EXPECT_NEAR(same.sum(), wanted.sum(), 1e-9);
        const TracedRadiance found =
            of_four.trace(glm::dvec3(1.5, 2.5, 4) + shift, look, 2000, 2, 0);
        EXPECT_NEAR(found.sum(), wanted.sum(),
                    4 * std::hypot(found.standard_error, wanted.standard_error));
    }
}

// Choosing directions about the sun changes the noise, not the mean: the same light by reciprocity.
// A slab reflects as much from a to b as from b to a, times the cosines (Chandrasekhar 1960,
// section 52).
TEST(CloudPaths, AreReciprocal) {
    const CloudLayer layer = slab(6);
    const CloudScattering scattering = scattering_of(droplet_phase(12), 1);
    std::array<TracedRadiance, 2> found;
    const std::array<double, 2> cosines = {0.9, 0.35};
    for (std::size_t i = 0; i < 2; ++i) {
        LayerSources sources;
        sources.sun = 1;
        sources.sun_direction = direction_of(cosines[i], 0);
        const CloudPaths paths(layer, scattering, sources, 2);
        found[i] = leaving(paths, layer, -direction_of(cosines[1 - i], 2), 10000);
        EXPECT_LT(found[i].standard_error, 0.04 * found[i].sum());
    }
    EXPECT_NEAR(
        found[0].sum() / cosines[0], found[1].sum() / cosines[1],
        4 * std::hypot(found[0].standard_error / cosines[0], found[1].standard_error / cosines[1]));
}

TEST(CloudPaths, TakeHardCases) {
    LayerSources sources;
    sources.sun = 1;
    sources.sky = 0.5;
    sources.sun_direction = {0, 0, 1};
    const CloudScattering scattering = scattering_of(droplet_phase(12), 1);
    const CloudLayer empty = test::layer_of({4, 4, 4}, 0);
    const CloudPaths nothing(empty, scattering, sources, 1);
    EXPECT_EQ(nothing.trace({1, 1, 0}, {0, 0, 1}, 4, 0, 0).sum(), 0.5);
    EXPECT_EQ(nothing.trace({1, 1, 4}, {0, 0, -1}, 4, 0, 0).sum(), 0);
    const CloudLayer voxel = test::layer_of({1, 1, 1}, 0.5F);
    const CloudPaths one(voxel, scattering, sources, 1);
    EXPECT_GT(one.trace({0.5, 0.5, 1}, {0, 0.6, -0.8}, 500, 0, 0).sum(), 0);
    CloudLayer opaque = test::rough_layer({6, 6, 6});
    opaque.optics.extinction_per_m = 1e4;
    const CloudPaths thick(opaque, closed(config::Phase::isotropic, 0, 0.9), sources, 1);
    const TracedRadiance found = thick.trace({1, 1, 6}, {0, 0, -1}, 500, 0, 0);
    EXPECT_GT(found.sum(), 0);
    EXPECT_LT(found.sum(), 1);
}

}  // namespace
}  // namespace skybake::cloud_light
