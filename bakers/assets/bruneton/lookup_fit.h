// Texels moved a little so that lookups between them come out right.
//
// Where light falls steeply, at dusk by half and more from one texel to the next, a linear lookup
// between exact texels is always too bright. Along each axis texels f_i are scaled by x_i that
// balance the errors at texels with those half way between:
//
//   sum over i (x_i - 1)^2 + sum over i ((x_i f_i + x_(i+1) f_(i+1)) / (f_i + f_(i+1)) - t_i)^2
//
// t_i is the light half way over the mean of the two: cubic interpolation of its logarithm. The
// scales of all axes are multiplied.
#pragma once

#include <vector>

#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// x of a line of texels that are not below 0. 1 where nothing is known of the light half way, next
// to texels that are 0.
std::vector<double> lookup_scales(const std::vector<double>& line);

// Scales the first `channels` of a table of scattering.
void fit_lookups(const ScatteringMapping& mapping, std::size_t channels, const BakeOptions& options,
                 DenseVolume& table);

}  // namespace skybake
