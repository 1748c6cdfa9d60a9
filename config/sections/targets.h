// This header lists the programs that `target` names: which assets each of them loads from which
// files, and the program's own files that are written beside them.
//
// To add a target, add its enumerator in file_formats.h, a row in target_table.cpp, and a text for
// each of its sidecars in bakers/io/targets.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/fields/fields.h"
#include "config/sections/file_formats.h"
#include "config/sections/forward.h"

namespace skybake::config {

// A key of a bake's section and the word that a target gives it: {"convention", "takram"}.
struct TargetKey {
    std::string_view key;
    std::string_view word;
    bool is_needed = true;  // the program loads no file of another value
};

// How a program loads some of the assets.
struct TargetUse {
    std::vector<std::string_view> assets;
    std::vector<FileFormat> formats;              // the formats that it loads
    PixelTypes pixel_types;                       // the types that it loads
    std::optional<PixelType> pixel_type = {};     // by default; none: that of the asset
    std::vector<std::string_view> sidecars = {};  // "*.three.js" is NAME.three.js
    std::size_t written = 1;  // how many of the formats, the first ones, are written by default
    std::vector<TargetKey> keys = {};
    std::size_t light_channels = 0;  // channels of light in each file; 0: any number
    // The mappings that the assets may have, the one to choose first; empty: any.
    std::vector<std::string_view> mappings = {};
};

struct TargetFacts {
    Target target;
    std::string_view name;
    std::string_view documentation;
    std::vector<TargetUse> uses;
    bool needs_every_level = false;  // it loads textures of one level, or of all down to one texel
};

// Returns all targets, in the order in which the documentation shows them.
std::span<const TargetFacts> targets();

const TargetFacts& facts_of(Target target);

// Returns how the program loads an asset of a mapping, or null if it loads the asset in none. It is the
// first use of the asset if none names the mapping. All uses of an asset have the same sidecars.
const TargetUse* find_use(const TargetFacts& target, std::string_view asset,
                          std::string_view mapping = {});

// Returns the words of `target`.
std::span<const Choice> target_choices();

// Returns the names of the program's own files beside those of a bake. Those of a sequence's first
// frame have the sequence's name.
std::vector<std::string> sidecar_names(const AssetFiles& files, std::string_view asset,
                                       const std::string& name);

}  // namespace skybake::config
