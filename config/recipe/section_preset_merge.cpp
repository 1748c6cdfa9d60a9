#include "config/recipe/merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "config/diagnostics/toml_source.h"
#include "config/presets/presets.h"
#include "config/sections/towers.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

// Says where a preset of another kind belongs. The text is empty if there is no preset of that
// name.
std::string home_of(const std::string& name) {
    if (find_preset(name)) {
        return fmt::format(
            "it is a preset of an atmosphere: write preset = \"{}\" at the top level", name);
    }
    const SectionPresets* kind = find_section_presets(name);
    if (!kind) return "";
    return fmt::format("it is a preset of a {}: name it below [{}.NAME]", kind->noun,
                       kind->section);
}

void report_unknown_preset(const SectionPresets& kind, const std::string& name, const Place& place,
                           DiagnosticList& diagnostics) {
    const auto names = preset_names(kind.all());
    std::string label = home_of(name);
    if (label.empty()) label = did_you_mean(name, names);
    if (label.empty()) label = fmt::format("choose one of {}", fmt::join(names, ", "));
    diagnostics.error("E0115", place,
                      fmt::format("unknown {} preset `{}`", kind.noun, shorten(name)),
                      std::move(label));
}

// Returns the keys of the preset that a section names, or none if it names none or there is no
// preset of that name.
std::optional<Table> preset_of(const SectionPresets& kind, const Value& name,
                               std::deque<Source>& sources, DiagnosticList& diagnostics) {
    const auto* text = std::get_if<std::string>(&name.data);
    if (!text) return std::nullopt;  // the decoder reports a value that is not a text
    const Preset* preset = find_preset(kind.all(), *text);
    if (!preset) {
        report_unknown_preset(kind, *text, name.place, diagnostics);
        return std::nullopt;
    }
    sources.push_back({Source::Kind::preset, -1, fmt::format("preset {}", preset->name),
                       std::string(preset->text)});
    std::optional<Table> keys = parse_toml(sources.back(), diagnostics);
    if (keys) name_listed_towers_of_cloud(*keys);
    return keys;
}

// Returns the presets of the sections below `path`, within the tables that lead there, as in
// [atmosphere.layers.*].
std::optional<Entry> nested(const Table& root, std::string_view path,
                            const std::function<Table(const Table& named)>& presets) {
    const std::size_t dot = path.find('.');
    const Entry* entry = find_entry(root, path.substr(0, dot));
    const Table* table = entry ? as_table(entry->value) : nullptr;
    if (!table) return std::nullopt;
    if (dot == path.npos)
        return Entry{entry->key, entry->key_place, {presets(*table), entry->value.place}};
    std::optional<Entry> inner = nested(*table, path.substr(dot + 1), presets);
    if (!inner) return std::nullopt;
    return Entry{entry->key, entry->key_place, {Table{std::move(*inner)}, entry->value.place}};
}

// Takes what a cloud's preset says of pictures out of its keys.
std::optional<Entry> take_preview(Table& keys) {
    Entry* const entry = find_entry(keys, "preview");
    if (!entry) return std::nullopt;
    Entry preview = std::move(*entry);
    keys.erase(keys.begin() + (entry - keys.data()));
    return preview;
}

// A tile that the recipe itself shows alone is framed as a whole: the preset's camera stands within it.
void leave_place_to_framing(const Table& root, Table& preview) {
    const Table* own = find_table(root, "preview");
    const Entry* single = own ? find_entry(*own, "single") : nullptr;
    const auto* is_single = single ? std::get_if<bool>(&single->value.data) : nullptr;
    Table* camera = table_at(preview, "camera");
    if (is_single && *is_single && camera) {
        std::erase_if(*camera, [](const Entry& entry) { return entry.key == "position"; });
    }
}

bool lay_over_presets(const SectionPresets& kind, Table& root, std::deque<Source>& sources,
                      DiagnosticList& diagnostics) {
    bool complete = true;
    std::optional<Entry> preview;
    std::optional<Entry> sections = nested(root, kind.section, [&](const Table& named) {
        Table presets;
        for (const Entry& entry : named) {
            const Table* table = as_table(entry.value);
            const Entry* preset = table ? find_entry(*table, "preset") : nullptr;
            if (!preset) continue;
            std::optional<Table> keys = preset_of(kind, preset->value, sources, diagnostics);
            complete = complete && keys;
            if (!keys) continue;
            preview = take_preview(*keys);
            presets.push_back({entry.key, entry.key_place, {std::move(*keys), entry.value.place}});
        }
        return presets;
    });
    if (!sections) return true;
    Table base = {std::move(*sections)};
    const bool is_alone = preview && as_table(find_entry(root, kind.section)->value)->size() == 1;
    if (is_alone) {
        leave_place_to_framing(root, std::get<Table>(preview->value.data));
        base.push_back(std::move(*preview));
    }
    merge(base, root);
    root = std::move(base);
    return complete;
}

// Whether the recipe itself says what the noise is made of.
bool has_noise(const Table& root, const std::string& name) {
    const Table* all = find_table(root, "noise");
    const Entry* entry = all ? find_entry(*all, name) : nullptr;
    if (!entry) return false;
    const Table* noise = as_table(entry->value);
    return !noise || find_entry(*noise, "preset") || find_entry(*noise, "channels");
}

// The noises that presets of clouds bring, by their names in the recipe.
using BroughtNoises = std::map<std::string, CloudNoisePreset>;

bool are_alike(const CloudNoisePreset& a, const CloudNoisePreset& b) {
    return a.preset == b.preset && a.pack == b.pack;
}

// Returns the name under which a cloud's preset brings its noise: `wanted`, or "WANTED_CLOUD" if the
// preset of another cloud brings another noise under that name.
std::string name_of_noise(const BroughtNoises& brought, const std::string& wanted,
                          const std::string& cloud, const CloudNoisePreset& noise) {
    const auto other = brought.find(wanted);
    if (other == brought.end() || are_alike(other->second, noise)) return wanted;
    return fmt::format("{}_{}", wanted, cloud);
}

// Names the noise that a key of a cloud asks for, if its preset brings that noise. Returns the noise as
// the text of a recipe, which is empty if the recipe has this noise or if no noise goes with the preset.
std::string brought_noise(const Table& root, const std::string& cloud,
                          const std::string& cloud_preset, std::string& name,
                          BroughtNoises& brought) {
    if (has_noise(root, name) || !is_bare_key(name)) return "";
    const CloudNoisePreset noise = noise_of_cloud_preset(cloud_preset, name);
    if (!noise.preset) return "";
    name = name_of_noise(brought, name, cloud, noise);
    if (has_noise(root, name) || !is_bare_key(name)) return "";
    if (!brought.emplace(name, noise).second) return "";
    return fmt::format("[noise.{}]\npreset = \"{}\"\npack = \"{}\"\n", name, noise.preset->name,
                       noise.pack);
}

// Lays the recipe over the noises that the presets of its clouds name, where it has no noise of
// that name.
void lay_over_noises_of_clouds(Table& root, std::deque<Source>& sources,
                               DiagnosticList& diagnostics) {
    Table* const clouds = table_at(root, "clouds");
    if (!clouds) return;
    Table base;
    BroughtNoises brought;
    for (Entry& cloud : *clouds) {
        Table* const table = std::get_if<Table>(&cloud.value.data);
        const std::string* preset = table ? find_text(*table, "preset") : nullptr;
        if (!preset || !find_preset(cloud_presets(), *preset)) continue;
        for (const std::string_view key : {"noise", "detail"}) {
            Entry* const named = find_entry(*table, key);
            auto* const name = named ? std::get_if<std::string>(&named->value.data) : nullptr;
            std::string text = name ? brought_noise(root, cloud.key, *preset, *name, brought) : "";
            if (text.empty()) continue;
            sources.push_back(
                {Source::Kind::preset, -1, fmt::format("preset {}", *preset), std::move(text)});
            if (const std::optional<Table> noise = parse_toml(sources.back(), diagnostics)) {
                merge(base, *noise);
            }
        }
    }
    merge(base, root);
    root = std::move(base);
}

}  // namespace

bool lay_sections_over_presets(Table& root, std::deque<Source>& sources,
                               DiagnosticList& diagnostics) {
    bool complete = true;
    const auto lay = [&](const SectionPresets& kind) {
        complete = lay_over_presets(kind, root, sources, diagnostics) && complete;
    };
    // Presets of clouds name noises, which themselves start from presets.
    const auto is_of_clouds = [](const SectionPresets& kind) { return kind.section == "clouds"; };
    const auto all = section_presets();
    const SectionPresets& clouds = *std::ranges::find_if(all, is_of_clouds);
    lay(clouds);
    lay_over_noises_of_clouds(root, sources, diagnostics);
    for (const SectionPresets& kind : all) {
        if (!is_of_clouds(kind)) lay(kind);
    }
    return complete;
}

}  // namespace skybake::config
