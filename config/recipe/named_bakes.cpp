#include "config/recipe/recipe_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "config/fields/fields.h"
#include "config/presets/presets.h"
#include "config/recipe/merge.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// A kind of section, the asset that is its volume, and that asset's key that names the section.
struct VolumeOf {
    std::string_view section;
    std::string_view asset;
    std::string_view key;
};
constexpr std::array volumes = {VolumeOf{"clouds", "cloud_volume", "cloud"},
                                VolumeOf{"noise", "noise_volume", "noise"}};

bool has_section(const Table& root, std::string_view kind, const std::string& name) {
    const Table* named = find_table(root, kind);
    return named && find_entry(*named, name);
}

// Adds a text at the place of the bake's name, unless the key is there.
void add_text(const Entry& bake, std::string_view key, std::string_view text, Table& keys) {
    if (find_entry(keys, key)) return;
    Entry entry{std::string(key), bake.key_place, {std::string(text), bake.key_place}};
    const auto place = std::ranges::find_if(keys, [key](const Entry& e) { return e.key > key; });
    keys.insert(place, std::move(entry));
}

bool is_asset(const std::string& name) {
    const auto names = asset_names();
    return std::ranges::find(names, name) != names.end();
}

bool asset_is(const Table& keys, const std::string& name, std::string_view asset) {
    const Entry* entry = find_entry(keys, "asset");
    const auto* text = entry ? std::get_if<std::string>(&entry->value.data) : &name;
    return text && *text == asset;
}

void report_two(const Entry& bake, DiagnosticList& diagnostics) {
    diagnostics.error("E0118", bake.key_place,
                      fmt::format("[{}] may be the volume of [clouds.{}] or of [noise.{}]",
                                  join_path("bake", bake.key), bake.key, bake.key),
                      "add asset = \"cloud_volume\" or asset = \"noise_volume\"");
}

void name_bake(const Table& root, Entry& bake, DiagnosticList& diagnostics) {
    auto* const keys = std::get_if<Table>(&bake.value.data);
    if (!keys) return;
    const Entry* const entry = find_entry(*keys, "asset");
    const auto* const asset = entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
    if (entry ? !asset : is_asset(bake.key)) return;
    const VolumeOf* made = nullptr;
    for (const VolumeOf& volume : volumes) {
        if (asset ? *asset != volume.asset : !has_section(root, volume.section, bake.key)) continue;
        if (made) report_two(bake, diagnostics);
        if (!made) made = &volume;
    }
    if (!made || !has_section(root, made->section, bake.key)) return;
    add_text(bake, "asset", made->asset, *keys);
    add_text(bake, made->key, bake.key, *keys);
}

// Whether a bake may take the value: a number beyond [0, 1] is no cover, which the cloud itself says.
bool is_taken(const Entry& entry) {
    const auto* real = std::get_if<double>(&entry.value.data);
    const auto* whole = std::get_if<std::int64_t>(&entry.value.data);
    const double number = real ? *real : whole ? static_cast<double>(*whole) : 0;
    return entry.key != "cover" || (number >= 0 && number <= 1);
}

// Adds keys of the cloud that the bake names, unless it has them or others that exclude them.
void take_keys_of_cloud(const Table& root, Table& keys) {
    const std::string* name = find_text(keys, "cloud");
    const Table* all = find_table(root, "clouds");
    const Table* of_cloud = name && all ? find_table(*all, *name) : nullptr;
    if (!of_cloud) return;
    Table taken;
    for (const std::string_view key : {"cover", "size"}) {
        const Entry* entry = find_entry(*of_cloud, key);
        const bool is_said = key == "size" && find_entry(keys, "voxel_size");
        if (entry && !is_said && is_taken(*entry)) taken.push_back(*entry);
    }
    merge(taken, keys);
    keys = std::move(taken);
}

// Returns the kind of presets that the bake's `preset` is one of, or null.
const SectionPresets* swapped_with(const Entry& bake) {
    const Table* keys = as_table(bake.value);
    const std::string* name = keys ? find_text(*keys, "preset") : nullptr;
    return name ? find_section_presets(*name) : nullptr;
}

void report_swapped(const Entry& bake, const SectionPresets& kind, DiagnosticList& diagnostics) {
    const Entry& preset = *find_entry(*as_table(bake.value), "preset");
    diagnostics.error(
        "E0102", preset.key_place,
        fmt::format("unknown key `preset` in [{}]", join_path("bake", bake.key)),
        fmt::format("`preset` of {} belongs in [{}.{}]", kind.section, kind.section, bake.key));
}

}  // namespace

bool name_bakes_of_sections(Table& root, DiagnosticList& diagnostics) {
    Table* const bakes = table_at(root, "bake");
    if (!bakes) return true;
    const std::size_t count = bakes->size();
    std::erase_if(*bakes, [&](const Entry& bake) {
        const SectionPresets* kind = swapped_with(bake);
        if (!kind) return false;
        report_swapped(bake, *kind, diagnostics);
        Table* const named = table_at(root, kind->section);
        if (named) std::erase_if(*named, [&](const Entry& e) { return e.key == bake.key; });
        return true;
    });
    for (Entry& bake : *bakes) {
        name_bake(root, bake, diagnostics);
        auto* const keys = std::get_if<Table>(&bake.value.data);
        if (keys && asset_is(*keys, bake.key, "cloud_volume")) take_keys_of_cloud(root, *keys);
    }
    return bakes->size() == count;
}

}  // namespace skybake::config
