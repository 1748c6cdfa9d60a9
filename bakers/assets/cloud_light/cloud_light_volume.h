// The asset cloud_light: light within a cloud's layer, on a grid that is coarser than its voxels.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/depth_sweep.h"
#include "bakers/field/voxel_array.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/facts.h"
#include "config/assets/cloud_light.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// Fills all of `volume` except its name and parameters. `of` is the cloud's volume, of which `layer` is
// a channel. Returns E0401 and E0402 as for volumes, and neither value nor diagnostics after an
// interruption.
Outcome<Baked> bake_cloud_light(const Baked& of, const cloud_light::CloudLayer& layer,
                                const CloudLightBake& bake, const BakeOptions& options,
                                Baked volume);

// Returns the number of texels along each axis.
std::array<int, 3> cloud_light_size(const std::array<int, 3>& voxels, const CloudLightBake& bake);

// Returns how many voxels apart the places are, at most, from which texels are fitted.
int cloud_light_spacing(const CloudLightBake& bake);

// The channels' values at places that are evenly spaced, and how much errors count there: as the density
// around a place, and on a map everywhere alike.
struct SpacedValues {
    cloud_light::PlaceGrid places;
    std::vector<std::vector<float>> channels;
    std::vector<float> weights;
};

// Returns the sum of the densities of the voxels that are nearest to each place.
std::vector<float> density_around(const cloud_light::CloudLayer& layer,
                                  const cloud_light::PlaceGrid& places, int threads);

// Returns the values at places that are at most `spacing` voxels apart. They do not depend on the
// cell; they are incomplete after an interruption. `details` receives what the solver of radiance
// states.
SpacedValues cloud_light_values(const cloud_light::CloudLayer& layer, const CloudLightBake& bake,
                                int spacing, const BakeOptions& options, Facts& details);

// Returns the texels whose lookups are nearest to the values. They are of no use after an interruption.
std::shared_ptr<const VoxelArray> fitted_texels(const SpacedValues& values,
                                                const std::array<int, 3>& size,
                                                const CloudLightBake& bake,
                                                const BakeOptions& options);

}  // namespace skybake
