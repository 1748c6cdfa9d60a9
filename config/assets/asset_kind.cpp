#include "config/assets/asset_kind.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <optional>

#include "config/assets/assets.h"
#include "config/assets/bake_parts.h"
#include "config/assets/file_decoder.h"
#include "config/assets/output_files.h"
#include "config/assets/target_decoder.h"
#include "config/sections/frames.h"
#include "config/sections/layer.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

template <class Asset>
const AssetKind& only_kind(Tag<Asset> asset) {
    static const AssetKind kind = asset_kind(asset);
    return kind;
}

// Returns null if there is no asset of this name.
const AssetKind* find_kind(std::string_view name) {
    const auto kinds = asset_kinds();
    const auto found = std::ranges::find_if(
        kinds, [name](const AssetKind* kind) { return kind->facts.name == name; });
    return found == kinds.end() ? nullptr : *found;
}

void report_unknown_asset(const std::string& asset, const Place& place, const std::string& path,
                          Decoder& decoder) {
    const std::vector<std::string_view> names = asset_names();
    std::string label = did_you_mean(asset, names);
    if (label.empty()) label = fmt::format("`asset` is one of {}", fmt::join(names, ", "));
    decoder.diagnostics.error(
        "E0118", place, fmt::format("[{}] asks for an unknown asset `{}`", path, shorten(asset)),
        std::move(label));
}

// Returns none and reports an error if the asset is unknown.
std::optional<OpenBake> read_bake(const Entry& entry, Decoder& decoder) {
    const std::string path = join_path("bake", entry.key);
    check_name(entry, path, "a file", decoder);
    const Table& table = *as_table(entry.value);
    const Entry* given = find_entry(table, "asset");
    const auto* asset = given ? std::get_if<std::string>(&given->value.data) : &entry.key;
    if (!asset) {
        decoder.diagnostics.error("E0103", given->value.place,
                                  fmt::format("`{}` must be a string", join_path(path, "asset")),
                                  fmt::format("use one of {}", fmt::join(asset_names(), ", ")));
        return std::nullopt;
    }
    const AssetKind* kind = find_kind(*asset);
    if (!kind) {
        report_unknown_asset(*asset, given ? given->value.place : entry.key_place, path, decoder);
        return std::nullopt;
    }
    OpenBake open{
        entry.key, kind,
        decode_section(kind->section, path, entry.key_place, table, Absent::filled_in, decoder)};
    // The default of `asset` is the section's name, which the field table cannot know.
    if (!given) open.section.at("asset").value = *asset;
    return open;
}

// Whether the recipe has a layer of that name. The layer may be at fault or switched off.
bool is_in_recipe(const Table& root, const std::string& name) {
    const Table* atmosphere = find_table(root, "atmosphere");
    const Table* layers = atmosphere ? find_table(*atmosphere, "layers") : nullptr;
    return layers && find_entry(*layers, name);
}

std::string what_there_is(const std::string& name, const Atmosphere& atmosphere) {
    const auto names = mapped<std::string_view>(atmosphere.layers, &Layer::name);
    if (names.empty()) return "the atmosphere has no layers";
    std::string label = did_you_mean(name, names);
    return label.empty() ? fmt::format("this recipe has {}", fmt::join(names, ", ")) : label;
}

// Reports names in the list `key` that are not layers of the atmosphere (E0138). Sections without
// this key pass.
void check_layer_names(const DecodedSection& bake, std::string_view key, const Table& root,
                       const Atmosphere& atmosphere, Decoder& decoder) {
    const DecodedField* decoded = bake.find(key);
    if (!decoded || !decoded->value || !decoded->source || !decoder.complete) return;
    const auto& names = *decoded->as<std::vector<std::string>>();
    for (auto name = names.begin(); name != names.end(); ++name) {
        const auto& layers = atmosphere.layers;
        const bool known = std::ranges::find(layers, *name, &Layer::name) != layers.end();
        const bool again = std::find(names.begin(), name, *name) != name;
        // A layer that exists but could not be read has been reported already.
        const bool is_off = !known && is_in_recipe(root, *name);
        if ((known && !again) || (is_off && decoder.diagnostics.has_errors())) continue;
        const std::string_view problem = again ? "names a layer twice"
                                         : is_off
                                             ? "names a layer that is switched off"
                                             : "names a layer that the atmosphere does not have";
        decoder.report("E0138", bake, key, fmt::format("{}: `{}`", problem, shorten(*name)),
                       again ? "name it once" : what_there_is(*name, atmosphere));
    }
}

// Returns the section with its lists of one value per wavelength cut to the packet's.
DecodedSection cut_to_packet(DecodedSection section, const Parameters& recipe, int packet) {
    const PacketRange range = packet_range(recipe, packet);
    for (DecodedField& decoded : section.fields) {
        const bool is_per_channel = decoded.field->kind.read == read_channels;
        if (!is_per_channel || !decoded.value) continue;
        auto& values = std::get<std::vector<double>>(*decoded.value);
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(range.first);
        values = {first, first + static_cast<std::ptrdiff_t>(range.count)};
    }
    return section;
}

Bake bind(const OpenBake& bake, const Parameters& recipe) {
    const bool has_packets = bake.section.find("packet") != nullptr;
    const std::optional<int> packet = has_packets ? bake.section.whole("packet") : std::nullopt;
    if (!packet) return bake.kind->bind(bake.name, bake.section);
    return bake.kind->bind(bake.name, cut_to_packet(bake.section, recipe, *packet));
}

}  // namespace

std::span<const AssetKind* const> asset_kinds() {
    static const std::vector<const AssetKind*> kinds = [] {
        std::vector<const AssetKind*> all;
        for_each_asset([&all](auto asset) { all.push_back(&only_kind(asset)); });
        return all;
    }();
    return kinds;
}

const AssetKind& kind_of(const Bake& bake) {
    const AssetKind* kind = nullptr;
    for_each_asset([&]<class Asset>(Tag<Asset> asset) {
        if (bake.is<Asset>()) kind = &only_kind(asset);
    });
    assert(kind);
    return *kind;
}

const AssetFiles& files_of(const Bake& bake) { return kind_of(bake).files(bake); }

int packet_number(const Bake& bake) { return kind_of(bake).packet(bake); }

int frame_of(const Parameters& parameters, const Bake& bake) {
    return kind_of(bake).frame(parameters, bake);
}

std::vector<Bake> decode_bakes(const Table& root, const Parameters& recipe, Decoder& decoder) {
    std::vector<OpenBake> open;
    std::vector<std::string_view> unreadable;
    const std::vector<const Entry*> entries = in_reading_order(subtable(root, "bake", "", decoder));
    for (const Entry* entry : entries) {
        const bool is_table = named_table(*entry, "bake", decoder) != nullptr;
        std::optional<OpenBake> bake = is_table ? read_bake(*entry, decoder) : std::nullopt;
        if (bake) {
            open.push_back(std::move(*bake));
        } else {
            unreadable.push_back(entry->key);
        }
    }
    for (OpenBake& bake : open) {
        const AssetFacts& facts = bake.kind->facts;
        resolve_target(bake.section, facts.name, recipe, decoder);
        check_formats(bake.section, facts.is_table, facts.use_of_light == UseOfLight::colors,
                      decoder);
        if (bake.kind->resolve && !facts.of_another_bake) {
            bake.kind->resolve(bake.section, {recipe}, decoder);
        }
        if (facts.is_table && !facts.of_another_bake) resolve_table_files(bake.section, decoder);
        for (const std::string_view key : {"layers", "mie_layers", "kinds"}) {
            check_layer_names(bake.section, key, root, recipe.atmosphere, decoder);
        }
    }
    open = divided_into_parts(std::move(open), recipe, entries, decoder);
    auto bakes = mapped<Bake>(open, [&](const OpenBake& bake) { return bind(bake, recipe); });
    // The bake that an asset is made from may stand after it in the file.
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (open[i].kind->facts.of_another_bake) {
            open[i].kind->resolve(open[i].section, {recipe, bakes, unreadable}, decoder);
            if (open[i].kind->facts.is_table) resolve_table_files(open[i].section, decoder);
            bakes[i] = bind(open[i], recipe);
        }
        append_values(open[i].section, decoder);
    }
    std::vector<Place> places;
    for (const OpenBake& bake : open) places.push_back(bake.section.place);
    check_output_files(bakes, places, decoder);
    return bakes;
}

}  // namespace skybake::config
