// Media that tests share.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "config/recipe/recipe.h"
#include "tests/support/outcomes.h"

namespace skybake::test {

inline config::Recipe recipe_of(const std::string& text,
                                const std::vector<std::string>& settings = {}) {
    return test::without_errors(config::parse_recipe(text, "test.toml", {}, settings));
}

inline config::Atmosphere preset_atmosphere(const std::string& name,
                                            const std::vector<std::string>& settings = {}) {
    return recipe_of("preset = \"" + name + "\"\n", settings).parameters.atmosphere;
}

inline Medium preset_medium(const std::string& name,
                            const std::vector<std::string>& settings = {}) {
    return make_medium(preset_atmosphere(name, settings));
}

inline SkyMedium preset_sky(const std::string& name,
                            const std::vector<std::string>& settings = {}) {
    return make_sky_medium(preset_atmosphere(name, settings));
}

inline const std::vector<std::string>& preset_list() {
    static const std::vector<std::string> names = {"earth_hillaire", "earth_bruneton", "mars_rgb",
                                                   "dense_earth",    "tiny_planet",    "vacuum"};
    return names;
}

}  // namespace skybake::test
