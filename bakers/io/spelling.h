// Words that files use for the enumerations of the parameters: those of recipes, from the field
// tables.
#pragma once

#include <optional>
#include <string_view>

#include "config/parameters.h"

namespace skybake {

std::string_view spell(config::PixelType type);           // "float", "half"
std::string_view spell(config::Compression compression);  // "none", "zip", "zips", "piz"

std::optional<config::PixelType> pixel_type_of(std::string_view word);
std::optional<config::Compression> compression_of(std::string_view word);

}  // namespace skybake
