// This header says how recipes ask for an asset: its section, what the section takes from the rest
// of the recipe, and which values the asset is made from. It also reads the [bake.NAME] sections.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/assets/asset.h"
#include "config/fields/fields.h"
#include "config/fields/roles.h"
#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"
#include "config/text/mapped.h"

namespace skybake::config {

struct LightFiles;
struct VolumeFrames;

// This is what is known of a recipe while its [bake.*] sections are resolved.
struct RecipeSoFar {
    const Parameters& parameters;  // all sections but the bakes
    // These two are set only for an asset that is made from another bake.
    std::span<const Bake> bakes = {};
    std::span<const std::string_view> unreadable = {};  // bakes with errors, not in `bakes`
};

// Fills in the values that follow from the rest of the recipe, and reports values that contradict
// it.
using ResolveAsset = void (*)(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder);

// How an asset uses the wavelengths of a recipe.
enum class UseOfLight {
    none,
    factors,   // one channel or number for each, by which a runtime multiplies light
    channels,  // light, one channel for each, with the weights that make its colours
    colors,    // light, turned into colours if the recipe has [color] with a space
};

struct AssetFacts {
    std::string_view name;           // the word after `asset =`
    std::string_view documentation;  // one line that says what the asset is
    bool is_table = false;           // it has two axes and is held in memory; else it is a volume
    bool needs_atmosphere = false;
    UseOfLight use_of_light = UseOfLight::none;
    bool of_another_bake = false;  // made from another bake, so resolved after all others
    bool of_all_frames = false;    // made from all frames of that bake; else from one
};

struct AssetKind {
    AssetFacts facts;
    Section section;
    ResolveAsset resolve = nullptr;
    std::function<Bake(const std::string& name, const DecodedSection& section)> bind;
    // Lists what an asset is made from besides its own section.
    std::function<std::vector<Read>(const Parameters& parameters, const Bake& bake)> reads;
    const AssetFiles& (*files)(const Bake& bake) = nullptr;
    int (*packet)(const Bake& bake) = nullptr;
    int (*frame)(const Parameters& parameters, const Bake& bake) = nullptr;
};

// Returns the kinds of all assets, in the order of assets.h.
std::span<const AssetKind* const> asset_kinds();

const AssetKind& kind_of(const Bake& bake);

// Returns the settings of a bake's files.
const AssetFiles& files_of(const Bake& bake);

// Returns the packet of wavelengths that a bake holds, or 0 if it holds all.
int packet_number(const Bake& bake);

// Returns the frame that a bake is or is made from, counted from 1, or 0 if that is none of a
// sequence.
int frame_of(const Parameters& parameters, const Bake& bake);

// Makes the kind of an asset that is made from what `reads` lists, or, if that is null, from its own
// section alone.
template <class Asset>
AssetKind make_asset_kind(const AssetFacts& facts, std::vector<Row<Asset>> rows,
                          std::vector<Read> (*reads)(const Parameters&, const Asset&),
                          ResolveAsset resolve = nullptr) {
    AssetKind kind;
    kind.facts = facts;
    kind.section = {"bake.*", facts.name, facts.documentation,
                    mapped<Field>(rows, &Row<Asset>::field)};
    kind.resolve = resolve;
    kind.bind = [rows = std::move(rows)](const std::string& name, const DecodedSection& section) {
        Asset asset;
        bind_section(section, std::span<const Row<Asset>>(rows), asset);
        return Bake{name, std::move(asset)};
    };
    kind.reads = [reads](const Parameters& parameters, const Bake& bake) {
        return reads ? reads(parameters, bake.as<Asset>()) : std::vector<Read>{};
    };
    kind.files = [](const Bake& bake) -> const AssetFiles& { return bake.as<Asset>(); };
    kind.packet = [](const Bake& bake) {
        if constexpr (std::is_base_of_v<LightFiles, Asset>) return bake.as<Asset>().packet;
        return 0;
    };
    kind.frame = [](const Parameters& parameters, const Bake& bake) {
        const Asset& asset = bake.as<Asset>();
        if constexpr (std::is_base_of_v<VolumeFrames, Asset>) return asset.frame;
        if constexpr (requires { asset.of; }) {
            return frame_of(parameters, bake_named(parameters, asset.of));
        }
        return 0;
    };
    return kind;
}

// The functions below list values that several assets are made from.

// Lists the wavelengths and, of the planet and its layers, the values with the given roles. It
// always lists the particles of layers whose coefficients follow from particles.
std::vector<Read> reads_of_air(const Parameters& parameters, Roles roles);

// Lists the same of light in that air, and what its colours follow from.
std::vector<Read> reads_of_light(const Parameters& parameters, Roles roles);
template <class Asset>
std::vector<Read> reads_of_all_light(const Parameters& parameters, const Asset&) {
    return reads_of_light(parameters, Roles::all());
}

// Lists the values of one layer with the given roles, and of its particles.
std::vector<Read> reads_of_layer(const Layer& layer, Roles roles);

std::vector<Read> reads_of_particles(const std::string& name);

// Lists the values of a noise and of the given channels.
std::vector<Read> reads_of_noise(const Noise& noise, std::span<const NoiseChannel> channels);

// Lists the values of a cloud and of what it takes from its noises.
std::vector<Read> reads_of_cloud(const Parameters& parameters, const std::string& name);

void append(std::vector<Read>&& more, std::vector<Read>& reads);

// Reads the [bake.NAME] sections: which asset each one makes, and the asset's own fields. The bakes
// stand in the order of the file. Bakes of unknown assets are reported and left out. `recipe` holds
// all sections but the bakes.
std::vector<Bake> decode_bakes(const Table& root, const Parameters& recipe, Decoder& decoder);

}  // namespace skybake::config
