// Tests the promise of a texture of distances: no lookup of it is farther from 0 than the distance to the
// cloud of the filtered volume.
#include "bakers/occupancy/stored_distance.h"
#include "config/assets/cloud_distance.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bakers/assets/cloud_distance/distance_check.h"
#include "bakers/math/quadrature.h"
#include "bakers/occupancy/distance_volume.h"
#include "tests/occupancy/distance_trial.h"
#include "tests/support/every_target.h"

namespace skybake::occupancy {
namespace {

using config::DistanceContent;
using namespace test;
using Trial = test::DistanceTrial;

Trial any_trial() {
    CellGrid grid;
    grid.cell = *rc::gen::element(1, 2, 4);
    grid.voxels = {grid.cell * *rc::gen::inRange(1, 9), grid.cell * *rc::gen::inRange(1, 9),
                   *rc::gen::inRange(1, 24)};
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const auto edge = [] { return *rc::gen::element(1.0, 7.5, 40.0); };
    return Trial(balls(grid, seed, *rc::gen::inRange(0, 4), *rc::gen::element(1.5, 6.0, 20.0)),
                 {edge(), edge(), edge()},
                 *rc::gen::element(PixelType::unorm8, PixelType::unorm16, PixelType::half,
                                   PixelType::float32),
                 *rc::gen::element(0.0F, 0.3F));
}

// Rows are coded by vectors, of any length and on every instruction set.
TEST(DistanceCode, OfARowIsThatOfEachDistance) {
    std::vector<float> squares = {0, std::numeric_limits<float>::infinity(), 1e-30F, 1e30F};
    for (int i = 0; i < 2000; ++i) squares.push_back(static_cast<float>(i * i) * 0.37F);
    for (const PixelType type :
         {PixelType::unorm8, PixelType::unorm16, PixelType::half, PixelType::float32}) {
        const DistanceCode code({-200, 700}, {11, 9.7, 4.1}, type);
        std::vector<float> wanted;
        for (const float square : squares) wanted.push_back(code.outside(square));
        test::on_every_target([&](const char* target) {
            for (const std::size_t count : {squares.size(), std::size_t{1}, std::size_t{13}}) {
                std::vector<float> found(squares.size(), -1);
                code.outside(squares.data(), count, found.data());
                std::vector<float> expected(squares.size(), -1);
                std::copy_n(wanted.begin(), count, expected.begin());
                EXPECT_EQ(found, expected) << target;
            }
        });
    }
}

// The filtered volume itself is the judge here: along a step in any direction there is nothing, and
// around a place in the cloud there is cloud. Places beyond base and top hold none.
TEST(StoredDistance, IsNeverTooFarForTheFilteredVolume) {
    EXPECT_TRUE(rc::check([] {
        const Trial trial = any_trial();
        const std::array<int, 3>& size = trial.volume.grid.voxels;
        const double zero = std::min(0.0, trial.code.metres(double{trial.code.surface()})) - 0.01;
        for (int i = 0; i < 60; ++i) {
            Point place = low_discrepancy_point(*rc::gen::inRange(0, 1 << 20));
            for (std::size_t a = 0; a < 3; ++a) place[a] *= size[a];
            const double distance = trial.look_up(place);
            for (int j = 0; j < 60; ++j) {
                const Point share = low_discrepancy_point(60 * i + j);
                const double cosine = 2 * share[0] - 1;
                const double sine = std::sqrt(1 - cosine * cosine);
                const double reach = std::fabs(distance) * (1 - share[2] * share[2]);
                const Point way = {sine * std::cos(6.2831853 * share[1]),
                                   sine * std::sin(6.2831853 * share[1]), cosine};
                Point at = place;
                for (std::size_t a = 0; a < 3; ++a) at[a] += reach * way[a] / trial.voxel_m[a];
                const bool is_within = at[2] >= 0 && at[2] <= size[2];
                if (distance > 0.01) RC_ASSERT(!is_within || !trial.is_cloud(at));
                if (distance < zero) RC_ASSERT(is_within && trial.is_cloud(at));
            }
        }
    }));
}

TEST(StoredDistance, HoldsItsOwnCheck) {
    EXPECT_TRUE(rc::check([] {
        const DistanceCheckResult found = any_trial().check(400);
        RC_ASSERT(found.points == 400);
        RC_ASSERT(found.too_far == 0 && found.too_near == 0 && found.lost_steps == 0);
    }));
}

TEST(StoredDistance, RaysLoseNoStep) {
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16, PixelType::half}) {
        const Trial trial = field(type);
        std::int64_t steps = 0;
        EXPECT_EQ(steps_that_lose(trial, 3400, steps), 0);
        EXPECT_GT(steps, 3000);
    }
}

TEST(SlowStoredDistance, AMillionRaysLoseNoStep) {
    const Trial trial = field();
    std::int64_t steps = 0;
    EXPECT_EQ(steps_that_lose(trial, 1000000, steps), 0);
    EXPECT_GT(steps, 1000000);
}

TEST(StoredDistance, NubisRangeHoldsZero) {
    const std::array<double, 3> texel = {40, 40, 40};
    EXPECT_EQ(DistanceCode({-256, 4096}, texel, PixelType::unorm16).surface(), 3855.0F / 65535);
    EXPECT_EQ(DistanceCode({-256, 4096}, texel, PixelType::unorm8).surface(), 15.0F / 255);
    EXPECT_EQ(DistanceCode({-256, 4096}, texel, PixelType::half).surface(), 0);
    // 240 / 4240 lies between two steps: the lower one stands for 0.
    const DistanceCode other({-240, 4000}, texel, PixelType::unorm8);
    EXPECT_EQ(other.surface(), 14.0F / 255);
    EXPECT_LE(other.metres(double{other.surface()}), 0);
}

float square(double metres) { return static_cast<float>(metres * metres); }

// Half a diagonal of these texels is 20 sqrt(3) m; curvature takes (20^2 * 3 + 40^2 / 8) / (2 r).
TEST(StoredDistance, IsTheDistanceLessWhatALookupAdds) {
    const DistanceCode code({-256, 4096}, {40, 40, 40}, PixelType::float32);
    const double half = 20 * std::sqrt(3.0);
    const double place = half / 128;
    EXPECT_NEAR(code.outside(square(1000)), 1000 - 700 / (1000 - 2 * half) - place, 0.02);
    EXPECT_NEAR(code.outside(square(3.01 * half)), 3.01 * half - 700 / (1.01 * half) - place, 0.02);
    EXPECT_NEAR(code.inside(square(200)), 700 / (200 - 2 * half) + place - 200, 0.02);
    EXPECT_NEAR(code.outside(square(2.5 * half)), 0.5 * half - place, 0.02);
    EXPECT_EQ(code.outside(square(2 * half)), 0);
    EXPECT_EQ(code.outside(square(1e6)), 4096);
    EXPECT_EQ(code.inside(square(1e6)), -256);
    EXPECT_EQ(code.outside(std::numeric_limits<float>::infinity()), 4096);
}

// Whatever steps a type has, the value that it stores is nearer to 0 than the one of a float, by one
// step at most.
TEST(StoredDistance, IsRoundedTowardsZero) {
    EXPECT_TRUE(rc::check([] {
        const std::array<double, 2> range = {-1.0 * *rc::gen::inRange(0, 500),
                                             1.0 * *rc::gen::inRange(100, 9000)};
        const std::array<double, 3> texel = {40, 10, 30};
        const PixelType type =
            *rc::gen::element(PixelType::unorm8, PixelType::unorm16, PixelType::half);
        const DistanceCode exact(range, texel, PixelType::float32);
        const DistanceCode code(range, texel, type);
        const double levels = type == PixelType::unorm8 ? 255 : 65535;
        const double span = std::max(range[1], -range[0]);
        const double step = type == PixelType::half ? span / 1024 : (range[1] - range[0]) / levels;
        const double zero = code.metres(double{code.surface()});
        RC_ASSERT(zero <= 1e-3 && zero > -step - 1e-3);
        const float far = square(0.1 * *rc::gen::inRange(0, 100000));
        const double outside = code.metres(double{code.outside(far)});
        const auto wanted = double{exact.outside(far)};
        RC_ASSERT(outside <= wanted + 1e-3 && outside > wanted - step - 1e-3);
        const double inside = code.metres(double{code.inside(far)});
        const auto depth = double{exact.inside(far)};
        RC_ASSERT(inside <= zero && inside >= std::min(depth, zero) - 1e-3);
        RC_ASSERT(inside < std::max(depth + step + 1e-3, zero + 1e-9));
    }));
}

TEST(StoredDistance, OfNothingAndOfAllIsStated) {
    const CellGrid grid{{16, 8, 40}, 2};
    const Trial empty(test::volume_of(grid), {50, 50, 50});
    for (const float value : empty.values) EXPECT_EQ(value, 1);
    const Trial full(test::volume_of(grid, 1), {50, 50, 50});
    // 1000 m above the base; it is clamped to the range.
    EXPECT_EQ(full.code.metres(double{full.values[index_of({8, 4, 20}, 0, 0, 10)]}), -256);
    EXPECT_EQ(full.values.front(), full.code.surface());
    EXPECT_FALSE(empty.check().failed());
    EXPECT_FALSE(full.check().failed());
    // Voxels at the threshold are none above it.
    const Trial at_threshold(test::volume_of(grid, 0.5F), {50, 50, 50}, PixelType::unorm16, 0.5F);
    EXPECT_EQ(at_threshold.values, empty.values);
    const Trial one(test::volume_of({{1, 1, 1}, 1}, 1), {50, 50, 50});
    EXPECT_EQ(one.values, std::vector<float>{one.code.surface()});
}

TEST(DistanceVolume, HoldsWhatItsChannelsSay) {
    const Volume volume = balls({{16, 16, 18}, 4}, 3, 2, 9);
    const VoxelBits bits = bits_of(volume, 0);
    const Point edges = {10, 12, 15};
    const DistanceCode code({-256, 4096}, {40, 48, 60}, PixelType::float32);
    const std::array<int, 3> size = volume.grid.size();
    std::vector<float> means(count_of(size), 0.25F);
    const DistanceSource source(bits, {volume.grid, edges}, code,
                                {DistanceContent::distance, DistanceContent::profile,
                                 DistanceContent::detail_type, DistanceContent::density_scale},
                                {0, 0.1, means}, {});
    const NearestVoxel nearest(bits, edges);
    std::vector<std::vector<float>> planes(4, std::vector<float>(count_of(size)));
    std::vector<float*> channels;
    for (std::vector<float>& plane : planes) channels.push_back(plane.data());
    source.fill({{}, size}, channels);
    double deepest = 0;
    for (std::size_t i = 0; i < planes[0].size(); ++i) {
        const auto x = static_cast<int>(i) % size[0];
        const auto y = static_cast<int>(i) / size[0] % size[1];
        const auto z = static_cast<int>(i) / (size[0] * size[1]);
        const Point centre = {4 * (x + 0.5), 4 * (y + 0.5), 4 * (z + 0.5)};
        const double depth = nearest.to_cloud(centre) > 0 ? 0 : nearest.to_hole(centre);
        deepest = std::max(deepest, depth);
        EXPECT_NEAR(planes[1][i], depth / source.core_m(), 1e-5);
        EXPECT_NEAR(planes[2][i], std::min(1.0, centre[2] / 18 / 0.1), 1e-6);
        EXPECT_EQ(planes[3][i], 0.25F);
    }
    EXPECT_GT(deepest, 20);
    EXPECT_NEAR(source.core_m(), deepest, 1e-3);
}

}  // namespace
}  // namespace skybake::occupancy
