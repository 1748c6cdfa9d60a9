// Fills boxes with noise sample by sample: every voxel hashes all lattice points around it, a
// vector of voxels at a time, as noise libraries do. It serves octaves with more than one cell per
// voxel, where neighbouring voxels share no lattice points; for other octaves the benchmarks
// compare the other kernels with it. The result equals noise_specification.h bit for bit.
#pragma once

#include "bakers/field/level.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// Writes one octave, multiplied by its amplitude, to out[(z * chunk.size[1] + y) * row_stride + x],
// in rows of whole vectors.
void fill_gradient_octave_pointwise(const GradientOctave& octave, const VoxelBox& chunk,
                                    std::size_t row_stride, float* out);

void fill_cell_field_pointwise(const CellField& field, const VoxelBox& chunk,
                               std::size_t row_stride, float* out);

}  // namespace skybake::noise
