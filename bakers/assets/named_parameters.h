// The sections that others of a recipe name: load_recipe has made sure that they are there.
#pragma once

#include <string_view>

#include "config/parameters.h"

namespace skybake {

const config::Noise& noise_named(const config::Parameters& parameters, std::string_view name);
const config::Cloud& cloud_named(const config::Parameters& parameters, std::string_view name);
const config::Bake& bake_named(const config::Parameters& parameters, std::string_view name);

}  // namespace skybake
