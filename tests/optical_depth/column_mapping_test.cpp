#include "bakers/assets/optical_depth/column_mapping.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "config/assets/optical_depth.h"
#include "tests/optical_depth/columns.h"
#include "tests/support/loops.h"

namespace skybake::test {
namespace {

ColumnGeometry random_geometry() {
    const double radius = log_uniform(10, 1e6);
    const double thickness = radius * log_uniform(1e-4, 1);
    return {{radius, thickness}, {thickness, thickness * log_uniform(1e-4, 1)}};
}

struct RoundTrip {
    double within = 0;   // largest error of texture coordinates
    double grazing = 0;  // of paths that touch the ground
    int paths = 0;
};

// The texture coordinates of texels' paths are those of their centres. Not asked of the end texels
// of v and w, where ranges may have no width, nor of paths that belong to two kinds: level ones,
// and those that fall along the horizon.
RoundTrip round_trip(const config::OpticalDepthBake& bake, const ColumnGeometry& geometry) {
    const ColumnTable table(bake, geometry);
    const auto is_end = [&](int i, std::size_t axis) {
        return bake.size[axis] > 1 && (i == 0 || i + 1 == bake.size[axis]);
    };
    RoundTrip result;
    testing::for_each_voxel(bake.size, [&](int x, int y, int z) {
        const ColumnPath path = table.path_of_texel({x, y, z});
        const double tiny = 1e-9 * geometry.shell.ground_radius_km;
        const bool grazes =
            std::fabs(path.s_km + horizon_distance_km(geometry.shell, path.altitude_km)) < tiny;
        const bool falls = path.s_km + path.length_km <= 0;
        if (is_end(y, 1) || is_end(z, 2) || std::fabs(path.s_km) < tiny || (grazes && falls)) {
            return;
        }
        ++result.paths;
        const auto uvw = table.texture_coordinates(path);
        const std::array<int, 3> texel = {x, y, z};
        double& worst = grazes ? result.grazing : result.within;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            worst = std::max(worst, std::fabs(uvw[axis] - (texel[axis] + 0.5) / bake.size[axis]));
        }
    });
    return result;
}

TEST(ColumnMapping, TexelCentresComeBackOnEarth) {
    const auto kinds = make_column_kinds(earth_with_presets(), earth_kinds());
    for (const auto& bake : path_bakes({64, 32, 1}, {16, 12, 12}, earth_kinds())) {
        SCOPED_TRACE(static_cast<int>(bake.table) * 10 + static_cast<int>(bake.coordinates));
        const RoundTrip errors = round_trip(bake, column_geometry(kinds));
        EXPECT_GT(errors.paths, 1000);
        // By distance a path's end is found from its length, which costs a digit.
        const bool by_distance = bake.coordinates == config::BetweenCoordinates::distance;
        EXPECT_LE(errors.within, by_distance ? 1e-11 : 1e-12);
        // Where they touch the ground g is as the square root of an altitude that is rounded.
        EXPECT_LE(errors.grazing, 1e-6);
    }
}

RC_GTEST_PROP(ColumnMapping, AltitudesComeBack, ()) {
    const AltitudeScale scale = random_geometry().scale;
    const double g = uniform(0, 1);
    RC_ASSERT(std::fabs(scaled_altitude(scale, altitude_at(scale, g)) - g) <= 1e-12 / (g + 1e-3));
    RC_ASSERT(altitude_at(scale, 0) == 0);
    RC_ASSERT(altitude_at(scale, 1) == scale.thickness_km);
}

// Every path lies in the shell, from its altitude on, and ends where the coordinates say.
RC_GTEST_PROP(ColumnMapping, PathsStayInTheShell, ()) {
    const ColumnGeometry geometry = random_geometry();
    const Shell& shell = geometry.shell;
    const auto kind = static_cast<RayKind>(*rc::gen::inRange(0, 3));
    const auto corner = [] {
        const int choice = *rc::gen::inRange(0, 4);
        return choice == 0 ? 0.0 : choice == 1 ? 1.0 : uniform(0, 1);
    };
    const DistanceCoordinates x = {kind, corner(), corner(), corner()};
    const ColumnPath path = path_along(geometry, x);
    const double size = shell.ground_radius_km + shell.thickness_km;
    RC_ASSERT(path.length_km >= 0);
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
        const double h =
            altitude_along_km(shell, path.altitude_km, path.s_km, share * path.length_km);
        RC_ASSERT(h >= -1e-12 * size);
        RC_ASSERT(h <= shell.thickness_km + 1e-12 * size);
    }
    if (kind != RayKind::ground && x.distance == 1) {
        const double end = altitude_along_km(shell, path.altitude_km, path.s_km, path.length_km);
        RC_ASSERT(std::fabs(end - shell.thickness_km) <= 1e-11 * size);
    }
}

// A path and the same from its other end are one texel.
RC_GTEST_PROP(ColumnMapping, PairsAreSymmetric, ()) {
    const ColumnGeometry geometry = random_geometry();
    const auto kind = static_cast<RayKind>(*rc::gen::inRange(0, 2));
    const PairCoordinates x = {kind, uniform(0.05, 0.95), uniform(0.1, 1), uniform(0.1, 0.95)};
    const ColumnPath path = path_between(geometry, x);
    const double end_km =
        altitude_along_km(geometry.shell, path.altitude_km, path.s_km, path.length_km);
    const ColumnPath back = {end_km, -(path.s_km + path.length_km), path.length_km};
    const PairCoordinates y = pair_coordinates(geometry, back);
    RC_ASSERT(y.kind == x.kind);
    // From the far end altitudes are differences of lengths: planets lose digits by their size.
    const double loss = 1e-12 * geometry.shell.ground_radius_km / geometry.scale.fine_km;
    RC_ASSERT(std::fabs(y.angle - x.angle) <= 1e-9 + 100 * loss);
    RC_ASSERT(std::fabs(y.high - x.high) <= 1e-9 + loss);
    RC_ASSERT(std::fabs(y.low - x.low) <= 1e-9 + 10 * loss);
}

// The angle at the planet's centre, against plane trigonometry.
TEST(ColumnMapping, AnglesAtTheCentreMakePaths) {
    const Shell shell{6360, 100};
    const double angle = 0.1;
    const ColumnPath path = path_of_angle(shell, 20, 50, angle);
    const double x = 6410 * std::sin(angle);
    const double y = 6410 * std::cos(angle) - 6380;
    EXPECT_NEAR(path.length_km, std::hypot(x, y), 1e-10);
    EXPECT_NEAR(path.s_km, 6380 * y / std::hypot(x, y), 1e-8);
    EXPECT_EQ(path.altitude_km, 20);
    const ColumnPath vertical = path_of_angle(shell, 50, 20, 0);
    EXPECT_NEAR(vertical.length_km, 30, 1e-12);
    EXPECT_NEAR(vertical.s_km, 6380, 1e-9);
    EXPECT_EQ(path_of_angle(shell, 7, 7, 0).length_km, 0);
}

// Next to the border of two kinds, from either side, a path is the same.
TEST(ColumnMapping, KindsMeet) {
    const auto kinds = make_column_kinds(earth_with_presets(), earth_kinds());
    const ColumnGeometry geometry = column_geometry(kinds);
    for (const double v : {0.2, 0.5, 0.9}) {
        const ColumnPath level = path_to_top(geometry, {RayKind::upward, 1, v});
        const ColumnPath passing = path_to_top(geometry, {RayKind::limb, 0, v});
        EXPECT_NEAR(level.length_km, passing.length_km, 1e-9);
        EXPECT_NEAR(level.s_km, 0, 1e-9);
        const ColumnPath grazing = path_along(geometry, {RayKind::limb, 1, v, 0.3});
        const ColumnPath fallen = path_along(geometry, {RayKind::ground, 0, v, 0.3});
        EXPECT_NEAR(grazing.s_km, fallen.s_km, 1e-9);
    }
}

// Rounding may have the nearest point of a path below the ground. Where the path has passed it, it
// is above the ground all the same.
TEST(ColumnMapping, APathThatPassesItsNearestPointDoesNotFall) {
    const ColumnGeometry geometry = {{6360, 100}, {100, 2}};
    for (const double altitude_km : {0.01, 1.0, 10.0, 80.0}) {
        const double rho = horizon_distance_km(geometry.shell, altitude_km);
        const double s_km = -rho * (1 + 1e-15);
        ASSERT_LT(s_km, -rho);
        const DistanceCoordinates passes =
            distance_coordinates(geometry, {altitude_km, s_km, 1.5 * rho});
        EXPECT_EQ(passes.kind, RayKind::limb) << altitude_km;
        EXPECT_GT(passes.distance, 0);
        const DistanceCoordinates falls =
            distance_coordinates(geometry, {altitude_km, 1.01 * s_km, 0.5 * rho});
        EXPECT_EQ(falls.kind, RayKind::ground) << altitude_km;
    }
}

}  // namespace
}  // namespace skybake::test
