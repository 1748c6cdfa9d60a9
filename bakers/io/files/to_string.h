// The words that files use for enumerations, and texts for amounts of memory. Enumerations of
// recipes have the same words as in recipes, from the field tables.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bakers/field/conventions.h"
#include "config/sections/forward.h"
#include "config/sections/pixel_types.h"

namespace skybake {

std::string_view to_string(PixelType type);  // "float", "half", "unorm8", "unorm16"
std::string_view to_string(config::Compression compression);      // "none", "zip", "zips", "piz"
std::string_view to_string(config::VdbCompression compression);   // "none", "zip", "blosc"
std::string_view to_string(config::Ktx2Compression compression);  // "none", "zstd"
std::string_view to_string(config::FileFormat format);            // "exr", "vdb", "bin"
std::string_view to_string(config::SheetLayout layout);           // "stack", "atlas"

std::string_view to_string(TexelConvention end_points);  // "texel_centres", "texture_edges"
std::string_view to_string(AxisWrap wrap);               // "clamp", "repeat"
std::string_view to_string(AxisFilter filter);           // "linear", "nearest"

std::optional<TexelConvention> end_points_of(std::string_view word);
std::optional<AxisWrap> axis_wrap_of(std::string_view word);
std::optional<AxisFilter> axis_filter_of(std::string_view word);
std::optional<PixelType> pixel_type_of(std::string_view word);
std::optional<config::SheetLayout> sheet_layout_of(std::string_view word);

// Writes an amount of memory or disk space for people: "12 B", "190 KiB", "1.5 GiB".
std::string byte_size_text(double bytes);

}  // namespace skybake
