// Combines octaves into channels, a row at a time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// Computes one channel of `count` voxels from its gradient part (null if it has none), already
// scaled and shifted for fbm, and the rows of all cell fields. `count` is rounded up to whole
// vectors of at most kLanePadding floats. `out` is none of the inputs.
void combine_channel(const ChannelPlan& channel, const float* gradient,
                     const std::vector<const float*>& fields, std::size_t count, float* out);

// Computes one row of the packed channel from the rows of R, G, B and, for shape, A. `out` may be
// one of them.
void pack_channels(NoisePacking pack, const std::array<const float*, 4>& channels,
                   std::size_t count, float* out);

// Adds `weight` times the shape of an octave to the sums, or, if `set` is true, sets the sums to
// it.
void add_octave(OctaveShape shape, const float* octave, float weight, bool set, std::size_t count,
                float* sums);

// Replaces the sums by sums * scale + offset.
void scale_and_shift(float scale, float offset, std::size_t count, float* sums);

}  // namespace skybake::noise
