// From octaves to channels, a row at a time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// One channel of `count` voxels, rounded up to whole vectors of at most kLanePadding: from its
// gradient part (null where it has none), already scaled and shifted for fbm, and the rows of all
// cell fields. `out` is none of them.
void combine_channel(const ChannelPlan& channel, const float* gradient,
                     const std::vector<const float*>& fields, std::size_t count, float* out);

// What becomes of a gradient stack's sum: sum * scale + offset.
struct SumShift {
    float scale = 1;
    float offset = 0;
};
SumShift sum_shift(const ChannelPlan& channel);

// One row of the packed channel from those of R, G, B and, for shape, A. `out` may be one of them.
void pack_channels(config::NoisePacking pack, const std::array<const float*, 4>& channels,
                   std::size_t count, float* out);

// Adds `weight` times the shape of an octave to sums, or sets them.
void add_octave(OctaveShape shape, const float* octave, float weight, bool set, std::size_t count,
                float* sums);

// sums * scale + offset.
void scale_and_shift(float scale, float offset, std::size_t count, float* sums);

}  // namespace skybake::noise
