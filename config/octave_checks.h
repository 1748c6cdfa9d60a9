// What the octaves of a noise become on the voxels of a bake.
#pragma once

#include <array>
#include <span>

#include "config/parameters.h"
#include "config/section_decoder.h"

namespace skybake::config {

// The voxels that a noise is laid over.
struct OctaveGrid {
    std::array<int, 3> size{};
    std::array<int, 3> scale{1, 1, 1};  // multiplies the noise's frequencies
    NoiseSampling sampling = NoiseSampling::centers;
    Place size_place = {};  // what said the size
};

// Reports octaves of these channels that are nothing on the grid (E0127) or too fine for it (W0203,
// once a channel).
void check_octaves(const Noise& noise, std::span<const NoiseChannel> channels,
                   const OctaveGrid& grid, Decoder& decoder);

}  // namespace skybake::config
