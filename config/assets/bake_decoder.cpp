#include "config/assets/bake_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "config/assets/cloud_volume_decoder.h"
#include "config/assets/noise_volume_decoder.h"
#include "config/assets/occupancy_decoder.h"
#include "config/assets/phase_decoder.h"
#include "config/assets/precomputed_decoder.h"
#include "config/assets/sky_decoder.h"
#include "config/text/key_path.h"
#include "config/text/suggest.h"

namespace skybake::config {
namespace {

template <class Asset, auto fields>
Bake bind_as(const std::string& name, const DecodedSection& section) {
    Asset asset;
    bind_section(section, fields(), asset);
    return {name, asset};
}

constexpr std::string_view aerial_perspective = "aerial_perspective";
constexpr std::string_view noise_volume = "noise_volume";
constexpr std::string_view cloud_volume = "cloud_volume";
constexpr std::string_view occupancy = "occupancy";
constexpr std::string_view phase = "phase";
constexpr std::string_view bruneton = "bruneton";
constexpr std::string_view optical_depth = "optical_depth";

// Which struct each bake section of the field tables fills.
struct Binder {
    std::string_view asset;
    Bake (*bind)(const std::string& name, const DecodedSection& section);
};

constexpr std::array binders = {
    Binder{"transmittance", bind_as<TransmittanceBake, transmittance_fields>},
    Binder{"multiple_scattering", bind_as<MultipleScatteringBake, multiple_scattering_fields>},
    Binder{"sky_view", bind_as<SkyViewBake, sky_view_fields>},
    Binder{aerial_perspective, bind_as<AerialPerspectiveBake, aerial_perspective_fields>},
    Binder{"irradiance", bind_as<IrradianceBake, irradiance_fields>},
    Binder{phase, bind_as<PhaseBake, phase_fields>},
    Binder{bruneton, bind_as<BrunetonBake, bruneton_fields>},
    Binder{optical_depth, bind_as<OpticalDepthBake, optical_depth_fields>},
    Binder{noise_volume, bind_as<NoiseVolumeBake, noise_volume_fields>},
    Binder{cloud_volume, bind_as<CloudVolumeBake, cloud_volume_fields>},
    Binder{occupancy, bind_as<OccupancyBake, occupancy_fields>},
};

// A bake whose keys are read, and that has yet to take what it takes from others.
struct OpenBake {
    std::string name;
    std::string asset;
    DecodedSection section;
};

Bake bind_bake(const OpenBake& open) {
    const auto* binder = std::find_if(binders.begin(), binders.end(), [&](const Binder& entry) {
        return entry.asset == open.asset;
    });
    assert(binder != binders.end());
    return binder->bind(open.name, open.section);
}

// The asset's name and where it is said; none if it is no text.
struct AssetName {
    std::string name;
    Place place;
};

std::optional<AssetName> asset_name(const std::string& name, const Place& place,
                                    const Table& table) {
    const Entry* entry = find_entry(table, "asset");
    if (!entry) return AssetName{name, place};
    const auto* text = std::get_if<std::string>(&entry->value.data);
    if (!text) return std::nullopt;
    return AssetName{*text, entry->value.place};
}

void report_unknown_asset(const AssetName& asset, const std::string& path, Decoder& decoder) {
    const std::vector<std::string_view> names = asset_names();
    std::string label = did_you_mean(asset.name, names);
    if (label.empty()) label = fmt::format("`asset` is one of {}", fmt::join(names, ", "));
    decoder.diagnostics.error(
        "E0118", asset.place,
        fmt::format("[{}] asks for an unknown asset `{}`", path, shorten(asset.name)),
        std::move(label));
}

// None if the asset is unknown, which is reported.
std::optional<OpenBake> read_bake(const std::string& name, const Place& place, const Table& table,
                                  Decoder& decoder) {
    const std::string path = join_path("bake", name);
    if (!is_bare_key(name)) {
        decoder.diagnostics.error("E0117", place,
                                  fmt::format("[{}] cannot be the name of a file", shorten(path)),
                                  "use only letters, digits, `_` and `-`");
    }
    const std::optional<AssetName> asset = asset_name(name, place, table);
    if (!asset) {
        decoder.diagnostics.error("E0103", find_entry(table, "asset")->value.place,
                                  fmt::format("`{}` must be a string", join_path(path, "asset")),
                                  fmt::format("use one of {}", fmt::join(asset_names(), ", ")));
        return std::nullopt;
    }
    const Section* section = find_section("bake.*", asset->name);
    if (!section || asset->name.empty()) {
        report_unknown_asset(*asset, path, decoder);
        return std::nullopt;
    }
    OpenBake open{name, asset->name,
                  decode_section(*section, path, place, table, Absent::filled_in, decoder)};
    // The default of `asset` is the section's name, which the field table cannot know.
    DecodedField& asset_field = open.section.at("asset");
    if (!asset_field.source) asset_field.value = asset->name;
    return open;
}

std::vector<const Entry*> bakes_in_file_order(const Table& bakes) {
    const auto order = [](const Entry* entry) {
        const Place& place = entry->key_place;
        return std::make_tuple(place.source ? place.source->order : -1, place.line, place.column);
    };
    std::vector<const Entry*> entries;
    for (const Entry& entry : bakes) entries.push_back(&entry);
    std::stable_sort(entries.begin(), entries.end(),
                     [&](const Entry* a, const Entry* b) { return order(a) < order(b); });
    return entries;
}

std::string lower_case(std::string_view name) {
    std::string text;
    for (const char c : name) text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

// Many file systems of macOS and Windows take them for one file.
void warn_of_equal_names(const std::vector<const Entry*>& entries, Decoder& decoder) {
    std::map<std::string, const Entry*> first;
    for (const Entry* entry : entries) {
        const auto [earlier, is_new] = first.try_emplace(lower_case(entry->key), entry);
        if (is_new) continue;
        decoder.diagnostics.warning(
            "W0209", entry->key_place,
            fmt::format("[bake.{}] and [bake.{}] are the same file on macOS and Windows",
                        entry->key, earlier->second->key),
            "choose names that differ in more than capital letters");
    }
}

}  // namespace

std::vector<Bake> decode_bakes(const Table& root, const Parameters& recipe, Decoder& decoder) {
    const std::vector<Noise>& noises = recipe.noises;
    const std::vector<Cloud>& clouds = recipe.clouds;
    std::vector<OpenBake> open;
    std::vector<std::string_view> unreadable;
    const std::vector<const Entry*> entries =
        bakes_in_file_order(subtable(root, "bake", "", decoder));
    warn_of_equal_names(entries, decoder);
    for (const Entry* entry : entries) {
        const Table* table = named_table(*entry, "bake", decoder);
        std::optional<OpenBake> bake =
            table ? read_bake(entry->key, entry->key_place, *table, decoder) : std::nullopt;
        if (bake) {
            open.push_back(std::move(*bake));
        } else {
            unreadable.push_back(entry->key);
        }
    }
    std::vector<Bake> bakes;
    for (OpenBake& bake : open) {
        if (bake.asset == aerial_perspective) {
            resolve_aerial_perspective(bake.section, recipe.scene, decoder);
        }
        if (bake.asset == phase) check_phase(bake.section, recipe, decoder);
        if (bake.asset == bruneton) resolve_bruneton(bake.section, recipe, decoder);
        if (bake.asset == optical_depth) {
            resolve_optical_depth(bake.section, recipe.atmosphere, decoder);
        }
        for (const std::string_view key : {"layers", "mie_layers", "kinds"}) {
            check_layer_names(bake.section, key, root, recipe.atmosphere, decoder);
        }
        if (bake.asset == noise_volume) resolve_noise_volume(bake.section, noises, decoder);
        if (bake.asset == cloud_volume) resolve_cloud_volume(bake.section, clouds, noises, decoder);
        bakes.push_back(bind_bake(bake));
    }
    // An occupancy takes from a cloud volume, which may stand behind it.
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (open[i].asset == occupancy) {
            resolve_occupancy(open[i].section, {bakes, unreadable, clouds, noises}, decoder);
            bakes[i] = bind_bake(open[i]);
        }
        append_values(open[i].section, decoder);
    }
    return bakes;
}

}  // namespace skybake::config
