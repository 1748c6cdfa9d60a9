// This header describes the keys of the droplets of clouds, which assets of a cloud's light share.
#pragma once

#include "config/fields/fields.h"

namespace skybake::config {

// The lookups have the harmonics up to this degree.
inline constexpr Range harmonics_degree_range{0, 3};

// The fit of the droplets' phase function holds from 5 to 50 um.
inline constexpr Range droplet_range{5e-6, 50e-6};
inline constexpr Field droplet_diameter_field =
    key("droplet_diameter", Kind::length,
        "diameter of the droplets, which chooses their phase function", droplet_range,
        Default{R"("12 um")"}, Hint{"clouds have 8 to 30 um"},
        Cited{"Jendersie & d'Eon 2023, \"An Approximate Mie Scattering Function for Fog and Cloud "
              "Rendering\""});

inline constexpr Range albedo_range{1e-6, 1};
inline constexpr Field single_scattering_albedo_field =
    key("single_scattering_albedo", Kind::number, "share of the extinction that is scattering",
        albedo_range, Default{"1"}, Hint{"droplets in visible light have 1"});

}  // namespace skybake::config
