// How recipes ask for an asset: its section, what that takes from the rest of the recipe, and which
// values the asset is made from.
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
#include "config/fields/row.h"
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
    // What the files of a volume are like; null of a table.
    const VolumeFiles* (*files)(const Bake& bake) = nullptr;
};

// All of assets.h, in its order.
std::span<const AssetKind* const> asset_kinds();

const AssetKind& kind_of(const Bake& bake);

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
    kind.files = [](const Bake& bake) -> const VolumeFiles* {
        if constexpr (std::is_base_of_v<VolumeFiles, Asset>) return bake.find<Asset>();
        return nullptr;
    };
    return kind;
}

}  // namespace skybake::config
