// Tables of more wavelengths than a texture has channels: each packet is the table of a recipe that
// has its wavelengths alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "tests/support/atmospheres.h"
#include "tests/support/shared_bakes.h"
#include "tests/support/volumes.h"

namespace skybake::test {
namespace {

const std::vector<std::string> kPackets = {"['430 nm', '470 nm', '520 nm', '550 nm']",
                                           "['580 nm', '620 nm']"};
const std::string kAll = "['430 nm', '470 nm', '520 nm', '550 nm', '580 nm', '620 nm']";

config::Recipe earth(const std::string& section, const std::string& wavelengths) {
    return recipe_of("preset = 'earth'\n" + section, {"wavelengths=" + wavelengths});
}

const std::vector<std::string> kSections = {
    "[bake.transmittance]\nsize = [8, 8]\n",
    "[bake.multiple_scattering]\nmethod = 'converged'\nsize = [8, 4]\n",
    "[particles.haze]\npreset = 'haze'\n[bake.phase]\nparticles = 'haze'\nsize = 16\n",
    "[bake.sky_view]\nsize = [8, 8]\nsun_elevations = ['20 deg', '-3 deg']\n",
    "[bake.environment]\nsize = [8, 4]\nsun_elevation = '10 deg'\n",
    "[bake.irradiance]\nsize = [4, 4]\n",
    "[bake.aerial_perspective]\nsize = [4, 4, 4]\naltitude = '1 km'\nsun_elevation = '10 deg'\n"
    "content = 'in_scatter'\n",
    "[bake.aerial_perspective]\nsize = [4, 4, 4]\naltitude = '1 km'\nsun_elevation = '10 deg'\n"
    "content = 'transmittance'\n",
    "[bake.bruneton]\nsize = [16, 8, 4]\ncombined = false\n",
    "[bake.bruneton]\ntable = 'single_mie'\nsize = [16, 8, 4]\n",
    "[bake.bruneton]\ntable = 'irradiance'\norders = 1\nsize = [8, 4, 1]\n",
    "[bake.bruneton]\ntable = 'transmittance'\nsize = [8, 4, 1]\n",
};

TEST(PacketsOfTables, AreTheTablesOfTheirWavelengthsBitForBit) {
    SharedBakes bakes;
    for (const std::string& section : kSections) {
        const config::Recipe all = earth(section, kAll);
        ASSERT_EQ(all.parameters.bakes.size(), kPackets.size()) << section;
        std::vector<std::vector<std::vector<float>>> texels;
        for (std::size_t packet = 0; packet < kPackets.size(); ++packet) {
            const config::Recipe one = earth(section, kPackets[packet]);
            const Baked part = bakes.baked(all, all.parameters.bakes.at(packet));
            const Baked alone = bakes.baked(one, one.parameters.bakes.at(0));
            std::vector<std::string> names = {"R", "G", "B", "A"};
            names.resize(packet == 0 ? 4 : 2);
            EXPECT_EQ(part.channel_names, names) << section;
            EXPECT_EQ(part.conventions.wavelengths_nm, alone.conventions.wavelengths_nm);
            texels.push_back(testing::planes_of(part));
            EXPECT_EQ(texels.back(), testing::planes_of(alone)) << section << packet;
        }
        // The wavelengths differ by more than rounding.
        EXPECT_NE(texels[0][0], texels[1][0]) << section;
    }
}

// The light of a packet is solved for once, whatever the number of assets, of the same packet of
// colours too.
TEST(PacketsOfTables, ShareTheirLight) {
    std::string sections;
    for (const std::size_t i : {3u, 4u, 5u, 6u}) sections += kSections[i];
    const auto solutions = [&](const config::Recipe& recipe) {
        std::vector<NeedKey> found;
        for (const Need& need :
             needs_of(recipe.parameters, recipe.parameters.bakes, Certification::off)) {
            const bool is_new = std::find(found.begin(), found.end(), need.key) == found.end();
            if (need.name == "solved light" && is_new) found.push_back(need.key);
        }
        return found;
    };
    const std::vector<NeedKey> packets = solutions(earth(sections, kAll));
    EXPECT_EQ(packets.size(), 2u);
    EXPECT_EQ(packets, solutions(earth(kSections[3] + "[color]\n", kAll)));
}

// The weights of all packets add up to the colours that a table of colours holds.
TEST(PacketsOfTables, AddUpToColours) {
    const std::string section =
        "[bake.sky_view]\nsize = [8, 8]\nsun_elevations = ['20 deg']\n[color]\n";
    SharedBakes bakes;
    const config::Recipe colors = earth(section, kAll);
    const Baked color = bakes.baked(colors, colors.parameters.bakes.at(0));
    const config::Recipe recipe = earth(section + "space = 'none'\n", kAll);
    ASSERT_EQ(recipe.parameters.bakes.size(), 2u);
    const auto wanted = testing::planes_of(color);
    std::vector<std::vector<double>> sum(3, std::vector<double>(wanted[0].size()));
    for (std::size_t packet = 0; packet < 2; ++packet) {
        const Baked part = bakes.baked(recipe, recipe.parameters.bakes.at(packet));
        const auto light = testing::planes_of(part);
        const std::vector<double>& weights = part.conventions.color->weights;
        ASSERT_EQ(weights.size(), 3 * light.size());
        for (std::size_t w = 0; w < light.size(); ++w) {
            for (std::size_t i = 0; i < light[w].size(); ++i) {
                for (std::size_t c = 0; c < 3; ++c) sum[c][i] += weights[3 * w + c] * light[w][i];
            }
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < sum[c].size(); ++i) {
            EXPECT_NEAR(sum[c][i], wanted[c][i], 1e-6 * wanted[1][i]) << c << " " << i;
        }
    }
}

}  // namespace
}  // namespace skybake::test
