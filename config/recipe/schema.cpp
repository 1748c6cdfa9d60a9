#include "config/recipe/schema.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "config/fields/fields.h"
#include "config/presets/presets.h"

namespace skybake::config {
namespace {

using Json = nlohmann::ordered_json;

// Returns the default as JSON. The defaults of the field tables are TOML that is also JSON.
Json default_json(const Field& field) { return Json::parse(field.fallback, nullptr, false); }

Json field_schema(const Field& field) {
    Json schema = field.kind.schema(field);
    schema["description"] = describe_field(field);
    if (!field.fallback.empty()) schema["default"] = default_json(field);
    return schema;
}

// Adds rules that allow at most one key of each exclusive group.
void add_exclusions(const Section& section, Json& rules) {
    for (std::size_t i = 0; i < section.fields.size(); ++i) {
        const Field& a = section.fields[i];
        for (std::size_t j = i + 1; j < section.fields.size(); ++j) {
            const Field& b = section.fields[j];
            if (!exclude_each_other(a, b)) continue;
            rules.push_back({{"not", {{"required", {a.key, b.key}}}}});
        }
    }
}

// Adds rules that forbid the keys of a selector's other values once the selector names a value.
void add_variants(const Section& section, Json& rules) {
    for (const Field& selector : section.fields) {
        for (const Choice& choice : selector.choices) {
            Json refused = Json::object();
            for (const Field& field : section.fields) {
                const bool elsewhere =
                    field.selector == selector.key && !applies(field, choice.name);
                if (elsewhere) refused[std::string(field.key)] = false;
            }
            if (refused.empty()) continue;
            const Json condition = {
                {"properties", {{std::string(selector.key), {{"const", choice.name}}}}},
                {"required", {selector.key}}};
            rules.push_back({{"if", condition}, {"then", {{"properties", refused}}}});
        }
    }
}

Json section_schema(const Section& section) {
    Json properties = Json::object();
    for (const Field& field : section.fields) {
        properties[std::string(field.key)] = field_schema(field);
    }
    Json schema = {{"type", "object"},
                   {"description", section.documentation},
                   {"properties", properties},
                   {"additionalProperties", false}};
    if (!section.asset.empty()) schema["properties"]["asset"]["const"] = section.asset;
    if (section.path.empty()) schema["properties"]["preset"]["examples"] = preset_names();
    Json rules = Json::array();
    add_exclusions(section, rules);
    add_variants(section, rules);
    if (!rules.empty()) schema["allOf"] = rules;
    return schema;
}

Json reference(std::string_view name) { return {{"$ref", fmt::format("#/definitions/{}", name)}}; }

// Describes a bake section of any asset. Its `asset` must name the asset, unless it is the volume of
// a cloud or a noise of its name.
Json named_bake_schema() {
    Json alternatives = {reference("cloud_volume"), reference("noise_volume")};
    for (const std::string_view asset : asset_names()) {
        alternatives.push_back({{"allOf", {reference(asset), {{"required", {"asset"}}}}}});
    }
    return {{"anyOf", alternatives}};
}

Json bakes_schema() {
    Json properties = Json::object();
    for (const std::string_view asset : asset_names()) {
        properties[std::string(asset)] = {{"anyOf", {reference(asset), reference("named_bake")}}};
    }
    return {{"type", "object"},
            {"description", "one section per file to bake; [bake.NAME] makes NAME.exr"},
            {"properties", properties},
            {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]+$"}}},
            {"additionalProperties", reference("named_bake")}};
}

Json noise_schema() {
    Json channels = Json::object();
    for (const char* name : {"R", "G", "B", "A", "Y"}) channels[name] = reference("noise_channel");
    Json schema = section_schema(*find_section("noise.*"));
    schema["properties"]["preset"]["examples"] = preset_names(noise_presets());
    schema["properties"]["channels"] = {
        {"type", "object"},
        {"description", "the channels R alone; R, G, B; R, G, B, A; or Y alone"},
        {"properties", channels},
        {"additionalProperties", false}};
    return schema;
}

// Describes a table of tables under any names.
Json named_schema(std::string_view description, std::string_view definition) {
    return {{"type", "object"},
            {"description", description},
            {"additionalProperties", reference(definition)}};
}

// Restricts names that become file names.
Json with_bare_names(Json schema) {
    schema["propertyNames"] = {{"pattern", "^[A-Za-z0-9_-]+$"}};
    return schema;
}

// Describes towers, which are tables under any names or a list.
Json towers_schema() {
    const Json list = {{"type", "array"}, {"items", reference("tower")}};
    return {{"anyOf", {list, named_schema("towers, by name", "tower")}}};
}

Json cloud_schema() {
    Json schema = section_schema(*find_section("clouds.*"));
    Json& properties = schema["properties"];
    properties["preset"]["examples"] = preset_names(cloud_presets());
    for (const std::string_view name : subtables("clouds.*")) {
        if (name == "towers") continue;
        properties[std::string(name)] =
            section_schema(*find_section("clouds.*." + std::string(name)));
    }
    properties["towers"] = towers_schema();
    return schema;
}

// Describes paths of keys, each with a list of values or a range.
Json sweep_schema() {
    const Json list = {{"type", "array"}, {"minItems", 1}};
    Json schema = section_schema(*find_section("sweep"));
    schema["additionalProperties"] = {{"anyOf", {list, section_schema(*find_section("sweep.*"))}}};
    return schema;
}

// Describes a layer. Its phase function is a name, or { mie = "NAME" } of particles.
Json layer_schema() {
    Json schema = section_schema(*find_section("atmosphere.layers.*"));
    schema["properties"]["preset"]["examples"] = preset_names(layer_presets());
    Json& phase = schema["properties"]["phase"];
    const Json named = {{"type", "object"},
                        {"properties", {{"mie", {{"type", "string"}}}}},
                        {"required", {"mie"}},
                        {"additionalProperties", false}};
    phase["anyOf"] = {{{"enum", phase["enum"]}}, named};
    phase.erase("enum");
    return schema;
}

Json definitions() {
    Json result = Json::object();
    result["cloud"] = cloud_schema();
    result["volume"] = section_schema(*find_section("volumes.*"));
    result["tower"] = section_schema(*find_section("clouds.*.towers.*"));
    result["noise"] = noise_schema();
    result["noise_channel"] = section_schema(*find_section("noise.*.channels.*"));
    result["particles"] = section_schema(*find_section("particles.*"));
    result["particles"]["properties"]["preset"]["examples"] = preset_names(particle_presets());
    result["layer"] = layer_schema();
    for (const std::string_view asset : asset_names()) {
        result[std::string(asset)] = section_schema(*find_section("bake.*", asset));
    }
    result["named_bake"] = named_bake_schema();
    return result;
}

}  // namespace

std::string recipe_schema() {
    Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                   {"title", "skybake recipe"}};
    schema.update(section_schema(*find_section("")));
    Json atmosphere = section_schema(*find_section("atmosphere"));
    atmosphere["properties"]["layers"] = named_schema("layers of the atmosphere, by name", "layer");
    schema["properties"]["atmosphere"] = atmosphere;
    schema["properties"]["color"] = section_schema(*find_section("color"));
    schema["properties"]["scene"] = section_schema(*find_section("scene"));
    Json preview = section_schema(*find_section("preview"));
    preview["properties"]["camera"] = section_schema(*find_section("preview.camera"));
    schema["properties"]["preview"] = preview;
    schema["properties"]["particles"] =
        with_bare_names(named_schema("particles, by name", "particles"));
    schema["properties"]["noise"] = with_bare_names(named_schema("noises, by name", "noise"));
    schema["properties"]["volumes"] = named_schema("volumes from files, by name", "volume");
    schema["properties"]["clouds"] = with_bare_names(named_schema("clouds, by name", "cloud"));
    schema["properties"]["bake"] = bakes_schema();
    schema["properties"]["sweep"] = sweep_schema();
    schema["definitions"] = definitions();
    return schema.dump(2) + '\n';
}

}  // namespace skybake::config
