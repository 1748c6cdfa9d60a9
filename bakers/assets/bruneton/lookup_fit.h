// Adjusts texels slightly so that lookups between them are right.
//
// Where light falls steeply (at dusk by half and more from one texel to the next) a linear lookup
// between exact texels is always too bright. Along each axis texels f_i are multiplied by scales
// x_i, which balance the errors at texels with those halfway between them by minimising
//
//   sum over i (x_i - 1)^2 + sum over i ((x_i f_i + x_(i+1) f_(i+1)) / (f_i + f_(i+1)) - t_i)^2
//
// t_i is the light halfway divided by the mean of the two texels, from cubic interpolation of the
// light's logarithm. The scales of all axes are multiplied.
#pragma once

#include <vector>

#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Returns the scales x of a line of texels, which must not be negative. They are 1 next to texels
// without light, or with less than rays are followed for, where the light halfway is not known.
std::vector<double> lookup_scales(const std::vector<double>& line);

// Scales the first `channels` channels of a table of scattering.
void fit_lookups(const ScatteringMapping& mapping, std::size_t channels, const BakeOptions& options,
                 VoxelArray& table);

}  // namespace skybake
