// Words that files use for the enumerations of the parameters: those of recipes, from the field
// tables.
#pragma once

#include <optional>
#include <string_view>

#include "bakers/field/baked.h"
#include "config/sections/files.h"

namespace skybake {

std::string_view spell(config::PixelType type);              // "float", "half", "unorm8", "unorm16"
std::string_view spell(config::Compression compression);     // "none", "zip", "zips", "piz"
std::string_view spell(config::VdbCompression compression);  // "none", "zip", "blosc"
std::string_view spell(config::FileFormat format);           // "exr", "vdb", "bin"
std::string_view spell(config::SheetLayout layout);          // "stack", "atlas"

std::string_view spell(TexelConvention end_points);  // "texel_centres", "texture_edges"
std::string_view spell(AxisWrap wrap);               // "clamp", "repeat"
std::string_view spell(AxisFilter filter);           // "linear", "nearest"

std::optional<TexelConvention> end_points_of(std::string_view word);
std::optional<AxisWrap> axis_wrap_of(std::string_view word);
std::optional<AxisFilter> axis_filter_of(std::string_view word);
std::optional<config::PixelType> pixel_type_of(std::string_view word);
std::optional<config::SheetLayout> sheet_layout_of(std::string_view word);

}  // namespace skybake
