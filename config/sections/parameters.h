// What a user may say, as plain structs. A member's name is its TOML key, its --set path and its
// name in the parameters that files carry. The rows of fields (fields.h) say unit, range, default
// and source of each; load_recipe (recipe.h) fills the structs, so every value here is resolved and
// valid.
#pragma once

#include <any>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/sections/atmosphere.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"
#include "config/sections/particles.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

// One [bake.NAME] section.
struct Bake {
    std::string name;
    std::any asset;  // `asset = "..."`, default NAME: one of those of config/assets/assets.h

    // Null, or false, where it is another one; `as` is of an asset that is known to be this one.
    template <class Asset>
    const Asset* find() const {
        return std::any_cast<Asset>(&asset);
    }
    template <class Asset>
    Asset* find() {
        return std::any_cast<Asset>(&asset);
    }
    template <class Asset>
    bool is() const {
        return find<Asset>() != nullptr;
    }
    template <class Asset>
    const Asset& as() const {
        return std::any_cast<const Asset&>(asset);
    }
    template <class Asset>
    Asset& as() {
        return std::any_cast<Asset&>(asset);
    }
};

struct Parameters {
    std::vector<Length> wavelengths;  // one per channel: 1 (a luminance table, Y) or 3 (R, G, B)
    Atmosphere atmosphere;            // without radii and layers in a recipe of noises alone
    std::optional<Scene> scene;
    std::vector<Particles> particles;  // by name
    std::vector<Noise> noises;         // by name
    std::vector<Cloud> clouds;         // by name
    std::vector<Bake> bakes;           // in the order of the file
};

// The sections that others of a recipe name: load_recipe has made sure that they are there.

const Noise& noise_named(const Parameters& parameters, std::string_view name);
const Cloud& cloud_named(const Parameters& parameters, std::string_view name);
const Bake& bake_named(const Parameters& parameters, std::string_view name);

}  // namespace skybake::config
