// One voxel at a time in plain float: what the vector kernels must equal bit for bit on every
// instruction set, written for reading. The order of every sum is part of it.
//
// It takes any integer voxel, also outside of the tile, which repeats.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

using Voxel = std::array<std::int64_t, 3>;

// One octave of gradient noise times its amplitude.
float gradient_octave_at(const std::array<TileAxis, 3>& axes, const GradientOctave& octave,
                         const Voxel& voxel);

// One octave of cellular noise in its value form: the nearest points among the 125 cells about the
// sample, which always hold them.
float cell_field_at(const std::array<TileAxis, 3>& axes, const CellField& field,
                    const Voxel& voxel);

// All output channels.
std::vector<float> noise_at(const NoisePlan& plan, const Voxel& voxel);

}  // namespace skybake::noise
