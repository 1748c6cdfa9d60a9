#include "config/assets/octave_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/assets/file_decoder.h"

namespace skybake::config {
namespace {

using Frequency = std::array<int, 3>;

Frequency scaled(const Frequency& frequency, const OctaveGrid& grid) {
    return {frequency[0] * grid.scale[0], frequency[1] * grid.scale[1],
            frequency[2] * grid.scale[2]};
}

// Calls visit(index, frequency on the grid) for the octaves whose weight is not 0. If keys are at
// fault, the numbers of gains and octaves may differ.
template <class Visit>
void for_each_octave(const NoiseOctaves& octaves, const OctaveGrid& grid, const Visit& visit) {
    const std::size_t count = std::min(octaves.frequencies.size(), octaves.gains.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (octaves.gains[i] > 0) visit(i, scaled(octaves.frequencies[i], grid));
    }
}

// Whether the bake is at least as large as the size that the noise is made for.
bool is_at_home(const Noise& noise, const OctaveGrid& grid, const std::array<int, 3>& size) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (size[axis] < noise.size[axis] * grid.scale[axis]) return false;
    }
    return true;
}

}  // namespace

void OctaveChecks::add_vanishing(const Noise& noise, const NoiseChannel& channel,
                                 const OctaveGrid& grid) {
    // Curl noise is made of derivatives, which are not 0 where gradient noise is 0. Noise that is
    // displaced, or that lies between two lattices in time, is not read at lattice points.
    const bool has_gradients =
        channel.type == NoiseType::perlin || channel.type == NoiseType::perlin_worley;
    if (!has_gradients || channel.warp_strength != 0 || noise.period > 1) return;
    for_each_octave(channel.octaves, grid, [&](std::size_t i, const Frequency& frequency) {
        if (!is_zero_everywhere(frequency, size_, grid.sampling)) return;
        vanishing_.push_back(
            fmt::format("octave {} of channel {} of noise `{}`", i + 1, channel.name, noise.name));
    });
}

void OctaveChecks::add_coarse(const Noise& noise, std::span<const NoiseChannel> channels,
                              const OctaveGrid& grid) {
    if (noise.aliases && is_at_home(noise, grid, size_)) return;
    const std::size_t before = coarse_;
    std::array<int, 3> needed = size_;
    for (const NoiseChannel& channel : channels) {
        for (const NoiseOctaves* octaves :
             {&channel.octaves, &channel.worley_octaves, &channel.warp_octaves}) {
            for_each_octave(*octaves, grid, [&](std::size_t, const Frequency& frequency) {
                if (!is_coarse(frequency, size_)) return;
                ++coarse_;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    if (size_[axis] == 1) continue;
                    needed[axis] = std::max(needed[axis], fewest_voxels_per_cell * frequency[axis]);
                }
            });
        }
    }
    if (coarse_ == before) return;
    needs_.push_back(fmt::format("`{}` needs {}", noise.name, voxels_to_string(needed)));
}

void OctaveChecks::add(const Noise& noise, std::span<const NoiseChannel> channels,
                       const OctaveGrid& grid) {
    for (const NoiseChannel& channel : channels) add_vanishing(noise, channel, grid);
    add_coarse(noise, channels, grid);
}

void OctaveChecks::report(const Place& size_place, Decoder& decoder) const {
    if (!vanishing_.empty()) {
        const std::size_t more = vanishing_.size() - 1;
        const std::string others =
            more == 0 ? "" : fmt::format(" and {} other{}", more, more == 1 ? "" : "s");
        decoder.diagnostics.warning(
            "W0208", size_place,
            fmt::format("{}{} add{} nothing at size {}: every voxel falls on a lattice point",
                        vanishing_.front(), others, more == 0 ? "s" : "", voxels_to_string(size_)),
            "use a larger or odd size, a lower frequency or fewer octaves");
    }
    if (coarse_ == 0) return;
    decoder.diagnostics.warning(
        "W0203", size_place,
        fmt::format("{} octave{} too fine for {}: {}", coarse_, coarse_ == 1 ? " is" : "s are",
                    voxels_to_string(size_), fmt::join(needs_, ", ")),
        fmt::format("{} will alias; use a larger size or fewer octaves",
                    coarse_ == 1 ? "it" : "they"));
}

}  // namespace skybake::config
