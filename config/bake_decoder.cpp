#include "config/bake_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "config/key_path.h"
#include "config/noise_volume_decoder.h"
#include "config/suggest.h"

namespace skybake::config {
namespace {

template <class Asset, auto fields>
Bake bind_as(const std::string& name, const DecodedSection& section) {
    Asset asset;
    bind(section, fields(), asset);
    return {name, asset};
}

constexpr std::string_view noise_volume = "noise_volume";

// Which struct each bake section of the field tables fills.
struct Binder {
    std::string_view asset;
    Bake (*bind)(const std::string& name, const DecodedSection& section);
};

constexpr std::array binders = {
    Binder{"transmittance", bind_as<TransmittanceBake, transmittance_fields>},
    Binder{"multiple_scattering", bind_as<MultipleScatteringBake, multiple_scattering_fields>},
    Binder{noise_volume, bind_as<NoiseVolumeBake, noise_volume_fields>},
};

Bake bind_bake(const std::string& name, std::string_view asset, const DecodedSection& section) {
    const auto* binder = std::find_if(binders.begin(), binders.end(),
                                      [&](const Binder& entry) { return entry.asset == asset; });
    assert(binder != binders.end());
    return binder->bind(name, section);
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

}  // namespace

std::optional<Bake> decode_bake(const std::string& name, const Place& place, const Table& table,
                                std::span<const Noise> noises, Decoder& decoder) {
    const std::string path = join_path("bake", name);
    if (!is_bare_key(name)) {
        decoder.diagnostics.error("E0117", place,
                                  fmt::format("[{}] cannot be the name of a file", shorten(path)),
                                  "letters, digits, `_` and `-`");
    }
    const std::optional<AssetName> asset = asset_name(name, place, table);
    if (!asset) {
        decoder.diagnostics.error("E0103", find_entry(table, "asset")->value.place,
                                  fmt::format("`{}` must be text", join_path(path, "asset")),
                                  fmt::format("one of {}", fmt::join(asset_names(), ", ")));
        return std::nullopt;
    }
    const Section* section = find_section("bake.*", asset->name);
    if (!section || asset->name.empty()) {
        report_unknown_asset(*asset, path, decoder);
        return std::nullopt;
    }
    DecodedSection decoded =
        decode_section(*section, path, place, table, Absent::filled_in, decoder);
    // The default of `asset` is the section's name, which the field table cannot know.
    DecodedField& asset_field = decoded.at("asset");
    if (!asset_field.source) asset_field.value = asset->name;
    if (asset->name == noise_volume) resolve_noise_volume(decoded, noises, decoder);
    append_values(decoded, decoder);
    return bind_bake(name, asset->name, decoded);
}

}  // namespace skybake::config
