#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <span>
#include <string>

#include "bakers/assets/optical_depth/column_kinds.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/report/report.h"
#include "tests/optical_depth/columns.h"
#include "tests/support/atmospheres.h"

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

// Columns and strips as recipes ask for them.

TEST(ColumnRecipes, ReportsCompareShellsWithTheExactIntegral) {
    const auto load = [](std::span<const std::string> settings) {
        return config::parse_recipe(
            "preset = 'earth_hillaire'\n[bake.air]\nasset = 'optical_depth'\nkinds = ['rayleigh']\n"
            "size = [16, 8, 1]\n",
            "recipe", {}, settings);
    };
    const auto recipe = load({});
    const auto report = report_asset(load, *recipe.value, recipe.value->parameters.bakes.back(),
                                     {.threads = 1, .quick = true});
    ASSERT_TRUE(report.value.has_value());
    EXPECT_LE(report.value->rows.front().texel.max, 1e-6);
    std::map<std::string, double> errors;
    for (const ReportRow& row : report.value->rows) {
        if (row.family == "sampling") errors[row.variant] = row.texel.rms;
    }
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_GT(errors.at("equal_attenuation"), 1e-4);
    // Shells of equal attenuation are closer; uniform ones are held back by the air above.
    EXPECT_LT(errors.at("equal_attenuation"), errors.at("uniform"));
}

TEST(ColumnRecipes, SkiesFromStripsAreDarkerThanAllOrders) {
    const config::Recipe recipe = recipe_of(
        "preset = 'earth_hillaire'\n[bake.solved]\nasset = 'sky_view'\nsize = [8, 8]\naltitude = "
        "'500 m'\n"
        "sun_elevations = ['30 deg']\n[bake.strips]\nasset = 'sky_view'\nsky = 'strips'\n"
        "size = [8, 8]\naltitude = '500 m'\nsun_elevations = ['30 deg']\n");
    std::vector<Baked> tables;
    for (const config::Bake& bake : recipe.parameters.bakes) {
        if (bake.name != "solved" && bake.name != "strips") continue;
        auto baked = bake_asset(recipe, bake, {.threads = 2, .certification = Certification::off});
        ASSERT_TRUE(baked.value.has_value());
        tables.push_back(std::move(*baked.value));
    }
    ASSERT_EQ(tables.size(), 2u);
    EXPECT_EQ(tables[0].content.find("strips"), std::string::npos);
    EXPECT_NE(tables[1].content.find("strips"), std::string::npos);
    double solved = 0;
    double strips = 0;
    for (std::size_t i = 0; i < tables[0].image().texels.size(); ++i) {
        solved += double{tables[0].image().texels[i]};
        strips += double{tables[1].image().texels[i]};
    }
    EXPECT_LT(strips, solved);
    EXPECT_GT(strips, 0.5 * solved);
}

RC_GTEST_PROP(ShellSampling, ShellsDimLightFromAboveEqually, ()) {
    const double scale_height = log_uniform(0.05, 20);
    const double top = scale_height * log_uniform(0.1, 20);
    const int count = *rc::gen::inRange(1, 200);
    const auto shells = equal_attenuation_shells_km(scale_height, top, count);
    RC_ASSERT(shells.size() == static_cast<std::size_t>(count) + 1);
    RC_ASSERT(shells.front() == 0);
    RC_ASSERT(shells.back() == top);
    const double whole = 1 - std::exp(-top / scale_height);
    for (std::size_t i = 0; i + 1 < shells.size(); ++i) {
        const double depth =
            std::exp(-shells[i] / scale_height) - std::exp(-shells[i + 1] / scale_height);
        RC_ASSERT(std::fabs(depth - whole / count) <= 1e-12);
    }
}

TEST(ShellSampling, TheMeanScaleHeightIsWeightedWithExtinction) {
    const auto kinds = make_column_kinds(earth_with_presets(), {"dust", "fog"});
    EXPECT_NEAR(mean_scale_height_km(kinds), (0.145 * 2 + 3.912 * 0.1) / (0.145 + 3.912), 1e-12);
}

// Sums along a vertical path that goes on beyond the last shell, where nothing is sampled.
TEST(ShellSampling, CountsTheDensityAtTheMiddleOfEachShell) {
    config::Atmosphere atmosphere = earth_with_presets();
    const auto kinds = make_column_kinds(atmosphere, {"dust"});
    const std::vector<double> shells = uniform_shells_km(3.5, 7);
    double sum = 0;
    for (int i = 0; i < 7; ++i) sum += 0.5 * std::exp(-(0.5 * i + 0.25) / 2);
    EXPECT_NEAR(sampled_mean_density(kinds[0], shells, {0, 6360, 6}) * 6, sum, 1e-9);
}

RC_GTEST_PROP(ShellSampling, ManyShellsApproachTheIntegral, ()) {
    const auto kinds = make_column_kinds(earth_with_presets(), {"dust", "rayleigh"});
    const ColumnGeometry geometry = column_geometry(kinds);
    const auto kind = static_cast<RayKind>(*rc::gen::inRange(0, 2));
    const ColumnPath path = path_to_top(geometry, {kind, uniform(0, 1), uniform(0, 1)});
    const std::vector<double> shells = uniform_shells_km(100, 4096);
    for (const ColumnKind& kind : kinds) {
        const double exact = mean_density(kind, path);
        RC_ASSERT(std::fabs(sampled_mean_density(kind, shells, path) - exact) <= 2e-3 * exact);
    }
}

}  // namespace

}  // namespace skybake::test
