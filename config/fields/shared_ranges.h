// Ranges and sources that the field tables of several sections share.
#pragma once

#include <numbers>
#include <string_view>

#include "config/fields/fields.h"

namespace skybake::config {

inline constexpr Range unit_range{0, 1};
inline constexpr Range density_range{0, 1e6};
inline constexpr Range coefficient_range{0, 1e6};  // per metre
inline constexpr Range texel_range{1, 16384};
inline constexpr Range lookup_error_range{1e-7, 1};
inline constexpr Range texel_error_range{1e-5, 1};
inline constexpr Range elevation_range{-std::numbers::pi / 2, std::numbers::pi / 2};
inline constexpr Range camera_altitude_range{0, 1e12};
inline constexpr Range view_distance_range{1e-3, 1e12};

inline constexpr std::string_view hillaire_2020 =
    "Hillaire 2020, A Scalable and Production Ready Sky and Atmosphere Rendering Technique";
inline constexpr std::string_view bruneton_2008 =
    "Bruneton and Neyret 2008, Precomputed Atmospheric Scattering";
inline constexpr std::string_view bruneton_2017 =
    "Bruneton 2017, Precomputed Atmospheric Scattering: a New Implementation";
inline constexpr std::string_view olajos_2016 =
    "Olajos 2016, Real-Time Rendering of Volumetric Clouds";
inline constexpr std::string_view schneider_2015 =
    "Schneider and Vos 2015, The Real-Time Volumetric Cloudscapes of Horizon: Zero Dawn";

}  // namespace skybake::config
