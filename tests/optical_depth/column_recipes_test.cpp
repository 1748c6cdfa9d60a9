// Columns and strips as recipes ask for them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <span>
#include <string>

#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/report/report.h"
#include "tests/support/atmospheres.h"

namespace skybake::test {
namespace {

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

}  // namespace
}  // namespace skybake::test
