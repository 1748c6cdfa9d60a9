// Words that files use for the enumerations of the parameters: those of recipes, from the field
// tables.
#pragma once

#include <optional>
#include <string_view>

#include "config/parameters.h"

namespace skybake {

std::string_view spell(config::PixelType type);              // "float", "half", "unorm8", "unorm16"
std::string_view spell(config::Compression compression);     // "none", "zip", "zips", "piz"
std::string_view spell(config::VdbCompression compression);  // "none", "zip", "blosc"
std::string_view spell(config::VolumeFormat format);         // "exr", "vdb", "bin"
std::string_view spell(config::VolumeLayout layout);         // "stack", "atlas"

std::optional<config::PixelType> pixel_type_of(std::string_view word);
std::optional<config::Compression> compression_of(std::string_view word);
std::optional<config::VolumeFormat> volume_format_of(std::string_view word);
std::optional<config::VolumeLayout> volume_layout_of(std::string_view word);

}  // namespace skybake
