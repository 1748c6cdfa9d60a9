// Columns, densities and phase functions of several kinds of particles, after Ai et al. 2014 (asset
// = "optical_depth").
#pragma once

#include <memory>

#include "bakers/field/certify.h"
#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "config/assets/optical_depth.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"

namespace skybake {

struct Baked;

// Bakes the volume. The channels are the kinds, in their order: Y for one, R, G, B for two (B is 0)
// or three, R, G, B, A for four. column_table.h defines the texels of columns; tables of densities
// hold densities at altitudes, and those of phase functions hold 1/sr at scattering angles (for
// spheres at the middle wavelength). The certificate states errors of transmittance, of all kinds
// together and of each alone; errors of densities are relative to the value range, those of phase
// functions to their value.
//
// `volume` comes with name, parameters and details.
Outcome<Baked> bake_columns(const config::Atmosphere& atmosphere,
                            const config::OpticalDepthBake& bake, const BakeOptions& options,
                            Baked volume);

// The texels and the way in which they are measured, without the rest of a bake, for reports.
struct ColumnVoxels {
    std::shared_ptr<const VoxelSource> voxels;
    VolumeReference reference;
    VolumeComparison comparison;
};
ColumnVoxels column_voxels(const config::Atmosphere& atmosphere,
                           const config::OpticalDepthBake& bake);

}  // namespace skybake
