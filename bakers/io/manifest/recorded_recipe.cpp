#include "bakers/io/manifest/recorded_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bakers/io/files/file_diagnostic.h"
#include "config/diagnostics/toml_source.h"
#include "config/fields/fields.h"
#include "config/text/key_path.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;

// Keys that tell where others come from (`include`, `preset`, `frequency`): what they made is
// recorded beside them, and would contradict them. `enabled` stays, since nothing else says it.
bool only_tells_the_origin(const std::string& table, const std::string& key) {
    const auto sections = config::sections();
    return std::any_of(sections.begin(), sections.end(), [&](const config::Section& section) {
        const bool is_root = table.empty() && section.path.empty();  // "" is no path of keys
        if (!is_root && !config::path_matches(table, std::string(section.path))) return false;
        const config::Field* field = config::find_field(section, key);
        return field != nullptr && field->only_shown && field->kind != config::Kind::flag;
    });
}

config::Value value_of(const Json& json);

config::Table table_of(const Json& json) {
    config::Table table;
    for (const auto& [key, value] : json.items()) table.push_back({key, {}, value_of(value)});
    std::sort(table.begin(), table.end(),
              [](const config::Entry& a, const config::Entry& b) { return a.key < b.key; });
    return table;
}

config::Value value_of(const Json& json) {
    config::Value value;
    if (json.is_boolean()) value.data = json.get<bool>();
    if (json.is_number_integer()) value.data = json.get<std::int64_t>();
    if (json.is_number_float()) value.data = json.get<double>();
    if (json.is_string()) value.data = json.get<std::string>();
    if (json.is_object()) value.data = table_of(json);
    if (json.is_array()) {
        config::Array array;
        for (const Json& element : json) array.push_back(value_of(element));
        value.data = std::move(array);
    }
    return value;
}

// The tables below `path`, each with the values that are its own before those that it holds.
void append_toml(const Json& table, const std::string& path, std::string& text) {
    if (!path.empty()) text += fmt::format("[{}]\n", path);
    for (const auto& [key, value] : table.items()) {
        if (value.is_object() || value.is_null() || only_tells_the_origin(path, key)) continue;
        text +=
            fmt::format("{} = {}\n", config::spell_key(key), config::spell_value(value_of(value)));
    }
    for (const auto& [key, value] : table.items()) {
        if (value.is_object()) append_toml(value, config::join_path(path, key), text);
    }
}

}  // namespace

config::Outcome<config::Recipe> recorded_recipe(const Manifest& manifest, const std::string& name,
                                                const std::filesystem::path& folder) {
    const Json json = Json::parse(manifest.parameters, nullptr, false);
    std::string text;
    if (json.is_object()) append_toml(json, "", text);
    auto recipe = config::parse_recipe(text, name, folder);
    if (recipe.value) return {std::move(recipe.value), {}};  // its warnings were given at the bake
    const std::string reason =
        recipe.diagnostics.empty() ? "nothing is recorded" : recipe.diagnostics.front().message;
    return {{},
            {file_error("E0304", name,
                        fmt::format("cannot take the recipe from `{}`: {}", name, reason))}};
}

}  // namespace skybake
