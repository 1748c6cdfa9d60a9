// This header holds everything that a user may say, as plain structs. A member's name is its TOML
// key, its --set path and its name in the parameters that files carry. The rows of fields
// (fields.h) give the unit, range, default and source of each member. load_recipe (recipe.h) fills
// the structs, so every value here is resolved and valid.
#pragma once

#include <any>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/sections/atmosphere.h"
#include "config/sections/color.h"
#include "config/sections/forward.h"
#include "config/sections/scene.h"
#include "config/text/quantity.h"

namespace skybake::config {

// This is one [bake.NAME] section.
struct Bake {
    std::string name;
    std::any asset;  // one of config/assets/assets.h; `asset =` names it, by default NAME does

    // `find` returns null and `is` returns false if the bake has another asset. `as` needs a bake
    // that is known to have this asset.
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
    Parameters();
    Parameters(const Parameters&);
    Parameters(Parameters&&) noexcept;
    Parameters& operator=(const Parameters&);
    Parameters& operator=(Parameters&&) noexcept;
    ~Parameters();

    Target target;                    // of bakes that name none
    std::vector<Length> wavelengths;  // without `color`, one per channel: Y, or R, G, B
    std::optional<Color> color;       // of the sky's tables of light
    Atmosphere atmosphere;            // has no radii and no layers if a recipe has only noises
    std::optional<Scene> scene;
    std::vector<Particles> particles;  // sorted by name
    std::vector<Noise> noises;         // sorted by name
    std::vector<VolumeFile> volumes;   // sorted by name
    std::vector<Cloud> clouds;         // sorted by name
    std::vector<Bake> bakes;           // in the order of the file
};

// Whether tables of light hold colours in place of wavelengths.
bool holds_colors(const Parameters& parameters);
// Returns the number of channels of tables of light: without colours, that of the atmosphere.
std::size_t channels_of_light(const Parameters& parameters);

// These return sections that other sections name. load_recipe has made sure that they exist.
const Noise& noise_named(const Parameters& parameters, std::string_view name);
const VolumeFile& volume_named(const Parameters& parameters, std::string_view name);
const Cloud& cloud_named(const Parameters& parameters, std::string_view name);
const Bake& bake_named(const Parameters& parameters, std::string_view name);

// Returns the noise that a cloud is made of, or null if it is made of a volume.
const Noise* noise_of(const Parameters& parameters, const Cloud& cloud);

}  // namespace skybake::config
