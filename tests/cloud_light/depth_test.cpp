// Optical depths towards the sun: laws of the plain integrator, and the sweep against it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/assets/cloud_light/depth_reference.h"
#include "bakers/assets/cloud_light/depth_sweep.h"
#include "bakers/assets/cloud_light/light_values.h"
#include "bakers/math/quadrature.h"
#include "config/assets/cloud_light.h"
#include "tests/cloud_light/layers.h"
#include "tests/noise/every_target.h"
#include "tests/support/loops.h"

namespace skybake::cloud_light {
namespace {

using test::layer_of;
using test::rough_layer;

constexpr double kDegree = std::numbers::pi / 180;

// --- The plain integrator -----------------------------------------------------------------------

// From +x towards +y, and up.
TEST(Towards, IsTheDirectionOfTheSun) {
    const auto expect = [](const glm::dvec3& found, const glm::dvec3& wanted) {
        for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(found[a], wanted[a], 1e-15);
    };
    expect(towards(0, 0), {1, 0, 0});
    expect(towards(0, 90 * kDegree), {0, 1, 0});
    expect(towards(90 * kDegree, 1), {0, 0, 1});
    expect(towards(30 * kDegree, 180 * kDegree), {-std::sqrt(0.75), 0, 0.5});
}

TEST(DepthReference, OfAUniformSlabIsThicknessOverTheSineOfElevation) {
    const CloudLayer layer = layer_of({5, 3, 7}, 0.5F);
    for (const double elevation : {90.0, 60.0, 20.0, 1.0}) {
        const glm::dvec3 sun = towards(elevation * kDegree, 0.7);
        const double height_m = (7 - 2.25) * 8;
        EXPECT_NEAR(optical_depth_reference(layer, {1.3, 2.9, 2.25}, sun),
                    0.05 * 0.5 * height_m / std::sin(elevation * kDegree), 1e-9)
            << elevation;
    }
}

// Seen from above, the trilinear filter spreads a voxel over two voxels' edges as a hat of height 1:
// its integral through the centre is one voxel's edge.
TEST(DepthReference, OfASingleVoxelIsItsHat) {
    CloudLayer layer = layer_of({6, 6, 6}, 0);
    layer.values[occupancy::index_of(layer.size, 2, 3, 2)] = 1;
    const glm::dvec3 up(0, 0, 1);
    EXPECT_NEAR(optical_depth_reference(layer, {2.5, 3.5, 0}, up), 0.05 * 8, 1e-12);
    EXPECT_NEAR(optical_depth_reference(layer, {3, 3.5, 0}, up), 0.05 * 8 / 2, 1e-12);
    EXPECT_NEAR(optical_depth_reference(layer, {2.5, 3.5, 2.5}, up), 0.05 * 8 / 2, 1e-12);
    EXPECT_EQ(optical_depth_reference(layer, {3.5, 3.5, 0}, up), 0);
}

// Along z lookups are clamped: the outermost half voxels have the value of the outermost centres.
TEST(DepthReference, TheOutermostHalfVoxelsAreUniform) {
    CloudLayer layer = layer_of({2, 2, 4}, 0);
    testing::for_each_texel(
        2, 2, [&](int x, int y) { layer.values[occupancy::index_of(layer.size, x, y, 3)] = 1; });
    EXPECT_NEAR(optical_depth_reference(layer, {1, 1, 3.5}, {0, 0, 1}), 0.05 * 8 / 2, 1e-12);
    EXPECT_NEAR(optical_depth_reference(layer, {1, 1, 0}, {0, 0, 1}), 0.05 * 8, 1e-12);
}

TEST(DepthReference, AddsUpAlongARay) {
    const CloudLayer layer = rough_layer({5, 4, 9});
    const glm::dvec3 sun = towards(25 * kDegree, 2.1);
    const glm::dvec3 from(1.2, 3.4, 0.3);
    // The upper part begins a whole number of voxel planes higher, so that no piece is cut.
    const double t = (4.5 - from.z) / in_voxels(layer, sun).z;
    const glm::dvec3 higher = from + in_voxels(layer, sun) * t;
    const QuadratureRule rule = gauss_legendre(64);
    double lower = 0;
    constexpr int kPieces = 200;
    for (int i = 0; i < kPieces; ++i) {
        for (std::size_t k = 0; k < rule.nodes.size(); k += 1) {
            const double at = t * (i + rule.nodes[k]) / kPieces;
            lower += rule.weights[k] * t / kPieces *
                     extinction_at(layer, from + in_voxels(layer, sun) * at);
        }
    }
    EXPECT_NEAR(optical_depth_reference(layer, from, sun),
                lower + optical_depth_reference(layer, higher, sun), 1e-6);
}

TEST(DepthReference, RepeatsWithTheTile) {
    const CloudLayer layer = rough_layer({5, 4, 9});
    const glm::dvec3 sun = towards(10 * kDegree, 4);
    const double depth = optical_depth_reference(layer, {0.2, 3.9, 1}, sun);
    EXPECT_NEAR(optical_depth_reference(layer, {5.2, -0.1, 1}, sun), depth, 1e-9 * depth);
}

TEST(DepthReference, AppliesTheThresholdAfterFiltering) {
    CloudLayer layer = layer_of({3, 3, 4}, 0.5F);
    test::add_edge(0.3, 0.4, layer);
    const double x = 0.5;
    const double density = 0.5 * x * x * (3 - 2 * x);
    EXPECT_NEAR(optical_depth_reference(layer, {1, 1, 0}, {0, 0, 1}), 0.05 * density * 32, 1e-9);
    test::add_edge(0.5, 0, layer);
    EXPECT_EQ(optical_depth_reference(layer, {1, 1, 0}, {0, 0, 1}), 0);
    test::add_edge(0.4999, 0, layer);
    EXPECT_NEAR(optical_depth_reference(layer, {1, 1, 0}, {0, 0, 1}), 0.05 * 0.5 * 32, 1e-6);
}

// --- The sweep ----------------------------------------------------------------------------------

std::vector<float> swept(const CloudLayer& layer, const PlaceGrid& places, const glm::dvec3& sun) {
    const DepthSweep sweep(layer, places, 2);
    const std::vector<SweepRays> rays = sweep.rays(sun);
    std::vector<float> depths(occupancy::count_of(places.count));
    for (int z = 0; z < places.count[2]; ++z) {
        for (int y = 0; y < places.count[1]; ++y) {
            sweep.row(rays[static_cast<std::size_t>(z)], y,
                      depths.data() + occupancy::index_of(places.count, 0, y, z));
        }
    }
    return depths;
}

// The largest difference from the plain integrator at some places, over the largest depth.
double largest_error(const CloudLayer& layer, const PlaceGrid& places, const glm::dvec3& sun,
                     int count = 40) {
    const std::vector<float> depths = swept(layer, places, sun);
    double error = 0;
    double largest = 0;
    for (int i = 0; i < count; ++i) {
        std::array<int, 3> at{};
        for (std::size_t a = 0; a < 3; ++a) {
            at[a] = static_cast<int>(low_discrepancy_point(i)[a] * places.count[a]);
        }
        const double wanted =
            optical_depth_reference(layer, places.place(at[0], at[1], at[2]), sun);
        const double found = depths[occupancy::index_of(places.count, at[0], at[1], at[2])];
        error = std::max(error, std::fabs(found - wanted));
        largest = std::max(largest, wanted);
    }
    return largest > 0 ? error / largest : error;
}

TEST(DepthSweep, IsTheIntegralAlongEachRay) {
    for (const std::array<int, 3>& size :
         {std::array{16, 12, 9}, std::array{7, 5, 4}, std::array{130, 3, 2}, std::array{1, 1, 1},
          std::array{2, 1, 5}, std::array{1, 9, 1}}) {
        const CloudLayer layer = rough_layer(size);
        for (const int apart : {1, 2, 3}) {
            for (const double elevation : {90.0, 45.0, 7.0, 1.0}) {
                for (const double azimuth : {0.0, 0.9, 3.7}) {
                    const glm::dvec3 sun = towards(elevation * kDegree, azimuth);
                    EXPECT_LT(largest_error(layer, place_grid(size, apart, false), sun, 6), 2e-6)
                        << size[0] << 'x' << size[1] << 'x' << size[2] << " apart " << apart
                        << " sun " << elevation << ' ' << azimuth;
                }
            }
        }
    }
}

TEST(DepthSweep, BeginsAtTheBaseForAShadow) {
    const CloudLayer layer = rough_layer({12, 8, 6});
    const PlaceGrid places = place_grid(layer.size, 2, true);
    EXPECT_EQ(places.count, (std::array{6, 4, 1}));
    EXPECT_LT(largest_error(layer, places, towards(0.6, 1.1)), 1e-6);
}

// A hard threshold is a jump that no quadrature sees exactly.
TEST(DepthSweep, FindsEdgesOfNoise) {
    CloudLayer layer = rough_layer({12, 8, 6});
    for (const auto& [softness, most] : {std::pair{0.2, 3e-3}, {0.0, 1e-2}}) {
        test::add_edge(0.4, softness, layer);
        EXPECT_LT(largest_error(layer, place_grid(layer.size, 1, false), towards(0.6, 1.1)), most);
    }
}

// Rows in empty cells are left out, and nothing else: light falls into the shadow of a lone cloud
// from as far away as the tile repeats.
TEST(DepthSweep, LeavesOutNothingButEmptyCells) {
    for (const double elevation : {80.0, 30.0, 3.0}) {
        CloudLayer layer = test::lone_cloud({48, 40, 24}, {30, 17, 9}, {33, 18, 11});
        const glm::dvec3 sun = towards(elevation * kDegree, 0.4);
        EXPECT_LT(largest_error(layer, place_grid(layer.size, 2, false), sun, 400), 2e-6);
        test::add_edge(0.1, 0.3, layer);
        EXPECT_LT(largest_error(layer, place_grid(layer.size, 2, false), sun, 100), 1e-2);
    }
}

// A block of places sees only a part of a long row: clouds in any cell of it, and across its ends.
TEST(DepthSweep, SeesTheCellsAtBothEndsOfABlock) {
    for (const int first : {0, 56, 119, 120, 127, 128, 136, 248, 256, 280}) {
        const CloudLayer layer = test::lone_cloud({288, 3, 6}, {first, 0, 2}, {first + 8, 3, 4});
        for (const int apart : {1, 2}) {
            for (const double elevation : {90.0, 20.0}) {
                const PlaceGrid places = place_grid(layer.size, apart, false);
                const glm::dvec3 sun = towards(elevation * kDegree, 3.0);
                const std::vector<float> depths = swept(layer, places, sun);
                for (int x = 0; x < places.count[0]; ++x) {
                    EXPECT_NEAR(depths[occupancy::index_of(places.count, x, 0, 0)],
                                optical_depth_reference(layer, places.place(x, 0, 0), sun), 2e-6)
                        << first << " apart " << apart << " sun " << elevation << " x " << x;
                }
            }
        }
    }
}

TEST(DepthSweep, OfNothingIsExactlyZero) {
    CloudLayer layer = layer_of({20, 20, 20}, 0);
    for (const bool has_edge : {false, true}) {
        layer.optics.has_edge = has_edge;
        for (const float depth : swept(layer, place_grid(layer.size, 2, false), towards(0.2, 1))) {
            ASSERT_EQ(depth, 0);
        }
    }
}

TEST(DepthSweep, StaysFiniteAtExtremeExtinction) {
    CloudLayer layer = rough_layer({8, 8, 8});
    for (const double extinction : {1e-12, 1e6}) {
        layer.optics.extinction_per_m = extinction;
        EXPECT_LT(largest_error(layer, place_grid(layer.size, 1, false), towards(0.02, 1)), 2e-6);
    }
}

TEST(DepthSweep, GivesTheSameBitsWithEveryInstructionSet) {
    CloudLayer layer = rough_layer({150, 3, 5}, 0.4);
    const PlaceGrid places = place_grid(layer.size, 2, false);
    for (const bool has_edge : {false, true}) {
        if (has_edge) test::add_edge(0.2, 0.3, layer);
        const std::vector<float> best = swept(layer, places, towards(0.4, 1));
        test::on_every_target([&](const char* target) {
            EXPECT_EQ(swept(layer, places, towards(0.4, 1)), best) << target;
        });
    }
}

TEST(DepthSweep, GivesTheSameBitsForAnyNumberOfThreads) {
    const CloudLayer layer = rough_layer({40, 24, 10}, 0.4);
    config::CloudLightBake bake;
    bake.sun_elevations = {{0.3}, {0.9}, {1.4}};
    const PlaceGrid places = place_grid(layer.size, 2, false);
    BakeOptions one;
    one.threads = 1;
    BakeOptions five;
    five.threads = 5;
    EXPECT_EQ(light_values(layer, places, light_channels(bake), one),
              light_values(layer, places, light_channels(bake), five));
}

}  // namespace
}  // namespace skybake::cloud_light
