// This header describes the keys of the droplets of clouds, which assets of a cloud's light share.
#pragma once

#include "config/fields/fields.h"

namespace skybake::config {

// The lookups have the harmonics up to this degree.
inline constexpr Range harmonics_degree_range{0, 3};

// The fit of the droplets' phase function holds from 5 to 50 um.
inline constexpr Range droplet_range{5e-6, 50e-6};
inline constexpr Field droplet_diameter_field{
    .key = "droplet_diameter",
    .kind = Kind::length,
    .range = droplet_range,
    .fallback = R"("12 um")",
    .documentation = "diameter of the droplets, which chooses their phase function",
    .hint = "clouds have 8 to 30 um",
    .citation =
        "Jendersie & d'Eon 2023, \"An Approximate Mie Scattering Function for Fog and Cloud "
        "Rendering\""};

inline constexpr Range albedo_range{1e-6, 1};
inline constexpr Field single_scattering_albedo_field{
    .key = "single_scattering_albedo",
    .kind = Kind::number,
    .range = albedo_range,
    .fallback = "1",
    .documentation = "share of the extinction that is scattering",
    .hint = "droplets in visible light have 1"};

}  // namespace skybake::config
