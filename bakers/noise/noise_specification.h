// The specification of the vector kernels, which must equal it bit for bit on every instruction
// set: one voxel at a time in plain float, written to be read. The order of every sum is part of
// the specification.
//
// Voxels may have any integer coordinates; the tile repeats.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

using Voxel = std::array<std::int64_t, 3>;

// How far from its voxel a sample is, in tiles. Null: it is not displaced.
using Displacement = std::array<float, 3>;

// Returns one octave of gradient noise multiplied by its amplitude.
float gradient_octave_at(const std::array<TileAxis, 3>& axes, const GradientOctave& octave,
                         const Voxel& voxel, const Displacement* displacement = nullptr);

// Returns one octave of cellular noise: worley noise in its value form, from the nearest points
// among the 125 cells around the sample, which always contain them, or alligator noise.
float cell_field_at(const std::array<TileAxis, 3>& axes, const CellField& field, const Voxel& voxel,
                    const Displacement* displacement = nullptr);

// Returns all output channels.
std::vector<float> noise_at(const NoisePlan& plan, const Voxel& voxel);

}  // namespace skybake::noise
