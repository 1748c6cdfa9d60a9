#include "config/octave_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>

#include "config/octave_sampling.h"
#include "config/volume_files_decoder.h"

namespace skybake::config {
namespace {

using Frequency = std::array<int, 3>;

std::string frequency_text(const Frequency& frequency) {
    const bool isotropic = frequency[0] == frequency[1] && frequency[1] == frequency[2];
    return isotropic ? fmt::format("{}", frequency[0]) : fmt::format("{}", frequency);
}

// One channel of a noise on the grid.
struct ChannelCheck {
    const Noise& noise;
    const NoiseChannel& channel;
    const OctaveGrid& grid;
    Decoder& decoder;

    Frequency scaled(const Frequency& frequency) const {
        return {frequency[0] * grid.scale[0], frequency[1] * grid.scale[1],
                frequency[2] * grid.scale[2]};
    }

    // Which of a series' octaves is the first of its kind; one of gain 0 is not there.
    template <class Test>
    std::optional<std::size_t> first_octave(const NoiseOctaves& octaves, Test test) const {
        const std::size_t count = std::min(octaves.frequencies.size(), octaves.gains.size());
        for (std::size_t i = 0; i < count; ++i) {
            if (octaves.gains[i] > 0 && test(scaled(octaves.frequencies[i]))) return i;
        }
        return std::nullopt;
    }

    std::string describe(const NoiseOctaves& octaves, std::size_t octave) const {
        const Frequency& frequency = octaves.frequencies[octave];
        const bool cellular = &octaves == &channel.worley_octaves;
        const bool is_scaled = grid.scale != Frequency{1, 1, 1};
        return fmt::format("octave {} of channel {} of noise `{}` ({}frequency {}{})", octave + 1,
                           channel.name, noise.name, cellular ? "Worley, " : "",
                           frequency_text(frequency),
                           is_scaled ? " times " + frequency_text(grid.scale) : "");
    }

    // False if an octave is nothing, which is reported. The derivatives that curl noise is made of
    // are not 0 where gradient noise is.
    bool check_zero() const {
        const bool has_gradients =
            channel.type == NoiseType::perlin || channel.type == NoiseType::perlin_worley;
        if (!has_gradients) return true;
        const auto octave = first_octave(channel.octaves, [&](const Frequency& frequency) {
            return is_zero_everywhere(frequency, grid.size, grid.sampling);
        });
        if (!octave) return true;
        decoder.diagnostics.error(
            "E0127", grid.size_place,
            fmt::format("{} is 0 at every voxel of {}", describe(channel.octaves, *octave),
                        spell_voxels(grid.size)),
            "a larger or odd size, a lower frequency, or an octave less");
        return false;
    }

    void warn_of_coarse() const {
        for (const NoiseOctaves* octaves : {&channel.octaves, &channel.worley_octaves}) {
            const auto octave = first_octave(*octaves, [&](const Frequency& frequency) {
                return is_coarse(frequency, grid.size);
            });
            if (!octave) continue;
            decoder.diagnostics.warning(
                "W0203", grid.size_place,
                fmt::format("{} has fewer than {} voxels a cell at size {}",
                            describe(*octaves, *octave), fewest_voxels_per_cell,
                            spell_voxels(grid.size)),
                "it aliases: a larger size, or a lower frequency");
            return;
        }
    }
};

}  // namespace

void check_octaves(const Noise& noise, std::span<const NoiseChannel> channels,
                   const OctaveGrid& grid, Decoder& decoder) {
    for (const NoiseChannel& channel : channels) {
        const ChannelCheck check{noise, channel, grid, decoder};
        if (check.check_zero()) check.warn_of_coarse();
    }
}

}  // namespace skybake::config
