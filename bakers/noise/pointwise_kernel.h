// Noise sample by sample: every voxel hashes all the lattice points about it, a vector of voxels at
// a time, as noise libraries do. For octaves with more than a cell a voxel, where neighbours have
// nothing to share; elsewhere it is what the benchmarks measure the other kernels against. Equals
// noise_specification.h bit for bit.
#pragma once

#include "bakers/field/baked.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// One octave times its amplitude: out[(z * chunk.size[1] + y) * row_stride + x], rows in whole
// vectors.
void fill_gradient_octave_pointwise(const GradientOctave& octave, const VoxelBox& chunk,
                                    std::size_t row_stride, float* out);

void fill_cell_field_pointwise(const CellField& field, const VoxelBox& chunk,
                               std::size_t row_stride, float* out);

}  // namespace skybake::noise
