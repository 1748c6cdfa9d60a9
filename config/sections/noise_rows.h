// This header gives what the keys of noises and of their channels share, and the keys of two parts of
// a channel.
#pragma once

#include <span>
#include <string_view>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {

// These are the ranges of the keys of any series of octaves.
inline constexpr Range frequency_range{1, 1048576};
inline constexpr Range octave_range{1, 16};
inline constexpr Range lacunarity_range{1, 16};
inline constexpr Range gain_range{0, 4};
// It includes the weight of the last of 16 octaves with gain 4.
inline constexpr Range gains_range{0, 1e10};

inline constexpr std::string_view bridson_2007 =
    "Bridson, Hourihan and Nordenstam 2007, Curl-Noise for Procedural Fluid Flow";
inline constexpr std::string_view takram = "takram, three-clouds";

// Returns the keys of the cellular noise within a channel.
std::span<const NoiseChannelField> cellular_fields();

// Returns the keys of the noise that displaces a channel.
std::span<const NoiseChannelField> displacement_fields();

}  // namespace skybake::config
