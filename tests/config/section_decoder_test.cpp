#include "config/fields/section_decoder.h"

#include <gtest/gtest.h>

#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::parse;
using testing::valid;
using testing::value_at;

const std::string planet = "preset = 'vacuum'\n\n[atmosphere]\n";

TEST(SectionDecoder, UnknownKeysNameTheNearest) {
    const auto diagnostics = parse("fromat = 1\n" + planet +
                                   "[atmosphere.layers.a]\nscale_hieght = '8 km'\n"
                                   "profile = 'exponential'\nscale_height = '8 km'\n")
                                 .diagnostics;
    ASSERT_EQ(diagnostics.size(), 2u);
    EXPECT_EQ(diagnostics[0].message, "unknown key `fromat` at the top level");
    EXPECT_EQ(diagnostics[0].label, "did you mean `format`?");
    EXPECT_EQ(diagnostics[1].message, "unknown key `scale_hieght` in [atmosphere.layers.a]");
    EXPECT_EQ(diagnostics[1].label, "did you mean `scale_height`?");
    EXPECT_EQ(diagnostics[1].where.line, 6);
    EXPECT_EQ(diagnostics[1].where.column, 1);
    EXPECT_EQ(diagnostics[1].where.length, 12);
    EXPECT_EQ(diagnostics[1].where.line_text, "scale_hieght = '8 km'");
}

TEST(SectionDecoder, KeysInTheWrongTableAreSentHome) {
    const auto label = [](const std::string& text) {
        const auto diagnostics = parse(text).diagnostics;
        return diagnostics.empty() ? "none" : diagnostics[0].label;
    };
    EXPECT_EQ(label(planet + "[layers.mie]\n"), "`layers` belongs in [atmosphere]");
    EXPECT_EQ(label(planet + "g = 0.8\n"), "`g` belongs in [atmosphere.layers.*]");
    EXPECT_EQ(label(planet + "wavelengths = '550 nm'\n"), "`wavelengths` belongs at the top level");
    EXPECT_EQ(label(planet + "[bake.transmittance]\nmethod = 'converged'\n"),
              "`method` is a key of asset multiple_scattering");
    EXPECT_EQ(label(planet + "zzz = 1\n"), "there is no such key");
}

TEST(SectionDecoder, MissingKeysSayWhoNeedsThem) {
    const auto diagnostics =
        parse(planet + "[atmosphere.layers.a]\nprofile = 'tent'\nhalf_width = '1 km'\n")
            .diagnostics;
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0105");
    EXPECT_EQ(diagnostics[0].message,
              "`atmosphere.layers.a.center_altitude` is missing: profile tent needs it");
    EXPECT_EQ(diagnostics[0].where.line, 5);
    EXPECT_EQ(diagnostics[0].where.column, 11);
}

TEST(SectionDecoder, AMissingProfileNamesTheChoices) {
    const auto diagnostics = parse(planet + "[atmosphere.layers.a]\n").diagnostics;
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0105");
    EXPECT_EQ(diagnostics[0].message, "`atmosphere.layers.a.profile` is missing");
    EXPECT_EQ(diagnostics[0].label,
              "give it one of `exponential`, `tent`, `slab`, `tabulated`, `standard`");
    EXPECT_EQ(diagnostics[0].where.line, 4);
    EXPECT_EQ(diagnostics[0].where.column, 20);
}

TEST(SectionDecoder, KeysOfAnotherProfileAreRefused) {
    const auto diagnostics = parse(planet +
                                   "[atmosphere.layers.a]\nprofile = 'exponential'\n"
                                   "scale_height = '8 km'\nhalf_width = '1 km'\ng = 0.5\n")
                                 .diagnostics;
    ASSERT_EQ(diagnostics.size(), 2u);
    EXPECT_EQ(diagnostics[0].code, "E0111");
    EXPECT_EQ(
        diagnostics[0].message,
        "`atmosphere.layers.a.half_width` belongs to profile tent, but profile is exponential");
    EXPECT_EQ(diagnostics[0].label, "profile = \"exponential\" comes from test.toml:5");
    EXPECT_EQ(diagnostics[0].where.line, 7);
    EXPECT_EQ(diagnostics[1].message,
              "`atmosphere.layers.a.g` belongs to phase henyey_greenstein or cornette_shanks, but "
              "phase is isotropic");
    EXPECT_EQ(diagnostics[1].label, "phase = \"isotropic\" comes from the default");
}

// One slip must not bring a tail of errors after it.
TEST(SectionDecoder, AMisspeltProfileIsOneError) {
    const auto diagnostics = parse(planet +
                                   "[atmosphere.layers.a]\nprofile = 'exponentail'\n"
                                   "scale_height = '8 km'\n")
                                 .diagnostics;
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0104");
    EXPECT_EQ(diagnostics[0].label, "did you mean `exponential`?");
}

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

TEST(SectionDecoder, TablesMustBeTables) {
    EXPECT_EQ(parse("atmosphere = 1").diagnostics[0].code, "E0103");
    EXPECT_EQ(parse("bake = []\n" + planet).diagnostics[0].code, "E0103");
    EXPECT_EQ(parse(planet + "layers = 'mie'").diagnostics[0].code, "E0103");
    EXPECT_EQ(parse(planet + "layers.mie = 3").diagnostics[0].code, "E0103");
    EXPECT_EQ(parse("bake.transmittance = true\n" + planet).diagnostics[0].code, "E0103");
}

}  // namespace
}  // namespace skybake::config
