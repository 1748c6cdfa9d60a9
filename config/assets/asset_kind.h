// How recipes ask for an asset: its section, what that takes from the rest of the recipe, and which
// values the asset is made from.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/assets/asset.h"
#include "config/fields/fields.h"
#include "config/fields/roles.h"
#include "config/fields/section_decoder.h"
#include "config/sections/files.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// A recipe while its [bake.*] sections are resolved.
struct RecipeSoFar {
    const Parameters& parameters;  // all but the bakes
    // Only for an asset that is made of another bake's:
    std::span<const Bake> bakes = {};
    std::span<const std::string_view> unreadable = {};  // bakes at fault, which are not there
};

// Fills in what follows from the rest of the recipe, and reports what does not go with it.
using ResolveAsset = void (*)(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder);

struct AssetFacts {
    std::string_view name;           // the word of `asset = "..."`
    std::string_view documentation;  // what it is, in a line
    bool is_table = false;           // of two axes, held in memory; else a volume
    bool needs_atmosphere = false;
    bool of_another_bake = false;  // and is resolved after all others
};

struct AssetKind {
    AssetFacts facts;
    Section section;
    ResolveAsset resolve = nullptr;
    std::function<Bake(const std::string& name, const DecodedSection& section)> bind;
    // What an asset is made from besides its own section.
    std::function<std::vector<Read>(const Parameters& parameters, const Bake& bake)> reads;
    const AssetFiles& (*files)(const Bake& bake) = nullptr;
};

// All of assets.h, in its order.
std::span<const AssetKind* const> asset_kinds();

const AssetKind& kind_of(const Bake& bake);

// What the files of a bake are like.
const AssetFiles& files_of(const Bake& bake);

template <class Asset>
AssetKind make_asset_kind(const AssetFacts& facts, std::span<const Row<Asset>> rows,
                          std::vector<Read> (*reads)(const Parameters&, const Asset&),
                          ResolveAsset resolve = nullptr) {
    AssetKind kind;
    kind.facts = facts;
    kind.section = {"bake.*", facts.name, facts.documentation, {}};
    for (const Row<Asset>& row : rows) kind.section.fields.push_back(row.field);
    kind.resolve = resolve;
    kind.bind = [rows](const std::string& name, const DecodedSection& section) {
        Asset asset;
        bind_section(section, rows, asset);
        return Bake{name, std::move(asset)};
    };
    kind.reads = [reads](const Parameters& parameters, const Bake& bake) {
        return reads(parameters, bake.as<Asset>());
    };
    kind.files = [](const Bake& bake) -> const AssetFiles& { return bake.as<Asset>(); };
    return kind;
}

// Values that several assets are made from.

// The wavelengths, and of the planet and its layers what has these roles. Layers of particles have
// their coefficients from those, which are always among them.
std::vector<Read> reads_of_air(const Parameters& parameters, Roles roles);

// One layer, with its particles.
std::vector<Read> reads_of_layer(const Layer& layer, Roles roles);

std::vector<Read> reads_of_particles(const std::string& name);

// A noise and these of its channels.
std::vector<Read> reads_of_noise(const Noise& noise, std::span<const NoiseChannel> channels);

// A cloud and what it takes from its noises.
std::vector<Read> reads_of_cloud(const Parameters& parameters, const std::string& name);

void append(std::vector<Read>&& more, std::vector<Read>& reads);

// The [bake.NAME] sections: which asset each makes, and the asset's own fields.

// In the order of the file. Bakes of unknown assets are reported and left out. `recipe` is all of
// it but the bakes.
std::vector<Bake> decode_bakes(const Table& root, const Parameters& recipe, Decoder& decoder);

}  // namespace skybake::config
