#include "config/init_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/diagnostic_list.h"
#include "config/fields.h"
#include "config/key_path.h"
#include "config/text_layout.h"
#include "config/toml_source.h"

namespace skybake::config {
namespace {

constexpr std::size_t text_width = 98;

std::string comment(std::string_view text) { return wrap(text, "# ", text_width); }

// The comment lines at the head of the preset's text.
std::string head_comment(std::string_view text) {
    std::string head;
    while (text.starts_with('#')) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        head += std::string(text.substr(0, end)) + '\n';
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return head;
}

// What the table, or else the default, chooses for a selector such as `profile`.
std::string selected_name(const Section& section, const Table& table, std::string_view selector) {
    const Entry* entry = find_entry(table, selector);
    if (entry) {
        const auto* text = std::get_if<std::string>(&entry->value.data);
        return text ? *text : "";
    }
    const Field* field = find_field(section, selector);
    const std::optional<Value> fallback = field ? parse_toml_value(field->fallback) : std::nullopt;
    const auto* text = fallback ? std::get_if<std::string>(&fallback->data) : nullptr;
    return text ? *text : "";
}

// Whether an absent key's default would take effect, so that it is worth showing.
bool is_at_default(const Field& field, const Section& section, const Table& table) {
    if (field.fallback.empty()) return false;
    if (!field.selector.empty() && !applies(field, selected_name(section, table, field.selector))) {
        return false;
    }
    return std::none_of(section.fields.begin(), section.fields.end(), [&](const Field& other) {
        return exclude_each_other(field, other) && find_entry(table, other.key);
    });
}

std::string section_text(const Section& section, const Table& table) {
    std::string text;
    for (const Field& field : section.fields) {
        const Entry* entry = find_entry(table, field.key);
        if (entry) {
            text += comment(describe_field(field));
            text += fmt::format("{} = {}\n", field.key, spell_value(entry->value));
        } else if (is_at_default(field, section, table)) {
            text += comment(describe_field(field));
            text += fmt::format("# {} = {}\n", field.key, field.fallback);
        }
    }
    return text;
}

std::string table_text(const Section& section, const std::string& path, const Table& table) {
    return fmt::format("\n# {}\n[{}]\n{}", section.documentation, path,
                       section_text(section, table));
}

// The tables below a key, in the order of the text.
std::vector<const Entry*> named_tables(const Table& table, std::string_view key) {
    std::vector<const Entry*> entries;
    const Entry* parent = find_entry(table, key);
    const Table* below = parent ? as_table(parent->value) : nullptr;
    if (!below) return entries;
    for (const Entry& entry : *below) entries.push_back(&entry);
    std::sort(entries.begin(), entries.end(),
              [](const Entry* a, const Entry* b) { return a->key_place.line < b->key_place.line; });
    return entries;
}

std::string layers_text(const Table& atmosphere) {
    std::string text;
    for (const Entry* entry : named_tables(atmosphere, "layers")) {
        text += table_text(*find_section("atmosphere.layers.*"),
                           join_path("atmosphere.layers", entry->key),
                           std::get<Table>(entry->value.data));
    }
    return text;
}

std::string bakes_text(const Table& root) {
    std::string text;
    for (const Entry* entry : named_tables(root, "bake")) {
        const Section* section = find_section("bake.*", entry->key);
        if (!section) continue;  // presets name their sections after the asset
        text +=
            table_text(*section, join_path("bake", entry->key), std::get<Table>(entry->value.data));
    }
    return text;
}

std::optional<Table> parse_preset(const Preset& preset) {
    const Source source{Source::Kind::preset, 0, std::string(preset.name),
                        std::string(preset.text)};
    DiagnosticList none_expected;
    return parse_toml(source, none_expected);
}

// The keys of a table as comments, each with the value that the preset gives it.
std::string commented_keys(const Section& section, const Table& table) {
    std::string text;
    for (const Field& field : section.fields) {
        const Entry* entry = find_entry(table, field.key);
        const bool is_worth_showing = entry || is_at_default(field, section, table);
        if (!is_worth_showing) continue;
        const std::string value = entry ? spell_value(entry->value) : std::string(field.fallback);
        text += comment(describe_field(field));
        text += fmt::format("# {} = {}\n", field.key, value);
    }
    return text;
}

// What can be overridden in each channel: the keys that the preset gives.
std::string commented_channels(const Table& preset, const std::string& path) {
    std::string text;
    for (const Entry* entry : named_tables(preset, "channels")) {
        text += fmt::format("\n# [{}]\n", join_path(join_path(path, "channels"), entry->key));
        const auto& keys = std::get<Table>(entry->value.data);
        for (const Field& field : find_section("noise.*.channels.*")->fields) {
            const Entry* key = find_entry(keys, field.key);
            if (key) text += fmt::format("# {} = {}\n", field.key, spell_value(key->value));
        }
    }
    return text;
}

Table bake_of_noise(const std::string& name) {
    return {{"asset", {}, {std::string("noise_volume"), {}}}, {"noise", {}, {name, {}}}};
}

}  // namespace

std::string noise_init_name(std::string_view preset) {
    const std::size_t underscore = preset.rfind('_');
    return std::string(underscore == std::string_view::npos ? preset
                                                            : preset.substr(underscore + 1));
}

std::string noise_init_text(const Preset& preset) {
    const std::optional<Table> keys = parse_preset(preset);
    if (!keys) return std::string(preset.text);
    const std::string name = noise_init_name(preset.name);
    const std::string path = join_path("noise", name);
    const Section& section = *find_section("noise.*");
    std::string text = head_comment(preset.text);
    text += fmt::format(
        "#\n# Written by `skybake init --preset {}`. Lines of the form `# key = value` show what "
        "the\n# preset or a default says: take the # off to change one.\n",
        preset.name);
    text += fmt::format("\n# {}\n[{}]\n", section.documentation, path);
    text += comment(describe_field(*find_field(section, "preset")));
    text += fmt::format("preset = \"{}\"\n", preset.name);
    text += commented_keys(section, *keys) + commented_channels(*keys, path);
    return text + table_text(*find_section("bake.*", "noise_volume"), join_path("bake", name),
                             bake_of_noise(name));
}

std::string init_text(const Preset& preset) {
    const std::optional<Table> root = parse_preset(preset);
    if (!root) return std::string(preset.text);
    std::string text = head_comment(preset.text);
    text += fmt::format(
        "#\n# Written by `skybake init --preset {}`. Lines of the form `# key = value` "
        "show defaults.\n\n",
        preset.name);
    text += section_text(*find_section(""), *root);
    const Entry* atmosphere = find_entry(*root, "atmosphere");
    if (const Table* table = atmosphere ? as_table(atmosphere->value) : nullptr) {
        text += table_text(*find_section("atmosphere"), "atmosphere", *table);
        text += layers_text(*table);
    }
    return text + bakes_text(*root);
}

}  // namespace skybake::config
