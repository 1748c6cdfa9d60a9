#include "config/schema.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "config/fields.h"

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
