// Where clouds go wrong: towers of any width, thresholds that voxels hold, extents of any size.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/clouds/cloud_reference.h"
#include "bakers/math/quadrature.h"
#include "config/assets/cloud_volume.h"
#include "tests/clouds/cloud_specification.h"
#include "tests/clouds/clouds.h"
#include "tests/support/hard_case.h"

namespace skybake::cloud {
namespace {

using config::Tower;
using test::CloudCase;
using test::hold;
using test::plain_case;
using test::tower;

double relative_error(Tower any, int rows, int columns) {
    const double wanted = 2 * std::numbers::pi * any.sigma[0] * any.sigma[1] * any.amplitude *
                          std::sqrt(1 - any.correlation * any.correlation);
    return std::fabs(test::mean_over_tile(TowerField(std::array{any}), rows, columns) / wanted - 1);
}

TEST(TowerHardCases, IntegrateToTheirVolume) {
    hold("tower of sigma 0.05, 0.09", "2 pi sx sy a",
         relative_error(tower(0.3, 0.7, 0.05, 0.09, 0.4), 100, 100), 1e-10);
    Tower turned = tower(0.3, 0.7, 0.04, 0.2, 0.4);
    turned.rotation.radians = 0.7;
    turned.correlation = -0.8;
    hold("tower turned by 40 deg, correlation -0.8", "2 pi sx sy a sqrt(1 - c^2)",
         relative_error(turned, 400, 400), 1e-10);
    hold("tower on the corner of the tile", "2 pi sx sy a",
         relative_error(tower(0, 1, 0.05, 0.09, 0.4), 100, 100), 1e-10);
    hold("tower of sigma 3e-4", "2 pi sx sy a",
         relative_error(tower(0.3, 0.7, 3e-4, 3e-4, 0.4), 8192, 8192), 1e-10);
    hold("tower of sigma 6 tiles: constant", "2 pi sx sy a",
         relative_error(tower(0.3, 0.7, 6, 6, 0.4), 10, 10), 1e-12);
    hold("tower of sigma 16 by 0.01 tiles", "2 pi sx sy a",
         relative_error(tower(0.3, 0.7, 16, 0.01, 0.4), 300, 10), 1e-10);
}

TEST(TowerHardCases, LeaveNoSeam) {
    double largest = 0;
    for (const Tower& any : {tower(0, 0, 0.03, 0.06, 0.4), tower(0.99, 0.01, 0.2, 0.02, 1),
                             tower(0.5, 0.5, 3, 0.5, 1), tower(1, 1, 1e-5, 1e-5, 1)}) {
        const TowerField field(std::array{any});
        for (int i = 0; i < 1000; ++i) {
            const auto [t, u, unused] = low_discrepancy_point(i);
            static_cast<void>(unused);
            std::array<double, 4> values{};
            field.add_row(t, std::array{0.0}, &values[0]);
            field.add_row(t, std::array{1.0}, &values[1]);
            field.add_row(0, std::array{u}, &values[2]);
            field.add_row(1, std::array{u}, &values[3]);
            largest = std::max(
                {largest, std::fabs(values[0] - values[1]), std::fabs(values[2] - values[3])});
        }
    }
    hold("towers on corners and edges, seams", "a tile further on", largest, 1e-10);
}

// Returns the share of voxels that are not what they should be.
template <class Wanted>
double share_wrong(const CloudCase& any, const Wanted& wanted) {
    const std::vector<float> values = test::densities_of(any);
    return static_cast<double>(std::ranges::count_if(values, std::not_fn(wanted))) /
           static_cast<double>(values.size());
}

TEST(CloudHardCases, ThresholdsThatVoxelsHold) {
    CloudCase any = plain_case({17, 9, 5});
    any.base = test::noise_of({test::channel_of(config::NoiseType::constant, {{1, 1, 1}})});
    any.base.channels[0].value = 0.5;
    any.cloud.threshold = 0.5;
    any.cloud.edge_softness = 0;
    hold("every voxel equal to the threshold, hard edge", "0 everywhere",
         share_wrong(any, [](float v) { return v == 0; }), 0);
    any.cloud.edge_softness = 0.25;
    hold("every voxel equal to the threshold, soft edge", "0 everywhere",
         share_wrong(any, [](float v) { return v == 0; }), 0);
    any.cloud.threshold = 0.4999;
    any.cloud.edge_softness = 0;
    hold("threshold just below every voxel, hard edge", "0.5 everywhere",
         share_wrong(any, [](float v) { return v == 0.5f; }), 0);
    any.cloud.threshold = 0;
    hold("threshold 0, hard edge", "0.5 everywhere",
         share_wrong(any, [](float v) { return v == 0.5f; }), 0);
    any.cloud.threshold = 1;
    hold("threshold 1", "0 everywhere", share_wrong(any, [](float v) { return v == 0; }), 0);
    any.base.channels[0].value = 1;
    hold("threshold 1 with voxels of 1", "0 everywhere",
         share_wrong(any, [](float v) { return v == 0; }), 0);
}

TEST(CloudHardCases, EmptyAndFull) {
    CloudCase any = plain_case({40, 20, 12});
    any.cloud.coverage = 0;
    const CloudField empty(any.plan());
    EXPECT_TRUE(empty.is_empty({{}, any.size}));
    hold("empty cloud", "0 everywhere", share_wrong(any, [](float v) { return v == 0; }), 0);
    any.cloud.coverage = 1;
    any.cloud.threshold = 0;
    any.cloud.edge_softness = 0;
    hold("full cloud", "above 0 everywhere", share_wrong(any, [](float v) { return v > 0; }), 0);
}

// Voxels a tile apart, as the specification finds them at other lattice coordinates.
TEST(CloudHardCases, TilesToTheBit) {
    CloudCase any = plain_case({30, 14, 6});
    any.cloud.towers = {tower(0, 0, 0.1, 0.2, 0.4), tower(0.95, 0.5, 0.05, 0.3, 0.4)};
    any.maps.coverage = test::small_map(config::MapWrap::repeat, config::MapFilter::linear);
    const CloudPlan plan = any.plan();
    double largest = 0;
    for (int y = 0; y < 14; ++y) {
        for (int x = 0; x < 30; ++x) {
            for (int z = 0; z < 6; ++z) {
                const float here = cloud_at(plan, {x, y, z})[0];
                largest =
                    std::max({largest, std::fabs(double{here} - cloud_at(plan, {x + 30, y, z})[0]),
                              std::fabs(double{here} - cloud_at(plan, {x, y - 14, z})[0])});
            }
        }
    }
    hold("cloud with towers and map over the tile's edge", "the voxels a tile further on", largest,
         1e-6);
}

// Bounds that are as tight as they can be, about a tower that just reaches the threshold.
TEST(CloudHardCases, BoundsTakeNothingAway) {
    double lost = 0;
    for (const double threshold : {0.05, 0.2, 0.39, 0.5, 0.7}) {
        CloudCase any = plain_case({97, 50, 20});
        any.cloud.threshold = threshold;
        any.cloud.edge_softness = 0;
        any.cloud.height_profile.type = config::HeightProfileType::thesis;
        any.cloud.towers = {tower(0.2, 0.3, 0.03, 0.06, 0.4), tower(0.99, 0.5, 0.05, 0.05, 0.9)};
        const std::vector<float> wanted = test::specified(any.plan(), {{}, any.size})[0];
        lost += std::transform_reduce(wanted.begin(), wanted.end(), test::densities_of(any).begin(),
                                      0.0, std::plus(), std::not_equal_to());
    }
    hold("regions proved empty by bounds", "voxel by voxel, voxels unlike", lost, 0);
}

config::Outcome<Baked> baked(const CloudCase& any, config::PixelType type) {
    config::CloudVolumeBake bake;
    bake.size = any.size;
    bake.pixel_type = type;
    Baked volume;
    volume.name = "c";
    return bake_cloud_volume(any.cloud, bake,
                             {&any.base, nullptr, std::nullopt, any.detail_noise(), any.maps, {}},
                             {}, std::move(volume));
}

TEST(CloudHardCases, ExtentsFromAMetreToAThousandKilometres) {
    double largest = 0;
    for (const double edge : {1.0, 1e6}) {
        CloudCase any = plain_case({8, 8, 8});
        any.cloud.extent = {{{edge}, {edge}, {edge / 4}}};
        any.cloud.base_altitude = {-0.1};
        const auto outcome = baked(any, config::PixelType::half);
        ASSERT_TRUE(outcome.value);
        largest = std::max(largest, std::fabs(outcome.value->voxel_size_m[0] / (edge / 8) - 1));
        largest = std::max(largest, std::fabs(outcome.value->voxel_size_m[2] / (edge / 32) - 1));
        EXPECT_EQ(outcome.value->minimum_m[2], -0.1);
        EXPECT_EQ(outcome.value->axes[2].last, -0.1 + edge / 4);
    }
    hold("extents of 1 m and of 1000 km", "voxels' edges", largest, 1e-15);
}

TEST(CloudHardCases, AmplitudesThatOverflowHalf) {
    CloudCase any = plain_case({16, 16, 4});
    any.cloud.towers = {tower(0.5, 0.5, 0.2, 0.2, 1e6)};
    const auto refused = baked(any, config::PixelType::half);
    ASSERT_FALSE(refused.value);
    EXPECT_EQ(refused.diagnostics.at(0).code, "E0402");
    EXPECT_TRUE(baked(any, config::PixelType::float32).value);
    any.cloud.towers[0].amplitude = 100;
    EXPECT_TRUE(baked(any, config::PixelType::half).value);
}

// Density after a soft edge from 0.35 to 0.40, from a value stored as a pixel type.
TEST(CloudHardCases, QuantisationBeforeTheEdge) {
    const auto density = [](double v) {
        const double x = std::clamp((v - 0.35) / 0.05, 0.0, 1.0);
        return v * x * x * (3 - 2 * x);
    };
    double rounded = 0;
    double truncated = 0;
    for (int i = 0; i <= 100000; ++i) {
        const double v = 0.34 + 0.07 * i / 100000;
        rounded = std::max(rounded, std::fabs(density(std::round(v * 255) / 255) - density(v)));
        truncated = std::max(truncated, std::fabs(density(std::floor(v * 255) / 255) - density(v)));
    }
    hold("edge 0.35 to 0.40 on 8 bits, rounded", "density of the exact value", rounded, 0.024);
    hold("edge 0.35 to 0.40 on 8 bits, truncated", "density of the exact value", truncated, 0.047);
}

}  // namespace
}  // namespace skybake::cloud
