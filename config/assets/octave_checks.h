// This header checks the octaves of a bake's noises against the voxels of the bake.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "config/fields/section_decoder.h"
#include "config/sections/noise.h"

namespace skybake::config {

// This says how a bake samples a noise.
struct OctaveGrid {
    std::array<int, 3> scale{1, 1, 1};  // multiplies the noise's frequencies
    NoiseSampling sampling = NoiseSampling::centers;
};

// Gathers the warnings about all noises of one bake, so that each warning is given once.
class OctaveChecks {
  public:
    explicit OctaveChecks(const std::array<int, 3>& size) : size_(size) {}

    // Adds a noise. Octaves of gain 0 do not count. Octaves that alias on purpose (Noise::aliases)
    // at the size that the noise is made for do not count either.
    void add(const Noise& noise, std::span<const NoiseChannel> channels, const OctaveGrid& grid);

    // Warns of octaves that add nothing (W0208) and of octaves that are too fine for the voxels
    // (W0203).
    void report(const Place& size_place, Decoder& decoder) const;

  private:
    void add_vanishing(const Noise& noise, const NoiseChannel& channel, const OctaveGrid& grid);
    void add_coarse(const Noise& noise, std::span<const NoiseChannel> channels,
                    const OctaveGrid& grid);

    std::array<int, 3> size_;
    std::vector<std::string> vanishing_;  // "octave 3 of channel R of noise `shape`"
    std::size_t coarse_ = 0;
    std::vector<std::string> needs_;  // one for each such noise: "`shape` needs 512x512x128"
};

}  // namespace skybake::config
