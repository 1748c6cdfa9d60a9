
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "config/assets/bruneton.h"
#include "config/assets/optical_depth.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::valid;
using testing::value_at;
using Codes = std::vector<std::string>;
using Size = std::array<int, 3>;

const std::string bruneton = "preset = 'earth_hillaire'\n[bake.bruneton]\n";
const std::string columns = "preset = 'earth_hillaire'\n[bake.optical_depth]\n";

template <class Asset>
Asset only(const std::string& text) {
    const Recipe recipe = valid(text);
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<Asset>();
}

TEST(PrecomputedDecoder, DefaultsFollowTheTable) {
    const auto scattering = only<BrunetonBake>(bruneton);
    EXPECT_EQ(scattering.size, (Size{256, 128, 32}));
    EXPECT_EQ(scattering.nu_size, 8);
    EXPECT_EQ(scattering.orders, 0);
    EXPECT_FALSE(scattering.combined);
    EXPECT_EQ(scattering.mie_layers, Codes{"mie"});
    EXPECT_EQ(scattering.solar_irradiance, (std::vector<double>{1, 1, 1}));
    EXPECT_NEAR(scattering.sun_cos_zenith_min, -0.2079, 1e-4);
    EXPECT_EQ(only<BrunetonBake>(bruneton + "table = 'transmittance'").size, (Size{256, 64, 1}));
    EXPECT_EQ(only<BrunetonBake>(bruneton + "table = 'irradiance'").size, (Size{64, 16, 1}));
    EXPECT_EQ(value_at(valid(bruneton), "bake.bruneton.size").origin, "derived");
}

TEST(PrecomputedDecoder, TakramsDefaultsAreItsOwn) {
    const auto takram = only<BrunetonBake>(bruneton + "convention = 'takram'");
    EXPECT_EQ(takram.sun_cos_zenith_min, -0.5);
    EXPECT_TRUE(takram.combined);
    EXPECT_EQ(takram.solar_irradiance, (std::vector<double>{1.474, 1.8504, 1.91198}));
}

TEST(PrecomputedDecoder, OrdersAreThoseGiven) {
    EXPECT_EQ(only<BrunetonBake>(bruneton + "orders = 4").orders, 4);
}

TEST(PrecomputedDecoder, ColumnsAreOfLayers) {
    EXPECT_EQ(only<OpticalDepthBake>(columns).kinds, (Codes{"mie", "ozone", "rayleigh"}));
    EXPECT_EQ(only<OpticalDepthBake>(columns + "kinds = ['mie']").kinds, Codes{"mie"});
    EXPECT_EQ(only<OpticalDepthBake>(columns + "sampling = 'uniform'\nshells = 8").shells, 8);
}

TEST(PrecomputedDecoder, TheirParametersAreARecipe) {
    for (const std::string& text : {bruneton, columns, bruneton + "table = 'irradiance'"}) {
        const std::string parameters = testing::all_parameters(valid(text));
        EXPECT_EQ(testing::all_parameters(valid(parameters)), parameters);
    }
}

}  // namespace
}  // namespace skybake::config
