#include "config/fields/section_decoder.h"

#include <gtest/gtest.h>

#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::valid;
using testing::value_at;

TEST(SectionDecoder, ValuesKnowTheirOrigin) {
    const Recipe recipe =
        valid("preset = 'earth_hillaire'\n[atmosphere.layers.mie]\ng = 0.7\n[bake.transmittance]\n",
              {"atmosphere.ground_albedo=0.1"});
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.mie.g").origin, "test.toml:3");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.mie.phase").origin, "preset earth_hillaire");
    EXPECT_EQ(value_at(recipe, "atmosphere.ground_albedo").origin,
              "--set `atmosphere.ground_albedo=0.1`");
    EXPECT_EQ(value_at(recipe, "bake.transmittance.size").origin, "default");
    EXPECT_EQ(value_at(recipe, "bake.transmittance.size").written, "[256, 64]");
    EXPECT_EQ(value_at(recipe, "bake.transmittance.asset").written, "\"transmittance\"");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.rayleigh.extinction").origin, "derived");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.rayleigh.scale_height").written, "\"8 km\"");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.rayleigh.scale_height").canonical, "\"8000 m\"");
    EXPECT_TRUE(value_at(recipe, "preset").only_shown);
}

}  // namespace
}  // namespace skybake::config
