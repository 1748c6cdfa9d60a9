// Columns, densities and phase functions of several kinds of particles, after Ai et al. 2014 (asset
// = "optical_depth").
#pragma once

#include <memory>

#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/math/bake_options.h"
#include "config/assets/optical_depth.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// Channels are the kinds, in their order: Y of one, R, G, B of two (B is 0) or three, R, G, B, A of
// four. column_table.h says what texels hold of columns; tables of densities hold densities at
// altitudes, those of phase functions 1/sr at scattering angles (of spheres those of the middle
// wavelength). The certificate tells errors of transmittance, of all kinds together and of each
// alone; of densities in shares of the value range, of phase functions relative to their value.
//
// `volume` has its name, parameters and details.
config::Outcome<Baked> bake_columns(const config::Atmosphere& atmosphere,
                                    const config::OpticalDepthBake& bake,
                                    const BakeOptions& options, Baked volume);

// Its texels and how they are measured, without the rest of a bake: for reports.
struct ColumnVoxels {
    std::shared_ptr<const VoxelSource> voxels;
    VolumeReference reference;
    VolumeComparison comparison;
};
ColumnVoxels column_voxels(const config::Atmosphere& atmosphere,
                           const config::OpticalDepthBake& bake);

}  // namespace skybake
