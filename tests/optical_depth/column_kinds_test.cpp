#include "bakers/assets/optical_depth/column_kinds.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/optical_depth/columns.h"

namespace skybake::test {
namespace {

TEST(ColumnKinds, HaveTheirLayersExtinctionAndHeight) {
    const auto kinds = make_column_kinds(earth_with_presets(), {"fog", "rayleigh", "ozone"});
    ASSERT_EQ(kinds.size(), 3u);
    EXPECT_EQ(kinds[0].name, "fog");
    EXPECT_NEAR(kinds[0].extinction_per_km[1], 3.912, 1e-12);
    EXPECT_DOUBLE_EQ(kinds[0].mean_height_km, 0.1);
    EXPECT_NEAR(kinds[1].extinction_per_km[2], 0.0331, 1e-12);
    EXPECT_DOUBLE_EQ(kinds[1].mean_height_km, 8);
    EXPECT_NEAR(kinds[2].mean_height_km, 15, 1e-12);  // a tent 30 km wide
    EXPECT_DOUBLE_EQ(density_of(kinds[2], 25), 1);
    EXPECT_DOUBLE_EQ(column_geometry(kinds).scale.fine_km, 0.2);
}

// A column straight up through an exponential layer, in closed form.
TEST(ColumnKinds, AVerticalColumnIsTheIntegralOfTheProfile) {
    const auto kinds = make_column_kinds(earth_with_presets(), {"dust"});
    const double mean = mean_density(kinds[0], {1, 6361, 5});
    EXPECT_NEAR(mean * 5, 2 * (std::exp(-0.5) - std::exp(-3.0)), 1e-13);
    EXPECT_DOUBLE_EQ(mean_density(kinds[0], {2, 0, 0}), std::exp(-1.0));
}

RC_GTEST_PROP(ColumnKinds, ExactColumnsAreThoseOfAdaptiveQuadrature, ()) {
    const config::Atmosphere atmosphere = random_shells();
    const auto kinds = make_column_kinds(atmosphere, names_of(atmosphere));
    const ColumnGeometry geometry = column_geometry(kinds);
    const auto kind = static_cast<RayKind>(*rc::gen::inRange(0, 3));
    const auto any_path = [&](RayKind kind) {
        return path_along(geometry, {kind, uniform(0, 1), uniform(0, 1), uniform(0, 1)});
    };
    const ColumnPath path = any_path(kind);
    std::vector<ColumnPath> paths(3, path);
    for (int i = 0; i < 3; ++i) paths.push_back(any_path(static_cast<RayKind>(i)));
    for (const ColumnKind& kind : kinds) {
        const double exact = mean_density(kind, path);
        const std::vector<double> means = mean_densities(kind, paths);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            RC_ASSERT(means[i] == mean_density(kind, paths[i]));
        }
        const double reference = reference_mean_density(kind, path);
        // Adaptive quadrature leaves out what no transmittance shows.
        RC_ASSERT(std::fabs(exact - reference) <=
                  1e-8 * reference + 1e-15 / std::max(path.length_km, 1e-3));
    }
}

}  // namespace
}  // namespace skybake::test
