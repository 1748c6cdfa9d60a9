// The asset noise_volume: a noise sampled on a tile.
#pragma once

#include <array>
#include <vector>

#include "bakers/math/bake_options.h"
#include "config/assets/noise_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/noise.h"

namespace skybake {

struct Baked;

// Returns the range in which the values of each channel lie, but for a few.
std::vector<std::array<double, 2>> usual_ranges(const Noise& noise);

// Returns `volume`, which comes with name and parameters, with the voxels on demand and all else
// that the noise's files state, except levels of detail and what finish_volume adds.
Baked make_noise_volume(const Noise& noise, const config::NoiseVolumeBake& bake, Baked volume);

// Bakes the same, surveyed and certified. Returns E0401 or E0402 for a voxel that the
// pixel type cannot hold, and neither value nor diagnostics after an interruption.
Outcome<Baked> bake_noise_volume(const Noise& noise, const config::NoiseVolumeBake& bake,
                                 const BakeOptions& options, Baked volume);

}  // namespace skybake
