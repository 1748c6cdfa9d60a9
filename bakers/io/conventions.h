// What all tables and manifests share: the units that their numbers are in.
#pragma once

#include <string_view>

namespace skybake::conventions {

inline constexpr std::string_view length_unit = "km";
inline constexpr std::string_view coefficient_unit = "1/km";
inline constexpr std::string_view angle_unit = "cosine";
inline constexpr std::string_view radiance_unit = "1/sr";  // per unit of solar irradiance
inline constexpr double solar_irradiance = 1.0;  // E, per channel; multiply by the sun's own
inline constexpr std::string_view up_axis = "+y";
inline constexpr std::string_view texel_origin = "first column u = 0, first row v = 0";

}  // namespace skybake::conventions
