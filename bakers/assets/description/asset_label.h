// The labels that files of every kind of asset carry.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bakers/math/facts.h"
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

// Return a labelled asset of the sky, whose bakers add what the values mean.
Baked labelled_table(const Parameters& parameters, AssetLabel label);
Baked labelled_sky_volume(const Parameters& parameters, AssetLabel label);

// Returns a labelled volume of any other asset.
Baked labelled_volume(AssetLabel label);

}  // namespace skybake
