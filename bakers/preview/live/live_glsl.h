// The numbers of a recipe as GLSL, for the shaders of a live page.
#pragma once

#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/live/live_clouds.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// An atmosphere with the two tables that rays are marched by.
struct LiveLight {
    const config::Recipe* recipe = nullptr;
    const PreviewAsset* transmittance = nullptr;
    const PreviewAsset* multiple_scattering = nullptr;
    SkyMedium medium;
    SkyTables tables;
};

// Returns the constants and functions that sky.glsl names, with the lookups of the tables.
std::string live_air_glsl(const LiveLight& light);

// Returns examples/lookups/film.glsl and a function that calls it with the daylight of the air.
std::string film_glsl(const LiveLight& light);

// Returns those that tiles.glsl and clouds.glsl name, with the published lookups. There is at least one
// cloud.
std::string live_cloud_glsl(const std::vector<LiveCloud>& clouds);

// The phase function of each layer in its own row, over the places of phase_by_peaks
// (examples/lookups/phase.glsl), in four channels.
Image2<float> live_phases(const SkyMedium& medium);

}  // namespace skybake
