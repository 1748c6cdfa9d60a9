#include "config/sections/noise.h"

#include <fmt/format.h>

#include "config/fields/section_decoder.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"

namespace skybake::config {
namespace {

using Frequency = std::array<int, 3>;

// This is one series of one channel while it is resolved.
struct SeriesResolver {
    DecodedSection& channel;
    const OctaveKeys& keys;
    Decoder& decoder;

    std::string path(std::string_view key) const { return join_path(channel.path, key); }

    // Returns the number of octaves that `octaves` asks for, or the number of gains if `octaves` is
    // not given.
    std::optional<std::size_t> count() const {
        const auto* gains = channel.value<std::vector<double>>(keys.gains);
        if (!channel.gives(keys.octaves) && gains) return gains->size();
        const std::optional<int> octaves = channel.whole(keys.octaves);
        if (!octaves) return std::nullopt;
        return static_cast<std::size_t>(*octaves);
    }

    void report_overflow(std::size_t octave, std::int64_t frequency) const {
        const Range& range = channel.at(keys.frequencies).field->range;
        decoder.diagnostics.error(
            "E0128", channel.place_of(keys.octaves, keys.frequency),
            fmt::format("octave {} of `{}` has frequency {}", octave + 1, path(keys.frequency),
                        frequency),
            fmt::format(
                "at most {} cells per tile are allowed: use fewer octaves or a lower lacunarity",
                static_cast<int>(range.maximum)));
    }

    // Returns frequency * lacunarity^i along each axis.
    std::optional<std::vector<Frequency>> series(std::size_t octaves) const {
        const auto most =
            static_cast<std::int64_t>(channel.at(keys.frequencies).field->range.maximum);
        const int lacunarity = *channel.whole(keys.lacunarity);
        std::vector<Frequency> result = {*channel.value<Frequency>(keys.frequency)};
        while (result.size() < octaves) {
            Frequency next{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::int64_t product = std::int64_t{result.back()[axis]} * lacunarity;
                if (product > most) {
                    report_overflow(result.size(), product);
                    return std::nullopt;
                }
                next[axis] = static_cast<int>(product);
            }
            result.push_back(next);
        }
        return result;
    }

    void resolve_frequencies() const {
        DecodedField& frequencies = channel.at(keys.frequencies);
        const std::optional<std::size_t> octaves = count();
        const bool has_series =
            channel.at(keys.frequency).value && channel.at(keys.lacunarity).value && octaves;
        // A source without a value was at fault, which has been reported.
        if (frequencies.source || !has_series) return;
        std::optional<std::vector<Frequency>> resolved = series(*octaves);
        if (resolved) derive(frequencies, std::move(*resolved));
    }

    // Returns the place of the key that was given last, so that the error does not point to a
    // preset.
    Place latest_place() const {
        const DecodedField* latest = &channel.at(keys.gains);
        for (const std::string_view key : {keys.octaves, keys.frequencies}) {
            const DecodedField& other = channel.at(key);
            if (other.source &&
                other.source->place.source->order > latest->source->place.source->order) {
                latest = &other;
            }
        }
        return latest->source->place;
    }

    void report_count(std::size_t octaves, std::size_t count) const {
        decoder.diagnostics.error(
            "E0108", latest_place(),
            fmt::format("`{}` has {} value{} for {} octave{}", path(keys.gains), count,
                        count == 1 ? "" : "s", octaves, octaves == 1 ? "" : "s"),
            "give one gain per octave");
    }

    void resolve_gains(std::size_t octaves) const {
        const std::optional<double> gain = channel.number(keys.gain);
        if (const auto* given = channel.value<std::vector<double>>(keys.gains)) {
            if (given->size() != octaves) report_count(octaves, given->size());
        } else if (gain) {
            std::vector<double> resolved = {1};
            while (resolved.size() < octaves) resolved.push_back(resolved.back() * *gain);
            derive(channel.at(keys.gains), std::move(resolved));
        }
    }
};

bool at_corners(std::size_t axis, NoiseSampling sampling) {
    return sampling == NoiseSampling::corners ||
           (sampling == NoiseSampling::slices_at_corners && axis == 2);
}

// Whether all voxels of an axis lie on lattice points. (2i + 1) f / 2N is an integer for all i if
// it is one for i = 0, and i f / N if it is one for i = 1. A single voxel at a corner lies at 0,
// and its size 1 divides every f.
bool meets_only_lattice_points(int frequency, int size, bool corners) {
    const std::int64_t denominator = std::int64_t{corners ? 1 : 2} * size;
    return frequency % denominator == 0;
}

}  // namespace

std::vector<std::string> channel_names(const Noise& noise) {
    if (noise.pack != NoisePacking::none || noise.channels.size() <= 1) return {"Y"};
    return mapped<std::string>(noise.channels, &NoiseChannel::name);
}

NoiseOctaves resolve_octaves(DecodedSection& channel, const OctaveKeys& keys, Decoder& decoder) {
    const SeriesResolver resolver{channel, keys, decoder};
    resolver.resolve_frequencies();
    const auto* frequencies = channel.value<std::vector<Frequency>>(keys.frequencies);
    if (!frequencies) return {};
    resolver.resolve_gains(frequencies->size());
    const auto* gains = channel.value<std::vector<double>>(keys.gains);
    return {*frequencies, gains ? *gains : std::vector<double>{}};
}

bool is_coarse(const std::array<int, 3>& frequency, const std::array<int, 3>& size) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t wanted = std::int64_t{fewest_voxels_per_cell} * frequency[axis];
        if (size[axis] > 1 && size[axis] < wanted) return true;
    }
    return false;
}

bool is_zero_everywhere(const std::array<int, 3>& frequency, const std::array<int, 3>& size,
                        NoiseSampling sampling) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool corners = at_corners(axis, sampling);
        if (!meets_only_lattice_points(frequency[axis], size[axis], corners)) return false;
    }
    return true;
}

}  // namespace skybake::config
