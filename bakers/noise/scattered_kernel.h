// Fills boxes with noise whose samples share no lattice rows, because they are displaced, or few
// points, as alligator noise does. Every voxel hashes the lattice points around its sample. The
// result equals tests/noise/noise_specification.h bit for bit.
#pragma once

#include <array>

#include "bakers/field/level.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The displacements of a chunk's samples along x, y and z, in tiles, in rows as `out` has them. Null
// pointers: samples lie where voxels do.
using DisplacedRows = std::array<const float*, 3>;

// Writes one octave, multiplied by its amplitude, to out[(z * chunk.size[1] + y) * row_stride + x],
// in rows of whole vectors. The octave is no derivative. Displacements are finite.
void fill_scattered_gradient_octave(const GradientOctave& octave, const VoxelBox& chunk,
                                    std::size_t row_stride, const DisplacedRows& displaced,
                                    float* out);

void fill_scattered_cell_field(const CellField& field, const VoxelBox& chunk,
                               std::size_t row_stride, const DisplacedRows& displaced, float* out);

// --- Noise that is not displaced ------------------------------------------------------------------

// Fills boxes with noise sample by sample: every voxel hashes all lattice points around it, a
// vector of voxels at a time, as noise libraries do. It serves octaves with more than one cell per
// voxel, where neighbouring voxels share no lattice points; for other octaves the benchmarks
// compare the other kernels with it. The result equals tests/noise/noise_specification.h bit for
// bit.

// Writes one octave, multiplied by its amplitude, to out[(z * chunk.size[1] + y) * row_stride + x],
// in rows of whole vectors.
void fill_gradient_octave_pointwise(const GradientOctave& octave, const VoxelBox& chunk,
                                    std::size_t row_stride, float* out);

void fill_cell_field_pointwise(const CellField& field, const VoxelBox& chunk,
                               std::size_t row_stride, float* out);

}  // namespace skybake::noise
