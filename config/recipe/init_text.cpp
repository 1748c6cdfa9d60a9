#include "config/recipe/init_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "config/diagnostics/diagnostic.h"
#include "config/diagnostics/toml_source.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/towers.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

constexpr std::size_t comment_width = 98;

std::string comment(std::string_view text) { return wrap(text, "# ", comment_width); }

// Returns the first paragraph of the preset's head comment, and how the text is to be read.
std::string head(const Preset& preset, std::string_view full_name) {
    const std::string comment_lines = preset_comment(preset);
    const std::size_t end = std::min(comment_lines.find("\n\n"), comment_lines.size());
    return comment(std::string_view(comment_lines).substr(0, end)) + "#\n" +
           comment(fmt::format("Written by `skybake init --preset {}`. Uncomment a line to change "
                               "its value. `skybake explain {}` prints more of the preset and its "
                               "sources, `skybake explain KEY` more of a key.",
                               full_name, preset.name));
}

// Returns what the table, or else the default, chooses for a selector such as `profile`.
std::string selected_name(const Section& section, const Table& table, std::string_view selector) {
    const Entry* entry = find_entry(table, selector);
    const std::optional<Value> value =
        entry ? entry->value : parse_toml_value(find_field(section, selector)->fallback);
    const auto* text = value ? std::get_if<std::string>(&value->data) : nullptr;
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
    const bool is_matter = std::ranges::any_of(
        matter_keys, [&](auto key) { return find_entry(table, key) != nullptr; });
    if (field.key == "scattering" && is_matter) return false;
    return !is_excluded(field, section, table);
}

// Writes a key with its meaning beside it, or above it where there is no room.
std::string key_text(const Field& field, const std::string& value, std::string_view prefix) {
    const std::string assignment = fmt::format("{}{} = {}", prefix, field.key, value);
    for (const std::string& text : {describe_field(field), std::string(field.documentation)}) {
        std::string line = fmt::format("{}  # {}\n", assignment, text);
        if (line.size() <= comment_width + 1) return line;
    }
    return comment(field.documentation) + assignment + '\n';
}

// Lists defaults that take effect: those of keys of files, or those of all others.
enum class KeySet { own, of_files };
std::string defaults_text(const Section& section, const Table& table, KeySet keys,
                          std::string_view title) {
    std::string list;
    for (const Field& field : section.fields) {
        const bool is_of_files = !section.asset.empty() && field.role == Role::files;
        if (is_of_files != (keys == KeySet::of_files) || find_entry(table, field.key)) continue;
        if (!is_at_default(field, section, table)) continue;
        list += fmt::format("{}{} = {}", list.empty() ? "" : "; ", field.key, field.fallback);
    }
    if (list.empty()) return "";
    // Lines that go on are indented: whoever takes the `#` off others must not take theirs for a key.
    std::string text = wrap(fmt::format("{}: {}", title, list), "#   ", comment_width);
    return text.erase(1, 2);
}

// Writes the keys of a table, each after the prefix, and lists the defaults of others.
std::string section_text(const Section& section, const Table& table, std::string_view prefix = "") {
    std::string text;
    for (const Field& field : section.fields) {
        const Entry* entry = find_entry(table, field.key);
        if (entry) text += key_text(field, value_to_string(entry->value), prefix);
    }
    return text + defaults_text(section, table, KeySet::own, "by default");
}

std::string table_text(const Section& section, const std::string& path, const Table& table) {
    return fmt::format("\n# {}\n[{}]\n{}", section.documentation, path,
                       section_text(section, table));
}

// Says once what all bakes may say of their files, with the defaults of one of them.
std::string files_text(const Section& bake) {
    return '\n' + defaults_text(bake, {}, KeySet::of_files,
                                "Keys of files, which each [bake.NAME] may have, are by default");
}

// Returns the tables below a key, in the order of the text.
std::vector<const Entry*> named_tables(const Table& table, std::string_view key) {
    std::vector<const Entry*> entries;
    const Table* below = find_table(table, key);
    if (!below) return entries;
    for (const Entry& entry : *below) entries.push_back(&entry);
    std::ranges::sort(entries, {}, [](const Entry* entry) { return entry->key_place.line; });
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
    const Section* last = nullptr;
    for (const Entry* entry : named_tables(root, "bake")) {
        const auto& table = std::get<Table>(entry->value.data);
        const std::string* named = find_text(table, "asset");
        const Section* section = find_section("bake.*", named ? *named : entry->key);
        if (!section) continue;  // no preset has such a table
        text += table_text(*section, join_path("bake", entry->key), table);
        last = section;
    }
    return last ? text + files_text(*last) : text;
}

Table parse_preset(const Preset& preset) {
    const Source source{Source::Kind::preset, 0, std::string(preset.name),
                        std::string(preset.text)};
    DiagnosticList none_expected;
    return parse_toml(source, none_expected).value();
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

// Writes a section that starts from a preset: keys of its own, and the preset's keys as comments.
std::string section_from_preset(const Section& section, const std::string& path,
                                std::string_view preset, const Table& keys) {
    std::string text = fmt::format("\n# {}\n[{}]\n", section.documentation, path);
    return text + fmt::format("preset = \"{}\"\n", preset) + section_text(section, keys, "# ");
}

// Writes the tables below a cloud as comments: its height profile and the first of its towers.
std::string commented_tables(const Table& cloud, const std::string& path) {
    std::string text;
    const auto append = [&](std::string_view pattern, const std::string& at, const Table& table) {
        text += fmt::format("\n# [{}]\n{}", at, section_text(*find_section(pattern), table, "# "));
    };
    for (const std::string_view name : subtables("clouds.*")) {
        const Table* table = find_table(cloud, name);
        if (!table) continue;
        const std::string at = join_path(path, name);
        const std::string pattern = "clouds.*." + std::string(name);
        if (find_section(pattern)) {
            append(pattern, at, *table);
            continue;
        }
        const std::vector<const Entry*> towers = towers_in_order(*table);
        append(pattern + ".*", join_path(at, towers.front()->key),
               std::get<Table>(towers.front()->value.data));
        text += comment(fmt::format("The towers are {} to {}; `skybake show` prints them all.",
                                    towers.front()->key, towers.back()->key));
    }
    return text;
}

// Writes how pictures show the preset.
std::string preview_text(const Table& cloud) {
    const Table* preview = find_table(cloud, "preview");
    if (!preview) return "";
    std::string text = table_text(*find_section("preview"), "preview", *preview);
    const Table* camera = find_table(*preview, "camera");
    if (!camera) return text;
    return text + '\n' + "[preview.camera]\n" +
           section_text(*find_section("preview.camera"), *camera);
}

std::string bakes_of_cloud(const std::string& name) {
    const Section& volume = *find_section("bake.*", "cloud_volume");
    const Table occupancy = {text_entry("asset", "occupancy"), text_entry("of", name)};
    return fmt::format("\n# {}, of {}'s name and size\n[{}]\n", volume.documentation, name,
                       join_path("bake", name)) +
           table_text(*find_section("bake.*", "occupancy"), join_path("bake", name + "_occupancy"),
                      occupancy) +
           files_text(volume);
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
    const Table keys = parse_preset(preset);
    const std::string name = noise_init_name(preset.name);
    const std::string path = join_path("noise", name);
    const Section& bake = *find_section("bake.*", "noise_volume");
    std::string text = head(preset, preset.name);
    text += section_from_preset(*find_section("noise.*"), path, preset.name, keys);
    text += commented_channels(keys, path);
    text += table_text(bake, join_path("bake", name), bake_of_noise(preset.name, name));
    text += files_text(bake);
    return text + sweep_text(join_path(path, "seed"), "[1, 2, 3]");
}

std::string cloud_init_text(const Preset& preset) {
    Table keys = parse_preset(preset);
    name_listed_towers_of_cloud(keys);
    const std::string name(preset.name);
    const std::string path = join_path("clouds", name);
    std::string text = head(preset, "clouds." + name);
    text += section_from_preset(*find_section("clouds.*"), path, preset.name, keys);
    text += commented_tables(keys, path);
    text += preview_text(keys);
    text += bakes_of_cloud(name);
    return text + sweep_text(join_path(path, "cover"), "{ from = 0.1, to = 0.4, count = 4 }");
}

std::string particle_init_text(const Preset& preset) {
    const Table keys = parse_preset(preset);
    const std::string name(preset.name);
    const Section& bake = *find_section("bake.*", "phase");
    std::string text = head(preset, name);
    text +=
        section_from_preset(*find_section("particles.*"), join_path("particles", name), name, keys);
    text += table_text(bake, join_path("bake", name),
                       {text_entry("asset", "phase"), text_entry("particles", name)});
    text += table_text(bake, join_path("bake", name + "_sampling"),
                       {text_entry("asset", "phase"), text_entry("content", "inverse_cumulative"),
                        text_entry("particles", name)});
    text += files_text(bake);
    text += fmt::format(
        "\n# In a recipe with an atmosphere, this is a layer of them:\n"
        "#   [atmosphere.layers.{0}]\n#   profile = \"exponential\"\n#   scale_height = \"1 km\"\n"
        "#   phase = {{ mie = \"{0}\" }}\n#   number_density = \"10 /cm3\"\n",
        name);
    return text + sweep_text("wavelengths", "[[\"680 nm\"], [\"550 nm\"], [\"440 nm\"]]");
}

std::string init_text(const Preset& preset) {
    const Table root = parse_preset(preset);
    std::string text = head(preset, preset.name) + '\n';
    text += section_text(*find_section(""), root);
    for (const Entry* kind : named_tables(root, "particles")) {
        text += table_text(*find_section("particles.*"), join_path("particles", kind->key),
                           std::get<Table>(kind->value.data));
    }
    if (const Table* table = find_table(root, "atmosphere")) {
        text += table_text(*find_section("atmosphere"), "atmosphere", *table);
        text += layers_text(*table);
    }
    text += bakes_text(root);
    return text + sweep_text("atmosphere.ground_albedo", "{ from = 0, to = 0.6, count = 4 }");
}

}  // namespace skybake::config
