// The sections that others of a recipe name: load_recipe has made sure that they are there.
#pragma once

#include <string_view>

#include "config/sections/parameters.h"

namespace skybake::config {

const Noise& noise_named(const Parameters& parameters, std::string_view name);
const Cloud& cloud_named(const Parameters& parameters, std::string_view name);
const Bake& bake_named(const Parameters& parameters, std::string_view name);

}  // namespace skybake::config
