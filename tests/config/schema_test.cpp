#include "config/recipe/schema.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "config/fields/fields.h"

namespace skybake::config {
namespace {

const nlohmann::json& schema() {
    static const nlohmann::json parsed = nlohmann::json::parse(recipe_schema());
    return parsed;
}

void expect_fields(const nlohmann::json& object, const Section& section) {
    for (const Field& field : section.fields) {
        ASSERT_TRUE(object["properties"].contains(std::string(field.key))) << field.key;
        const nlohmann::json& property = object["properties"][std::string(field.key)];
        EXPECT_FALSE(property["description"].get<std::string>().empty());
        EXPECT_EQ(property.contains("default"), !field.fallback.empty()) << field.key;
    }
    EXPECT_EQ(object["additionalProperties"], false);
}

TEST(Schema, HasEveryKeyOfTheTables) {
    expect_fields(schema(), *find_section(""));
    expect_fields(schema()["properties"]["atmosphere"], *find_section("atmosphere"));
    expect_fields(schema()["definitions"]["layer"], *find_section("atmosphere.layers.*"));
    for (const std::string_view asset : asset_names()) {
        expect_fields(schema()["definitions"][std::string(asset)], *find_section("bake.*", asset));
    }
}

TEST(Schema, KnowsNoises) {
    const nlohmann::json& noise = schema()["definitions"]["noise"];
    nlohmann::json fields_only = noise;
    fields_only["properties"].erase("channels");
    expect_fields(fields_only, *find_section("noise.*"));
    const nlohmann::json& channel = schema()["definitions"]["noise_channel"];
    expect_fields(channel, *find_section("noise.*.channels.*"));
    EXPECT_EQ(noise["properties"]["channels"]["properties"].size(), 5u);
    EXPECT_EQ(noise["properties"]["preset"]["examples"][0], "billows");
    EXPECT_EQ(schema()["properties"]["noise"]["additionalProperties"]["$ref"],
              "#/definitions/noise");
    EXPECT_EQ(channel["properties"]["frequency"]["anyOf"][1]["maxItems"], 3);
    EXPECT_EQ(channel["properties"]["frequency"]["anyOf"][0]["maximum"], 1048576);
    EXPECT_EQ(channel["properties"]["gains"]["maxItems"], 16);
    const nlohmann::json& bake = schema()["definitions"]["noise_volume"]["properties"];
    EXPECT_EQ(bake["mips"]["anyOf"][1]["const"], "all");
    EXPECT_EQ(bake["formats"]["anyOf"][1]["uniqueItems"], true);
    EXPECT_EQ(bake["formats"]["default"][0], "exr");
    const std::string rules = channel["allOf"].dump();
    EXPECT_NE(rules.find(R"({"not":{"required":["frequency","frequencies"]}})"), std::string::npos);
    EXPECT_EQ(rules.find(R"({"not":{"required":["frequency","octaves"]}})"), std::string::npos);
}

TEST(Schema, KnowsClouds) {
    nlohmann::json cloud = schema()["definitions"]["cloud"];
    const nlohmann::json properties = cloud["properties"];
    for (const std::string_view name : subtables("clouds.*")) {
        ASSERT_TRUE(properties.contains(name)) << name;
        cloud["properties"].erase(std::string(name));
        const Section* section = find_section("clouds.*." + std::string(name));
        if (section) expect_fields(properties[std::string(name)], *section);
    }
    expect_fields(cloud, *find_section("clouds.*"));
    expect_fields(schema()["definitions"]["tower"], *find_section("clouds.*.towers.*"));
    expect_fields(schema()["definitions"]["volume"], *find_section("volumes.*"));
    EXPECT_EQ(schema()["properties"]["volumes"]["additionalProperties"]["$ref"],
              "#/definitions/volume");
    EXPECT_EQ(properties["towers"]["anyOf"][0]["items"]["$ref"], "#/definitions/tower");
    EXPECT_EQ(properties["towers"]["anyOf"][1]["additionalProperties"]["$ref"],
              "#/definitions/tower");
    EXPECT_EQ(properties["preset"]["examples"][0], "altocumulus");
    EXPECT_EQ(properties["edge_softness"]["anyOf"][0]["const"], 0);
    EXPECT_EQ(properties["extent"]["maxItems"], 3);
    EXPECT_EQ(schema()["properties"]["clouds"]["additionalProperties"]["$ref"],
              "#/definitions/cloud");
    EXPECT_EQ(schema()["definitions"]["occupancy"]["properties"]["cell"]["enum"],
              (nlohmann::json{1, 2, 4, 8, 16}));
}

TEST(Schema, KnowsSweeps) {
    nlohmann::json sweep = schema()["properties"]["sweep"];
    const nlohmann::json values = sweep["additionalProperties"]["anyOf"];
    EXPECT_EQ(values.at(0)["type"], "array");
    expect_fields(values.at(1), *find_section("sweep.*"));
    sweep["additionalProperties"] = false;
    expect_fields(sweep, *find_section("sweep"));
}

TEST(Schema, SaysRangesAndChoices) {
    const nlohmann::json& layer = schema()["definitions"]["layer"]["properties"];
    EXPECT_EQ(layer["g"]["exclusiveMinimum"], -1);
    EXPECT_EQ(layer["g"]["exclusiveMaximum"], 1);
    EXPECT_EQ(layer["profile"]["enum"][1], "tent");
    EXPECT_EQ(layer["scale_height"]["type"], "string");
}

TEST(Schema, KnowsWhatExcludesWhat) {
    const std::string rules = schema()["definitions"]["layer"]["allOf"].dump();
    EXPECT_NE(rules.find(R"({"not":{"required":["extinction","absorption"]}})"), std::string::npos);
    EXPECT_NE(
        rules.find(R"("if":{"properties":{"phase":{"const":"isotropic"}},"required":["phase"]})"),
        std::string::npos);
}

}  // namespace
}  // namespace skybake::config
