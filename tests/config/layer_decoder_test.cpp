#include "config/sections/sections.h"

#include <gtest/gtest.h>

#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

const std::string head =
    "preset = 'vacuum'\n\n\n"
    "[atmosphere.layers.a]\nprofile = 'exponential'\nscale_height = '1 km'\n";  // 6 lines

std::vector<double> extinction_of(const std::string& keys) {
    const Recipe recipe = valid(head + keys);
    std::vector<double> values;
    for (const InverseLength value : recipe.parameters.atmosphere.layers.at(0).extinction) {
        values.push_back(value.per_meter);
    }
    return values;
}

TEST(LayerDecoder, AlwaysResolvesExtinction) {
    using Values = std::vector<double>;
    EXPECT_EQ(extinction_of(""), (Values{0, 0, 0}));
    EXPECT_EQ(extinction_of("scattering = '2e-6 /m'"), (Values{2e-6, 2e-6, 2e-6}));
    EXPECT_EQ(extinction_of("extinction = '3e-6 /m'"), (Values{3e-6, 3e-6, 3e-6}));
    EXPECT_EQ(extinction_of("scattering = '2e-6 /m'\nabsorption = ['1e-6 /m', '0 /m', '2e-6 /m']"),
              (Values{2e-6 + 1e-6, 2e-6, 4e-6}));
    EXPECT_EQ(extinction_of("scattering = '2e-6 /m'\nsingle_scattering_albedo = [1, 0.5, '25 %']"),
              (Values{2e-6, 4e-6, 8e-6}));
}

TEST(LayerDecoder, ShowsWhatExtinctionWasDerivedFrom) {
    const Recipe recipe = valid(head + "scattering = '2e-6 /m'\nsingle_scattering_albedo = 0.5");
    const ResolvedValue albedo = value_at(recipe, "atmosphere.layers.a.single_scattering_albedo");
    EXPECT_EQ(albedo.origin, "test.toml:8");
    EXPECT_TRUE(albedo.only_shown);
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.a.extinction").origin, "derived");
    EXPECT_FALSE(has_value(recipe, "atmosphere.layers.a.absorption"));
}

TEST(LayerDecoder, ReadsEveryProfile) {
    const Recipe recipe = valid(
        "preset = 'vacuum'\n"
        "[atmosphere.layers.tent]\nprofile = 'tent'\ncenter_altitude = '25 km'\nhalf_width = '15 "
        "km'\n"
        "[atmosphere.layers.slab]\nprofile = 'slab'\nbottom_altitude = '-1 km'\ntop_altitude = "
        "'500 km'\n"
        "[atmosphere.layers.table]\nprofile = 'tabulated'\ntable = [['0 km', 1.0], ['10 km', 0]]\n"
        "phase = 'henyey_greenstein'\ng = -0.5\n");
    const Layer* tent = find_layer(recipe.parameters, "tent");
    ASSERT_TRUE(tent);
    EXPECT_EQ(tent->profile, Profile::tent);
    EXPECT_EQ(tent->center_altitude.meters, 25000);
    EXPECT_EQ(tent->half_width.meters, 15000);
    EXPECT_EQ(tent->phase, Phase::isotropic);
    const Layer* slab = find_layer(recipe.parameters, "slab");
    ASSERT_TRUE(slab);
    EXPECT_EQ(slab->bottom_altitude.meters, -1000);
    EXPECT_EQ(slab->top_altitude.meters, 500000);
    const Layer* table = find_layer(recipe.parameters, "table");
    ASSERT_TRUE(table);
    ASSERT_EQ(table->table.size(), 2u);
    EXPECT_EQ(table->table[1].altitude.meters, 10000);
    EXPECT_EQ(table->table[0].density, 1);
    EXPECT_EQ(table->phase, Phase::henyey_greenstein);
    EXPECT_EQ(table->g, -0.5);
}

TEST(LayerDecoder, ASwitchedOffLayerIsDroppedButChecked) {
    const Recipe recipe =
        valid("preset = 'earth_hillaire'", {"atmosphere.layers.mie.enabled=false"});
    EXPECT_EQ(recipe.parameters.atmosphere.layers.size(), 2u);
    EXPECT_TRUE(has_value(recipe, "atmosphere.layers.mie.enabled"));
    EXPECT_FALSE(has_value(recipe, "atmosphere.layers.mie.g"));
}

TEST(LayerDecoder, NamesMayBeAnything) {
    const Recipe recipe = valid(
        "preset = 'vacuum'\n[atmosphere.layers.'sea fog.1']\nprofile = 'exponential'\n"
        "scale_height = '100 m'\n",
        {"atmosphere.layers.'sea fog.1'.scattering=1e-3 /m"});
    ASSERT_EQ(recipe.parameters.atmosphere.layers.size(), 1u);
    EXPECT_EQ(recipe.parameters.atmosphere.layers[0].name, "sea fog.1");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.\"sea fog.1\".scattering").written,
              "\"1e-3 /m\"");
}

}  // namespace
}  // namespace skybake::config
