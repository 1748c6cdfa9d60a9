#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bakers/assets/cloud_light/march_light.h"
#include "bakers/march/layer_march.h"
#include "bakers/march/sun_leaps.h"
#include "tests/preview/cloud_views.h"
#include "tests/preview/clouds.h"
#include "tests/preview/scenes.h"
#include "tests/support/light_in_cloud_reference.h"

namespace skybake {

namespace {

using namespace test;

// How far a march towards the sun goes.

// 1200 x 900 x 600 m.
CloudMedium block(bool repeats) {
    const std::vector<float> voxels(8, 1.0F);
    return cloud_medium(test::cloud_of({1200, 900, 600}, 500), voxels.data(), {2, 2, 2}, 1, 1,
                        repeats);
}

// A march from the base to the top, whose sides are 600 m and 600 m / tan: 1200 m at 30 degrees.
TEST(SunMarch, EndsWhereSunlightEnters) {
    for (const bool repeats : {true, false}) {
        const CloudMedium medium = block(repeats);
        EXPECT_NEAR(sun_march_length_m(medium, {90, 0}), 600, 1e-9);
        EXPECT_NEAR(sun_march_length_m(medium, {45, 20}), 600 * std::sqrt(2), 1e-9);
        EXPECT_NEAR(sun_march_length_m(medium, {30.1, 20}), 1200, 5);
    }
    EXPECT_NEAR(sun_march_length_m(block(true), {-45, 20}), 600 * std::sqrt(2), 1e-9);
}

// Under a lower sun it ends after the longer edge of a tile, and after the diagonal of one that stands alone.
TEST(SunMarch, IsNotLongerThanATile) {
    for (const double elevation : {20.0, 1.0, 0.0, -5.0}) {
        EXPECT_NEAR(sun_march_length_m(block(true), {elevation, 20}), 1200, 1e-9) << elevation;
        EXPECT_NEAR(sun_march_length_m(block(false), {elevation, 20}), 1500, 1e-9) << elevation;
    }
}

// Every sample that is left out is in an empty cell.
RC_GTEST_PROP(SunLeaps, LeaveOutEmptyCellsAlone, ()) {
    const int cell = *rc::gen::element(1, 2, 4);
    const std::array<int, 3> size = {cell * any_count(1, 12), cell * any_count(1, 12),
                                     any_count(1, 24)};
    const auto voxels =
        clumped_voxels(size, static_cast<std::uint32_t>(any_count(0, 1 << 20)), 0.1);
    const CloudMedium medium = medium_of(cloud_of({1000, 1000, 500}), size, voxels, cell);
    const LeapGrid& grid = medium.leaps;
    const glm::dvec3 step = {any_number(-2, 2), any_number(-2, 2),
                             *rc::gen::element(-1.5, 0.0, 0.01, 0.7)};
    const auto leaps = sun_leaps(grid, size, step, 40, 1);
    for (int i = 0; i < 200; ++i) {
        const std::array<double, 3> place = {any_number(0, 1) * size[0], any_number(0, 1) * size[1],
                                             any_number(0, 1) * size[2]};
        const auto reach_at = [&](double k, bool& inside) {
            std::array<int, 3> index{};
            for (std::size_t a = 0; a < 3; ++a) {
                const double at = std::floor(place[a] + k * step[a]);
                const int voxel = static_cast<int>(at);
                if (a == 2) inside = voxel >= 0 && voxel < size[2];
                index[a] = (a < 2 ? occupancy::wrapped(voxel, size[a])
                                  : occupancy::clamped(voxel, size[a])) /
                           cell;
            }
            return occupancy::index_of(grid.cells, index[0], index[1], index[2]);
        };
        bool inside = true;
        const float leap = leaps[reach_at(0, inside)];
        RC_ASSERT((leap < 0) == (grid.reach[reach_at(0, inside)] < 0));
        for (int k = 1; k <= std::min(static_cast<int>(leap), 40); ++k) {
            const std::size_t there = reach_at(k, inside);
            RC_ASSERT(!inside || grid.reach[there] >= 0);
        }
    }
}

// Straight up from an empty plane below an empty one nothing is met.
TEST(SunLeaps, SeeFartherThanTheNearestCell) {
    const std::array<int, 3> size = {16, 16, 16};
    std::vector<float> voxels(16 * 16 * 16);
    voxels[occupancy::index_of(size, 1, 1, 1)] = 1;
    const CloudMedium medium = medium_of(cloud_of({1000, 1000, 1000}), size, voxels, 2);
    const auto leaps = sun_leaps(medium.leaps, size, {0, 0, 0.5}, 100, 1);
    const auto at = [&](int x, int y, int z) {
        return leaps[occupancy::index_of(medium.leaps.cells, x, y, z)];
    };
    EXPECT_EQ(at(0, 0, 0), -1);
    EXPECT_EQ(at(0, 0, 4), 100);
    EXPECT_EQ(at(4, 4, 0), 100);
}

// A tile that stands alone is lit from the side by a sun on the horizon as by one just above and below it.
TEST(LightInCloud, GoesOnThroughTheHorizon) {
    constexpr std::array<int, 3> kSize = {12, 12, 10};
    CloudMedium medium =
        test::medium_of({1000, 1000, 800}, 500, kSize, test::clumped_voxels(kSize, 7, 0.5), 0.01);
    medium.repeats = false;
    const BakeOptions options{.threads = 2};
    const cloud_light::MarchLight within(medium, cloud_light::kCellsOfPicture, options);
    const auto above = within.under({0.01, 50}, options), on = within.under({0, 50}, options);
    ASSERT_TRUE(above && on);
    double greatest = 0, largest = 0;
    for (std::size_t i = 0; i < on->values.size(); ++i) {
        greatest = std::max(greatest, std::fabs(double{above->values[i]}));
        largest = std::max(largest, std::fabs(double{on->values[i]} - double{above->values[i]}));
    }
    EXPECT_GT(greatest, 0.05);
    EXPECT_LT(largest, 0.01 * greatest);
}

// Lookups of solved light, place by place, against their definition in double.

// Places anywhere in an uneven cloud, beyond the middles of its outermost cells too, seen from all around; among
// them are rays a tenth of a degree beside the sun. Points stand for little of their rays.
TEST(LightInCloud, IsItsDefinition) {
    constexpr std::array<int, 3> kSize = {20, 14, 10};
    const CloudMedium medium =
        test::medium_of({1000, 700, 500}, 500, kSize, test::clumped_voxels(kSize, 7, 0.5), 0.01);
    const BakeOptions options{.threads = 2};
    const SunDirection sun{30, 50};
    const auto light =
        cloud_light::MarchLight(medium, cloud_light::kCellsOfPicture, options).under(sun, options);
    ASSERT_TRUE(light);
    const glm::dvec3 to_sun = direction_of(sun.elevation_degrees, sun.azimuth_degrees);
    for (int i = 0; i < 400; ++i) {
        const auto share = [i](double step) { return std::fmod(0.5 + i * step, 1.0); };
        const glm::dvec3 place(share(0.754878), share(0.569840), share(0.618034));
        const double near = i % 4 == 0 ? 0.1 : 400 * share(0.324718);  // degrees
        const glm::dvec3 look = direction_of(sun.elevation_degrees + near * share(0.8191725),
                                             sun.azimuth_degrees + near);
        const double tau = i % 5 == 0 ? 0 : 12 * share(0.6710436);
        const double beyond = tau / 3;
        const double offset = one_minus_cosine(look, to_sun);
        const LitPoint point = {
            {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)},
            static_cast<float>(tau),
            static_cast<float>(beyond),
            0.01F};
        const PointLight found = light_of(*light, lit_ray(*light, look, offset), point);
        const ReferenceLight wanted = reference_light(*light, look, offset, place, {tau, beyond});
        // F is even between two rows of its table; beside the sun it falls by 2 % from the first to the second.
        const double between = i % 4 == 0 ? 0.015 : 0.002;
        const double once = reference_light(*light, look, offset, place, {0, 0}).sun;
        EXPECT_NEAR(found.sun, wanted.sun, 5e-3 * std::fabs(wanted.sun) + between * once) << i;
        EXPECT_NEAR(found.sky, wanted.sky, 1e-5) << i;
        EXPECT_NEAR(found.ground, wanted.ground, 1e-5) << i;
    }
}

}  // namespace

}  // namespace skybake
