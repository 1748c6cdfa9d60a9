// The numbers of a recipe as GLSL, for the shaders of a live page.
#pragma once

#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/preview/live/live_scene.h"
#include "bakers/preview/runtime/runtime_air.h"

namespace skybake {

// Whether a layer's phase function is a table, and the texture of such tables.
bool has_phase_rows(const SkyMedium& medium);
inline constexpr const char* phase_rows_name = "phase_rows";

// Returns the air of the recipe as sky.glsl and the page's other shaders call it (runtime_air.h).
std::string live_air_glsl(const RuntimeAir& air);

// Returns those that tiles.glsl and clouds.glsl name, with the published lookups. There is at least one
// cloud.
std::string live_cloud_glsl(const std::vector<LiveCloud>& clouds);

// The phase function of each layer in its own row, over the places of phase_by_peaks
// (examples/lookups/phase.glsl), in four channels.
Image2<float> live_phases(const SkyMedium& medium);

}  // namespace skybake
