// Keys that several bake sections share, described once, for the field tables.
#pragma once

#include <array>

#include "config/fields/fields.h"

namespace skybake::config {

inline constexpr std::array compression_choices = {
    Choice{"none", "no compression"},
    Choice{"zip", "deflate, 16 lines at a time"},
    Choice{"zips", "deflate, line by line"},
    Choice{"piz", "wavelet, lossless; best for noise"},
};

inline constexpr Field asset_field{
    .key = "asset",
    .kind = Kind::text,
    .documentation = "asset to bake; by default the one that the section's name says"};

inline constexpr Field compression_field{
    .key = "compression",
    .kind = Kind::choice,
    .choices = compression_choices,
    .fallback = R"("zip")",
    .documentation = "compression of the EXR file, always lossless"};

}  // namespace skybake::config
