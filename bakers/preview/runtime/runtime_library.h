// One library for a whole bake: the air, the sky, the clouds and the curve of previews as GLSL with the numbers of
// the recipe, ready to call.
#pragma once

#include <optional>
#include <string>

#include "bakers/air/cloud_phase.h"
#include "bakers/preview/runtime/runtime_air.h"

namespace skybake {

// Returns the air of the recipe with the two tables that its rays are marched by, and the white of
// pictures under its light; nothing if an asset is missing, or is not of this recipe.
std::optional<RuntimeAir> runtime_air(const config::Recipe& recipe, const PreviewAssets& assets,
                                      int threads);

// Whether light has three or four channels, as shaders have it.
bool has_colours(const std::optional<RuntimeAir>& air);

// Returns a function linear_srgb of light in the tables' channels, with the daylight of the air as white.
std::string linear_srgb_glsl(const RuntimeAir& air);

// The numbers of a phase function of clouds, by which shaders compute it.
std::string glsl_phase(const CloudPhase& phase);

// Returns the library of a folder's assets. It is empty without two tables of three or four channels, and
// a comment says what is missing where the phase function of a layer is in no table. Volumes need no voxels.
std::string runtime_library(const PreviewAssets& assets, int threads);

}  // namespace skybake
