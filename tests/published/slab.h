// Plane air for published values: a slab 100 m high over black ground, on a planet with a radius of
// a million km.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "bakers/light/sky_ray.h"
#include "tests/support/atmospheres.h"

namespace skybake::test {

inline constexpr double kSlabHeight_m = 100;

// `phase` is the layer's lines that choose its phase function.
inline config::Atmosphere slab_atmosphere(double depth, double albedo, std::string_view phase) {
    const double per_meter = depth / kSlabHeight_m;
    return recipe_of(fmt::format(
                         "wavelengths = ['550 nm']\n[atmosphere]\nground_radius = '1e6 km'\n"
                         "top_radius = '1000000.1 km'\nground_albedo = 0\n"
                         "[atmosphere.layers.slab]\nprofile = 'slab'\nbottom_altitude = '0 m'\n"
                         "top_altitude = '{} m'\nscattering = '{} /m'\nabsorption = '{} /m'\n{}\n",
                         kSlabHeight_m, per_meter * albedo, per_meter * (1 - albedo), phase))
        .parameters.atmosphere;
}

inline SunZenith slab_sun(double cosine) {
    return {cosine, std::sqrt((1 - cosine) * (1 + cosine))};
}

// Light that leaves the slab at its top or at its bottom.
struct SlabView {
    double altitude_km = 0;
    SkyDirection direction;
};

// `cosine` is that of the angle to the vertical, in (0, 1].
inline SlabView slab_view(const SunZenith& sun, double cosine, bool is_up,
                          double azimuth_cosine = 1) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    return {is_up ? kSlabHeight_m / 1000 : 0.0,
            sky_direction(sun, is_up ? -cosine : cosine, sine, azimuth_cosine)};
}

}  // namespace skybake::test
