// This header declares the asset "cloud_light": a coarse volume of the light within a cloud, which a
// runtime looks up in place of a march towards the sun.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/text/quantity.h"

namespace skybake::config {

// The first three have a channel for each sun, the others coefficients of spherical harmonics. The last
// four are radiance of light from the sun, from a uniform sky, from the recipe's sky and from the ground.
enum class CloudLightContents {
    optical_depth,
    transmittance,
    shadow,
    optical_depth_harmonics,
    transmittance_harmonics,
    sky_visibility,
    sun_radiance,
    sky_radiance,
    clear_sky_radiance,
    ground_radiance,
};

struct CloudLightBake : AssetFiles {
    std::string of;       // NAME of a [bake.NAME] with asset = "cloud_volume"
    std::string channel;  // a channel of that volume; empty: its first
    CloudLightContents contents = CloudLightContents::optical_depth;
    std::vector<Angle> sun_elevations;  // one, three or four; of radiance one
    std::vector<Angle> sun_azimuths;    // from +x towards +y, one for each elevation
    int degree = 1;                     // of the harmonics
    int part = 1;                       // which four of the coefficients, counted from 1
    int cell = 4;                       // voxels along each edge of a texel
    std::optional<double> max_error;    // instead of cell: bound on the RMS error of lookups
    Length droplet_diameter{12e-6};     // of radiance: chooses the phase function of droplets
    double single_scattering_albedo = 1;
};

// The largest cell, which is also the largest that `max_error` may choose.
inline constexpr int most_cloud_light_cell = 64;

constexpr bool is_per_sun(CloudLightContents contents) {
    return contents <= CloudLightContents::shadow;
}

// Whether the channels are optical depths to suns.
constexpr bool is_depth(CloudLightContents contents) {
    return contents == CloudLightContents::optical_depth || contents == CloudLightContents::shadow;
}

// Whether the contents depend on where one sun is.
constexpr bool is_of_one_sun(CloudLightContents contents) {
    return contents == CloudLightContents::sun_radiance ||
           contents == CloudLightContents::clear_sky_radiance;
}

constexpr bool is_radiance(CloudLightContents contents) {
    return contents >= CloudLightContents::sun_radiance;
}

// Returns the number of channels, 1 to 4 in any recipe that was accepted.
std::size_t channels_of(const CloudLightBake& bake);

}  // namespace skybake::config

namespace skybake {
using config::CloudLightBake;
using config::CloudLightContents;
}  // namespace skybake
