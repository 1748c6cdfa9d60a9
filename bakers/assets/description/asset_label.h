// The labels that files of every kind of asset carry.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/math/facts.h"
#include "config/fields/fields.h"
#include "config/sections/forward.h"

namespace skybake {

struct Baked;

struct AssetLabel {
    std::string name;
    std::string parameters;  // TOML
    Facts details;
};

// Returns {"Y"} for one channel, {"R", "G", "B"} for three, and at most four names.
std::vector<std::string> names_of_channels(std::size_t count);

// Returns the names of channels that are the recipe's wavelengths.
std::vector<std::string> colour_names(const Parameters& parameters);

// Returns the word that recipes have for a choice of a key.
template <class Choice>
std::string word_of(std::string_view asset, std::string_view key, Choice choice) {
    const config::Section& section = *config::find_section("bake.*", asset);
    return std::string(config::choice_name(*config::find_field(section, key), choice));
}

// Return a labelled asset of the sky, whose bakers add what the values mean.
Baked labelled_table(const Parameters& parameters, AssetLabel label);
Baked labelled_sky_volume(const Parameters& parameters, AssetLabel label);

// Returns a labelled volume of any other asset.
Baked labelled_volume(AssetLabel label);

}  // namespace skybake
