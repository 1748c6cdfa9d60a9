#include "config/recipe/init_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "config/diagnostics/diagnostic.h"
#include "config/diagnostics/toml_source.h"
#include "config/fields/field_reader.h"
#include "config/fields/fields.h"
#include "config/sections/towers.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

constexpr std::size_t comment_width = 98;

std::string comment(std::string_view text) { return wrap(text, "# ", comment_width); }

// Returns the comment lines at the head of the preset's text.
std::string head_comment(std::string_view text) {
    std::string head;
    while (text.starts_with('#')) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        head += std::string(text.substr(0, end)) + '\n';
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return head;
}

// Returns what the table, or else the default, chooses for a selector such as `profile`.
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

constexpr std::array<std::string_view, 5> matter_keys = {"gas", "aerosol", "components",
                                                         "optical_depth", "visibility"};

// Whether the default of an absent key takes effect, so that it is worth showing.
bool is_at_default(const Field& field, const Section& section, const Table& table) {
    if (field.fallback.empty()) return false;
    if (!field.selector.empty() && !applies(field, selected_name(section, table, field.selector))) {
        return false;
    }
    if (!field.needs.empty() && !find_entry(table, field.needs)) return false;
    // The coefficients of a gas or an aerosol follow from it, and of spheres the phase function.
    const bool is_spheres = find_entry(table, "aerosol") || find_entry(table, "components");
    if (field.key == "phase" && is_spheres) return false;
    const bool is_matter = std::any_of(matter_keys.begin(), matter_keys.end(),
                                       [&](auto key) { return find_entry(table, key) != nullptr; });
    if (field.key == "scattering" && is_matter) return false;
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
            text += fmt::format("{} = {}\n", field.key, value_to_string(entry->value));
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

// Returns the tables below a key, in the order of the text.
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
        const auto& table = std::get<Table>(entry->value.data);
        const Entry* asset = find_entry(table, "asset");
        const auto* named = asset ? std::get_if<std::string>(&asset->value.data) : nullptr;
        const Section* section = find_section("bake.*", named ? *named : entry->key);
        if (!section) continue;  // no preset has such a table
        text += table_text(*section, join_path("bake", entry->key), table);
    }
    return text;
}

std::optional<Table> parse_preset(const Preset& preset) {
    const Source source{Source::Kind::preset, 0, std::string(preset.name),
                        std::string(preset.text)};
    DiagnosticList none_expected;
    return parse_toml(source, none_expected);
}

// Writes the keys of a table as comments, each with the value that the preset gives it.
std::string commented_keys(const Section& section, const Table& table) {
    std::string text;
    for (const Field& field : section.fields) {
        const Entry* entry = find_entry(table, field.key);
        const bool is_worth_showing = entry || is_at_default(field, section, table);
        if (!is_worth_showing) continue;
        const std::string value =
            entry ? value_to_string(entry->value) : std::string(field.fallback);
        text += comment(describe_field(field));
        text += fmt::format("# {} = {}\n", field.key, value);
    }
    return text;
}

// Writes what can be overridden in each channel, which is the keys that the preset gives.
std::string commented_channels(const Table& preset, const std::string& path) {
    std::string text;
    for (const Entry* entry : named_tables(preset, "channels")) {
        text += fmt::format("\n# [{}]\n", join_path(join_path(path, "channels"), entry->key));
        const auto& keys = std::get<Table>(entry->value.data);
        for (const Field& field : find_section("noise.*.channels.*")->fields) {
            const Entry* key = find_entry(keys, field.key);
            if (key) text += fmt::format("# {} = {}\n", field.key, value_to_string(key->value));
        }
    }
    return text;
}

Entry text_entry(std::string key, std::string text) {
    return {std::move(key), {}, {std::move(text), {}}};
}

// Returns the bake of a noise. A preset that copies the files of a web runtime is baked as that
// runtime loads them, as raw bytes.
Table bake_of_noise(std::string_view preset, const std::string& name) {
    const Entry asset = text_entry("asset", "noise_volume");
    const Entry noise = text_entry("noise", name);
    if (!preset.starts_with("takram_")) return {asset, noise};
    const Entry formats = {"formats", {}, {Array{{std::string("bin"), {}}}, {}}};
    return {asset, formats, noise, text_entry("pixel_type", "unorm8")};  // sorted by key
}

std::string note_on_comments(std::string_view preset) {
    return fmt::format(
        "#\n# Written by `skybake init --preset {}`. Commented lines show preset and default "
        "values;\n# uncomment one to change it.\n",
        preset);
}

// Writes a section that starts from a preset: keys of its own, and the preset's keys as comments.
std::string section_from_preset(const Section& section, const std::string& path,
                                std::string_view preset, const Table& keys) {
    std::string text = fmt::format("\n# {}\n[{}]\n", section.documentation, path);
    text += comment(describe_field(*find_field(section, "preset")));
    return text + fmt::format("preset = \"{}\"\n", preset) + commented_keys(section, keys);
}

std::array<int, 3> triple_of(const Table& table, const Section& section, std::string_view key) {
    const Entry* entry = find_entry(table, key);
    const Field& field = *find_field(section, key);
    DiagnosticList none_expected;
    const std::optional<FieldValue> value =
        entry ? read_field(field, key, entry->value, std::nullopt, none_expected)
              : default_value(field, std::nullopt);
    return value ? std::get<std::array<int, 3>>(*value) : std::array<int, 3>{1, 1, 1};
}

// These are the noises of a cloud preset, as sections of a recipe, and the number of voxels that
// shows them all.
struct CloudNoises {
    std::string text;
    std::array<int, 3> size{1, 1, 1};

    void add(const Preset& cloud, const Table& keys, std::string_view key, std::string_view scale) {
        const Entry* entry = find_entry(keys, key);
        if (!entry) return;
        const auto& name = std::get<std::string>(entry->value.data);
        const CloudNoisePreset noise = noise_of_cloud_preset(cloud.name, name);
        const std::optional<Table> noise_keys = parse_preset(*noise.preset);
        if (!noise_keys) return;
        text += fmt::format("\n# {}\n[noise.{}]\npreset = \"{}\"\n", preset_title(*noise.preset),
                            name, noise.preset->name);
        if (noise.pack != "none") text += fmt::format("pack = \"{}\"\n", noise.pack);
        const auto voxels = triple_of(*noise_keys, *find_section("noise.*"), "size");
        const auto times = triple_of(keys, *find_section("clouds.*"), scale);
        for (std::size_t i = 0; i < 3; ++i) size[i] = std::max(size[i], voxels[i] * times[i]);
    }

    // Adds voxels where noise is coarse along one axis of the extent, so that all are cubes.
    void make_cubes(const Table& keys) {
        const Field& field = *find_field(*find_section("clouds.*"), "extent");
        DiagnosticList none_expected;
        const std::optional<FieldValue> value = read_field(
            field, "extent", find_entry(keys, "extent")->value, std::nullopt, none_expected);
        if (!value) return;
        const auto& extent = std::get<std::array<double, 3>>(*value);
        double edge = extent[0] / size[0];
        for (std::size_t i = 1; i < 3; ++i) edge = std::min(edge, extent[i] / size[i]);
        for (std::size_t i = 0; i < 3; ++i) {
            size[i] = static_cast<int>(std::lround(extent[i] / edge));
        }
    }
};

// Writes the tables below a cloud as comments: its height profile and its towers.
std::string commented_tables(const Table& cloud, const std::string& path) {
    std::string text;
    const auto append = [&](std::string_view pattern, const std::string& at, const Table& table) {
        text += fmt::format("\n# [{}]\n{}", at, commented_keys(*find_section(pattern), table));
    };
    for (const std::string_view name : subtables("clouds.*")) {
        const Entry* entry = find_entry(cloud, name);
        const Table* table = entry ? as_table(entry->value) : nullptr;
        if (!table) continue;
        const std::string at = join_path(path, name);
        const std::string pattern = "clouds.*." + std::string(name);
        if (find_section(pattern)) {
            append(pattern, at, *table);
            continue;
        }
        for (const Entry* tower : towers_in_order(*table)) {
            append(pattern + ".*", join_path(at, tower->key), std::get<Table>(tower->value.data));
        }
    }
    return text;
}

std::string bakes_of_cloud(const std::string& name, const std::array<int, 3>& size) {
    Array voxels;
    for (const int edge : size) voxels.push_back({std::int64_t{edge}, {}});
    const Table volume = {text_entry("asset", "cloud_volume"),
                          text_entry("cloud", name),
                          {"size", {}, {std::move(voxels), {}}}};
    const Table occupancy = {text_entry("asset", "occupancy"), text_entry("of", name)};
    return table_text(*find_section("bake.*", "cloud_volume"), join_path("bake", name), volume) +
           table_text(*find_section("bake.*", "occupancy"), join_path("bake", name + "_occupancy"),
                      occupancy);
}

// Says how the recipe would be baked with many values of one of its keys.
std::string sweep_text(const std::string& path, std::string_view values) {
    return fmt::format(
        "\n# One recipe, many values: `skybake sweep` bakes it with each of\n#   [sweep]\n#   {} = "
        "{}\n",
        toml_string(path), values);
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
    std::string text = head_comment(preset.text) + note_on_comments(preset.name);
    text += section_from_preset(*find_section("noise.*"), path, preset.name, *keys);
    text += commented_channels(*keys, path);
    text += table_text(*find_section("bake.*", "noise_volume"), join_path("bake", name),
                       bake_of_noise(preset.name, name));
    return text + sweep_text(join_path(path, "seed"), "[1, 2, 3]");
}

std::string cloud_init_text(const Preset& preset) {
    std::optional<Table> keys = parse_preset(preset);
    if (!keys) return std::string(preset.text);
    name_listed_towers_of_cloud(*keys);
    const std::string name(preset.name);
    const std::string path = join_path("clouds", name);
    CloudNoises noises;
    noises.add(preset, *keys, "noise", "noise_scale");
    noises.add(preset, *keys, "detail", "detail_scale");
    noises.make_cubes(*keys);
    std::string text = head_comment(preset.text) + note_on_comments("clouds." + name);
    text += noises.text;
    text += section_from_preset(*find_section("clouds.*"), path, preset.name, *keys);
    text += commented_tables(*keys, path);
    text += bakes_of_cloud(name, noises.size);
    return text + sweep_text(join_path(path, "coverage"), "{ from = 0.2, to = 0.8, count = 4 }");
}

std::string particle_init_text(const Preset& preset) {
    const std::optional<Table> keys = parse_preset(preset);
    if (!keys) return std::string(preset.text);
    const std::string name(preset.name);
    const Section& bake = *find_section("bake.*", "phase");
    std::string text = head_comment(preset.text) + note_on_comments(name);
    text += section_from_preset(*find_section("particles.*"), join_path("particles", name), name,
                                *keys);
    text += table_text(bake, join_path("bake", name),
                       {text_entry("asset", "phase"), text_entry("particles", name)});
    text += table_text(bake, join_path("bake", name + "_sampling"),
                       {text_entry("asset", "phase"), text_entry("content", "inverse_cumulative"),
                        text_entry("particles", name)});
    text += fmt::format(
        "\n# In a recipe with an atmosphere, this is a layer of them:\n"
        "#   [atmosphere.layers.{0}]\n#   profile = \"exponential\"\n#   scale_height = \"1 km\"\n"
        "#   phase = {{ mie = \"{0}\" }}\n#   number_density = \"10 /cm3\"\n",
        name);
    return text + sweep_text("wavelengths", "[[\"680 nm\"], [\"550 nm\"], [\"440 nm\"]]");
}

std::string init_text(const Preset& preset) {
    const std::optional<Table> root = parse_preset(preset);
    if (!root) return std::string(preset.text);
    std::string text = head_comment(preset.text);
    text += fmt::format(
        "#\n# Written by `skybake init --preset {}`. Commented lines show default values; "
        "uncomment\n# one to change it.\n\n",
        preset.name);
    text += section_text(*find_section(""), *root);
    for (const Entry* kind : named_tables(*root, "particles")) {
        text += table_text(*find_section("particles.*"), join_path("particles", kind->key),
                           std::get<Table>(kind->value.data));
    }
    const Entry* atmosphere = find_entry(*root, "atmosphere");
    if (const Table* table = atmosphere ? as_table(atmosphere->value) : nullptr) {
        text += table_text(*find_section("atmosphere"), "atmosphere", *table);
        text += layers_text(*table);
    }
    text += bakes_text(*root);
    return text + sweep_text("atmosphere.ground_albedo", "{ from = 0, to = 0.6, count = 4 }");
}

}  // namespace skybake::config
