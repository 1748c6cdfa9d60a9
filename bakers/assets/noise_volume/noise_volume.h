// The asset noise_volume: a noise sampled on a tile.
#pragma once

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "config/assets/noise_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/noise.h"

namespace skybake {

// Fills all of `volume` except its name and parameters. Returns E0401 or E0402 for a voxel that the
// pixel type cannot hold, and neither value nor diagnostics after an interruption.
config::Outcome<Baked> bake_noise_volume(const config::Noise& noise,
                                         const config::NoiseVolumeBake& bake,
                                         const BakeOptions& options, Baked volume);

}  // namespace skybake
