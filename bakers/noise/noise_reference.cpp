#include "bakers/noise/noise_reference.h"

#include <algorithm>
#include <cmath>

#include "bakers/math/transcendental.h"
#include "bakers/math/vectors.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/reference_lattice.h"

namespace skybake::noise {
namespace {

using config::WorleyFeature;
using config::WorleyValue;

using Frequency = std::array<int, 3>;
using reference::alligator;
using reference::improved_noise;
using reference::Lattice;
using reference::nearest_points;

// Tells an octave's lattice from the others of its sum.
struct OctaveName {
    Frequency frequency{};
    int repetition = 0;
};

// Frames repeat, so that any frame of the loop will do; this one is not negative.
int frame_of(const Noise& noise) {
    return (noise.time % noise.period + noise.period) % noise.period;
}

// Returns how many times smaller the cells of an octave are than the noise's largest, by their volumes.
double times_smaller(const Noise& noise, const Frequency& octave) {
    const auto cells = [](const Frequency& of) { return double{1} * of[0] * of[1] * of[2]; };
    double fewest = cells(octave);
    for (const NoiseChannel& channel : noise.channels) {
        for (const NoiseOctaves* octaves :
             {&channel.octaves, &channel.worley_octaves, &channel.warp_octaves}) {
            for (const Frequency& other : octaves->frequencies)
                fewest = std::min(fewest, cells(other));
        }
    }
    return cells(octave) / fewest;
}

Lattice lattice_of(const Noise& noise, const NoiseChannel& channel, Purpose purpose,
                   const OctaveName& octave) {
    Lattice lattice;
    lattice.period = octave.frequency;
    lattice.key =
        octave_key(noise.seed, channel.seed, purpose, octave.frequency, octave.repetition);
    if (noise.period > 0) {
        const double faster =
            exponential(logarithm(times_smaller(noise, octave.frequency)) / 3 * 2 / 3);
        lattice.time_period = static_cast<int>(std::lround(noise.time_cells * faster));
        lattice.loops = static_cast<double>(frame_of(noise)) / noise.period;
    }
    return lattice;
}

double lerp(double a, double b, double t) { return a + t * (b - a); }

double worley(const NoiseChannel& channel, const Lattice& lattice, const glm::dvec3& place) {
    const auto [first, second] = nearest_points(lattice, place);
    double distance = first;
    if (channel.feature == WorleyFeature::f2) distance = second;
    if (channel.feature == WorleyFeature::f2_minus_f1) distance = second - first;
    return worley_value(channel.value_form, distance);
}

template <class Octave>
double weighted_mean(const NoiseOctaves& octaves, const Octave& octave) {
    double sum = 0;
    double weights = 0;
    for (std::size_t i = 0; i < octaves.gains.size(); ++i) {
        const Frequency& frequency = octaves.frequencies[i];
        const auto end = octaves.frequencies.begin() + static_cast<std::ptrdiff_t>(i);
        const auto repetition = std::count(octaves.frequencies.begin(), end, frequency);
        sum += octaves.gains[i] * octave(OctaveName{frequency, static_cast<int>(repetition)});
        weights += octaves.gains[i];
    }
    return sum / weights;
}

double gradient_part(const Noise& noise, const NoiseChannel& channel, const glm::dvec3& place) {
    const double sum = weighted_mean(channel.octaves, [&](const OctaveName& octave) {
        const double n =
            improved_noise(lattice_of(noise, channel, Purpose::gradient, octave), place).value;
        if (channel.fractal == NoiseFractal::ridged) return 1 - std::fabs(n);
        return channel.fractal == NoiseFractal::billow ? std::fabs(n) : n;
    });
    if (channel.fractal == NoiseFractal::fbm) return 0.5 + 0.5 * sum;
    return channel.fractal == NoiseFractal::rectified ? std::max(0.0, sum) : sum;
}

double cell_part(const Noise& noise, const NoiseChannel& channel, const NoiseOctaves& octaves,
                 const glm::dvec3& place) {
    return weighted_mean(octaves, [&](const OctaveName& octave) {
        return worley(channel, lattice_of(noise, channel, Purpose::cells, octave), place);
    });
}

double alligator_part(const Noise& noise, const NoiseChannel& channel, const glm::dvec3& place) {
    return weighted_mean(channel.octaves, [&](const OctaveName& octave) {
        return alligator(lattice_of(noise, channel, Purpose::alligator, octave), place);
    });
}

// A component of the curl, per tile, over the greatest frequency of the first octave.
double curl_part(const Noise& noise, const NoiseChannel& channel, const NoiseOctaves& octaves,
                 const std::array<Purpose, 3>& potentials, std::size_t axis,
                 const glm::dvec3& place) {
    const std::size_t next = (axis + 1) % 3;
    const std::size_t last = (axis + 2) % 3;
    const double sum = weighted_mean(octaves, [&](const OctaveName& octave) {
        const auto slope = [&](std::size_t potential, std::size_t along) {
            const Lattice lattice = lattice_of(noise, channel, potentials[potential], octave);
            return improved_noise(lattice, place).slope[along] * octave.frequency[along];
        };
        return slope(last, next) - slope(next, last);
    });
    const Frequency& first = octaves.frequencies.front();
    return sum / *std::ranges::max_element(first);
}

// The place at which a channel is read instead of `place`.
glm::dvec3 displaced(const Noise& noise, const NoiseChannel& channel, const glm::dvec3& place) {
    glm::dvec3 result = place;
    for (std::size_t axis = 0; axis < 3 && channel.warp_strength != 0; ++axis) {
        const double by = channel.warp_by == config::NoiseWarp::curl
                              ? curl_part(noise, channel, channel.warp_octaves, kWarps, axis, place)
                              : weighted_mean(channel.warp_octaves, [&](const OctaveName& octave) {
                                    const Lattice lattice =
                                        lattice_of(noise, channel, kWarps[axis], octave);
                                    return improved_noise(lattice, place).value;
                                });
        result[axis] += channel.warp_strength * by / noise.repeats[axis];
    }
    return result;
}

double value_of(const Noise& noise, const NoiseChannel& channel, const glm::dvec3& where) {
    const glm::dvec3 place = displaced(noise, channel, where);
    switch (channel.type) {
        case NoiseType::constant:
            return channel.value;
        case NoiseType::perlin:
            return gradient_part(noise, channel, place);
        case NoiseType::worley:
            return cell_part(noise, channel, channel.octaves, place);
        case NoiseType::alligator:
        case NoiseType::curly_alligator:
            return alligator_part(noise, channel, place);
        case NoiseType::curl:
            return curl_part(noise, channel, channel.octaves, kPotentials,
                             static_cast<std::size_t>(channel.component), place);
        case NoiseType::perlin_worley: {
            const double cells = cell_part(noise, channel, channel.worley_octaves, place);
            return lerp(cells, 1, gradient_part(noise, channel, place));
        }
    }
    return 0;
}

// Hermite's cubic with level ends: 0 up to the first edge, 1 from the second on.
double risen(const std::array<double, 2>& edges, double value) {
    if (value <= edges[0]) return 0;
    if (value >= edges[1]) return 1;
    const double t = (value - edges[0]) / (edges[1] - edges[0]);
    return 3 * t * t - 2 * t * t * t;
}

double shaped(const NoiseChannel& channel, double value) {
    const auto& [low_in, high_in, low_out, high_out] = channel.remap;
    value = low_out + (value - low_in) / (high_in - low_in) * (high_out - low_out);
    if (channel.smoothstep) value = risen(*channel.smoothstep, value);
    if (channel.invert) value = 1 - value;
    // Schlick's bias has a pole beyond [0, 1], where it is left out: it is continuous so.
    if (value >= 0 && value <= 1) value /= (1 / channel.bias - 2) * (1 - value) + 1;
    return std::fmin(std::fmax(value, channel.clamp[0]), channel.clamp[1]);
}

}  // namespace

double worley_value(WorleyValue form, double distance) {
    switch (form) {
        case WorleyValue::distance:
            return distance;
        case WorleyValue::one_minus_distance:
            return std::max(0.0, 1 - distance);
        case WorleyValue::one_minus_distance_over_sqrt3:
            return 1 - distance / std::sqrt(3.0);
        case WorleyValue::one_minus_distance_squared:
            return std::max(0.0, 1 - distance * distance);
    }
    return distance;
}

std::vector<double> noise_reference(const Noise& noise, const std::array<double, 3>& place) {
    glm::dvec3 at = {place[0], place[1], place[2]};
    for (std::size_t i = 0; i < 3 && noise.period > 0; ++i) {
        const double loops = static_cast<double>(frame_of(noise)) / noise.period;
        at[i] -= loops * noise.drift[i] / noise.repeats[i];
    }
    std::vector<double> values;
    for (const NoiseChannel& channel : noise.channels) {
        values.push_back(shaped(channel, value_of(noise, channel, at)));
    }
    if (noise.pack == NoisePacking::none) return values;
    if (noise.pack == NoisePacking::detail) {
        return {0.625 * values[0] + 0.25 * values[1] + 0.125 * values[2]};
    }
    const double low = 0.625 * values[1] + 0.25 * values[2] + 0.125 * values[3] - 1;
    return {(values[0] - low) / (1 - low)};
}

}  // namespace skybake::noise
