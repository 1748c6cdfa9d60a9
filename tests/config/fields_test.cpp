#include "config/fields/fields.h"

#include <gtest/gtest.h>

namespace skybake::config {
namespace {

TEST(Fields, FindsSectionsAndFields) {
    ASSERT_TRUE(find_section("atmosphere.layers.*"));
    EXPECT_TRUE(find_field(*find_section("atmosphere.layers.*"), "g"));
    EXPECT_FALSE(find_field(*find_section("atmosphere"), "g"));
    ASSERT_TRUE(find_section("bake.*", "transmittance"));
    EXPECT_TRUE(find_field(*find_section("bake.*", "transmittance"), "content"));
    EXPECT_FALSE(find_field(*find_section("bake.*", "multiple_scattering"), "layers"));
    EXPECT_EQ(find_section("bake.*"), nullptr);
    EXPECT_EQ(find_section("clouds"), nullptr);
}

TEST(Fields, KnowsTheTablesWithinATable) {
    EXPECT_EQ(subtables(""),
              (std::vector<std::string_view>{"color", "atmosphere", "scene", "preview", "particles",
                                             "noise", "volumes", "clouds", "bake", "sweep"}));
    EXPECT_EQ(subtables("atmosphere"), (std::vector<std::string_view>{"layers"}));
    EXPECT_TRUE(subtables("atmosphere.layers.*").empty());
    EXPECT_EQ(subtables("noise.*"), (std::vector<std::string_view>{"channels"}));
    EXPECT_EQ(asset_names().front(), "transmittance");
    EXPECT_EQ(asset_names().back(), "occupancy");
}

TEST(Fields, KnowsWhereAKeyApplies) {
    const Section& layer = *find_section("atmosphere.layers.*");
    EXPECT_TRUE(applies(*find_field(layer, "g"), "cornette_shanks"));
    EXPECT_FALSE(applies(*find_field(layer, "g"), "rayleigh"));
    EXPECT_TRUE(applies(*find_field(layer, "scattering"), "tent"));
}

TEST(Fields, KnowsWhatExcludesWhat) {
    const Section& channel = *find_section("noise.*.channels.*");
    const auto exclude = [&](std::string_view a, std::string_view b) {
        return exclude_each_other(*find_field(channel, a), *find_field(channel, b));
    };
    EXPECT_TRUE(exclude("frequency", "frequencies"));
    EXPECT_TRUE(exclude("frequencies", "octaves"));
    EXPECT_TRUE(exclude("gain", "gains"));
    EXPECT_FALSE(exclude("frequency", "octaves"));
    EXPECT_FALSE(exclude("frequencies", "frequencies"));
    EXPECT_FALSE(exclude("frequencies", "worley_frequency"));
    EXPECT_FALSE(exclude("type", "value"));
}

TEST(Fields, DescribesRangesAndChoices) {
    const Section& layer = *find_section("atmosphere.layers.*");
    EXPECT_EQ(describe_range(*find_field(layer, "g")), "in (-1, 1)");
    EXPECT_EQ(describe_range(*find_field(layer, "scale_height")), "in [0.001 m, 1e+09 m]");
    EXPECT_EQ(describe_range(*find_field(layer, "phase")), "");
    EXPECT_EQ(describe_choices(*find_field(*find_section("bake.*", "transmittance"), "mapping")),
              "one of `bruneton`, `ue`");
    EXPECT_EQ(describe_field(*find_field(layer, "g")),
              "asymmetry of the phase function: forward above 0, back below; in (-1, 1); "
              "typical haze has 0.76");
}

}  // namespace
}  // namespace skybake::config
