// parameters_toml of recipe.h.
#include <gtest/gtest.h>

#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::valid;

std::string text_of(const Recipe& recipe, const std::vector<std::string>& patterns) {
    return parameters_toml(recipe, patterns);
}

TEST(ParametersToml, PrintsWhatThePatternsName) {
    const Recipe recipe = valid("preset = 'earth_hillaire'\n[bake.transmittance]\n");
    EXPECT_EQ(text_of(recipe, {"wavelengths", "atmosphere.ground_radius",
                               "atmosphere.layers.*.extinction", "bake.transmittance.*"}),
              "wavelengths = [\"680 nm\", \"550 nm\", \"440 nm\"]\n"
              "\n[atmosphere]\n"
              "ground_radius = \"6360000 m\"\n"
              "\n[atmosphere.layers.mie]\n"
              "extinction = [\"4.44e-06 /m\", \"4.44e-06 /m\", \"4.44e-06 /m\"]\n"
              "\n[atmosphere.layers.ozone]\n"
              "extinction = [\"6.5e-07 /m\", \"1.881e-06 /m\", \"8.5e-08 /m\"]\n"
              "\n[atmosphere.layers.rayleigh]\n"
              "extinction = [\"5.802e-06 /m\", \"1.3558e-05 /m\", \"3.31e-05 /m\"]\n"
              "\n[bake.transmittance]\n"
              "asset = \"transmittance\"\n"
              "size = [256, 64]\n"
              "content = \"transmittance\"\n"
              "mapping = \"bruneton\"\n"
              "formats = [\"exr\"]\n"
              "pixel_type = \"float\"\n"
              "layout = \"stack\"\n"
              "flip = false\n"
              "mips = 1\n"
              "compression = \"zip\"\n"
              "vdb_compression = \"blosc\"\n"
              "ktx2_compression = \"zstd\"\n");
    EXPECT_EQ(text_of(recipe, {}), "");
    EXPECT_EQ(text_of(recipe, {"nothing", "atmosphere"}), "");
}

TEST(ParametersToml, LeavesOutWhereValuesComeFrom) {
    const Recipe plain = valid("preset = 'earth_hillaire'");
    const Recipe roundabout = valid(
        "format = 1\npreset = 'earth_hillaire'\n[atmosphere.layers.mie]\n"
        "absorption = '4.44e-7 /m'\nenabled = true\n"
        "[atmosphere.layers.haze]\nenabled = false\n",
        {"atmosphere.layers.mie.extinction=4.44e-6 /m"});
    EXPECT_EQ(testing::all_parameters(roundabout), testing::all_parameters(plain));
}

// An unrelated change must not touch a file's bytes.
TEST(ParametersToml, IsUntouchedByUnrelatedChanges) {
    const std::vector<std::string> patterns = {"atmosphere.layers.*.extinction"};
    EXPECT_EQ(text_of(valid("preset = 'earth_hillaire'"), patterns),
              text_of(valid("preset = 'earth_hillaire'\n[bake.multiple_scattering]\n",
                            {"atmosphere.ground_albedo=1", "atmosphere.layers.mie.g=0"}),
                      patterns));
}

TEST(ParametersToml, QuotesNamesThatNeedIt) {
    const Recipe recipe = valid(
        "preset = 'vacuum'\n[atmosphere.layers.\"a.b\"]\nprofile = 'slab'\n"
        "bottom_altitude = '0 m'\ntop_altitude = '1 m'\n");
    EXPECT_EQ(text_of(recipe, {"atmosphere.layers.*.profile"}),
              "[atmosphere.layers.\"a.b\"]\nprofile = \"slab\"\n");
}

}  // namespace
}  // namespace skybake::config
