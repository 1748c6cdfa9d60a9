// What files say of an asset whatever it is.
#pragma once

#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/facts.h"
#include "config/sections/parameters.h"

namespace skybake {

struct AssetLabel {
    std::string name;
    std::string parameters;  // TOML
    Facts details;
};

// {"R", "G", "B"}, or {"Y"} of one wavelength.
std::vector<std::string> colour_names(const config::Parameters& parameters);

// Of an asset of the sky, whose bakers add what the values are.
Baked labelled_table(const config::Parameters& parameters, AssetLabel label);
Baked labelled_sky_volume(const config::Parameters& parameters, AssetLabel label);

// Of any other.
Baked labelled_volume(AssetLabel label);

}  // namespace skybake
