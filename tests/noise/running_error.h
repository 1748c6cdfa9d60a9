// Running error analysis of what the specification computes in float: how far it may be from the
// reference, derived operation by operation.
//
// A float operation adds at most 2^-24 of its result. Products of octaves' parts are bounded by the
// masses of gradient_octave_error; distances by distance_error.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bakers/noise/noise_reference.h"
#include "config/sections/noise.h"
#include "tests/noise/noises.h"

namespace skybake::test {

inline constexpr double kFloatRounding = 0x1p-24;

// An exact value and a bound on the error of what float makes of it.
struct Uncertain {
    double value = 0;
    double error = 0;

    Uncertain rounded() const {
        return {value, error + kFloatRounding * (std::fabs(value) + error) + 0x1p-149};
    }
};

// A number of a recipe, cast to float.
inline Uncertain cast(double value) { return Uncertain{value, 0}.rounded(); }
inline Uncertain operator+(Uncertain a, Uncertain b) {
    return Uncertain{a.value + b.value, a.error + b.error}.rounded();
}
inline Uncertain operator-(Uncertain a, Uncertain b) {
    return Uncertain{a.value - b.value, a.error + b.error}.rounded();
}
inline Uncertain operator*(Uncertain a, Uncertain b) {
    return Uncertain{a.value * b.value, std::fabs(a.value) * b.error +
                                            std::fabs(b.value) * a.error + a.error * b.error}
        .rounded();
}
// The quotient has an unbounded error where the divisor may be 0.
inline Uncertain operator/(Uncertain a, Uncertain b) {
    const double room = std::fabs(b.value) - b.error;
    const double quotient = a.value / b.value;
    if (!(room > 0)) return {quotient, std::numeric_limits<double>::infinity()};
    return Uncertain{quotient, (a.error + std::fabs(quotient) * b.error) / room}.rounded();
}
inline Uncertain exactly(double value) { return {value, 0}; }

// One octave of gradient noise, amplitude 1. Every product of a gradient's component, of which two
// are not 0, with three functions of the axes passes at most 14 roundings: three of tables, two of
// the amplitude, three products, five sums and one to spare. The products' magnitudes add up to at
// most 2, and to 7.5 where one axis has derivatives, |fade'| <= 1.875 on either side. The reference
// takes positions rounded to 2^-53 of `frequency` cells, and has slopes of less than 64.
//
// In four dimensions three components are not 0, which is half as much again, and time adds six
// roundings: its table, two products, two sums and one to spare. Drifts of up to three tiles lose
// two more bits of positions.
inline double gradient_octave_error(double frequency, bool derivative, bool moves) {
    return (moves ? 20 * 1.5 : 14) * kFloatRounding * (derivative ? 7.5 : 2) +
           (moves ? 4 : 1) * 64 * frequency * 0x1p-52;
}

// A distance of up to sqrt(3) cells. Along an axis the fraction's cast and its difference from the
// point, of up to 1, lose 2^-25 each, whole cells, with distances of up to 2, 2^-24. Three squares,
// two sums and the root, of which squares count half, lose 3.5 roundings of the distance.
inline double distance_error(double frequency) {
    return std::sqrt(3.0) * (0x1p-23 + 3.5 * kFloatRounding + frequency * 0x1p-50);
}

inline double largest(const std::array<int, 3>& frequency) {
    return *std::max_element(frequency.begin(), frequency.end());
}

// Bound on the error of a weighted sum of octaves, each of magnitude `magnitude(i)` at most and of
// error `error(i)`: the weight's cast, the product, and one rounding of each partial sum.
template <class Magnitude, class Error>
double sum_error(const config::NoiseOctaves& octaves, const Magnitude& magnitude,
                 const Error& error) {
    double weights = 0;
    for (const double gain : octaves.gains) weights += gain;
    const auto count = static_cast<double>(octaves.gains.size());
    double sum = 0;
    for (std::size_t i = 0; i < octaves.gains.size(); ++i) {
        sum += octaves.gains[i] / weights *
               (error(i) + (count + 3) * kFloatRounding * (magnitude(i) + error(i)));
    }
    return sum;
}

inline double gradient_error(const config::NoiseChannel& channel, bool moves) {
    return sum_error(
        channel.octaves, [&](std::size_t) { return moves ? 3.0 : 2.0; },
        [&](std::size_t i) {
            return gradient_octave_error(largest(channel.octaves.frequencies[i]), false, moves) +
                   kFloatRounding;  // of 1 - |n|
        });
}

inline double curl_error(const config::NoiseChannel& channel, bool moves) {
    const double mass = moves ? 1.5 * 7.5 : 7.5;
    const double unit = largest(channel.octaves.frequencies.front());
    const auto amplitude = [&](std::size_t i) {
        return 2 * largest(channel.octaves.frequencies[i]) / unit;  // of two potentials
    };
    return sum_error(
        channel.octaves, [&](std::size_t i) { return mass * amplitude(i); },
        [&](std::size_t i) {
            return amplitude(i) *
                   (gradient_octave_error(largest(channel.octaves.frequencies[i]), true, moves) +
                    static_cast<double>(channel.octaves.gains.size()) * kFloatRounding * mass);
        });
}

// F2 - F1 has twice the error, 1 - d^2 for d < 1 twice again; values are at most sqrt(3).
inline double cell_error(const config::NoiseChannel& channel, const config::NoiseOctaves& octaves) {
    return sum_error(
        octaves, [](std::size_t) { return std::sqrt(3.0); },
        [&](std::size_t i) {
            const bool both = channel.feature == config::WorleyFeature::f2_minus_f1;
            const bool squared =
                channel.value_form == config::WorleyValue::one_minus_distance_squared;
            return (both ? 2 : 1) * (squared ? 2 : 1) *
                       distance_error(largest(octaves.frequencies[i])) +
                   4 * kFloatRounding * std::sqrt(3.0);
        });
}

// Bumps are at most 1, rise by at most 1.5 per cell and pass six roundings after the distance; their
// difference is one more.
inline double alligator_error(const config::NoiseChannel& channel) {
    return sum_error(
        channel.octaves, [](std::size_t) { return 1.0; },
        [&](std::size_t i) {
            return 2 * (1.5 * distance_error(largest(channel.octaves.frequencies[i])) +
                        6 * kFloatRounding) +
                   kFloatRounding;
        });
}

// The channel before remap, smoothstep, invert, bias and clamp.
inline Uncertain unshaped(config::Noise noise, config::NoiseChannel channel,
                          const std::array<double, 3>& place) {
    using config::NoiseType;
    channel.remap = {0, 1, 0, 1};
    channel.invert = false;
    channel.bias = 0.5;
    channel.smoothstep.reset();
    channel.clamp = config::NoiseChannel().clamp;
    noise.pack = config::NoisePacking::none;
    noise.channels.insert(noise.channels.begin(), channel);  // the others set how fast it changes
    const double value = noise::noise_reference(noise, place)[0];
    switch (channel.type) {
        case NoiseType::constant:
            return cast(channel.value);
        case NoiseType::perlin: {
            const Uncertain sum = {value, gradient_error(channel, noise.period > 0)};
            // 0.5 + 0.5 sum
            if (channel.fractal == config::NoiseFractal::fbm) {
                return Uncertain{value, sum.error / 2}.rounded().rounded();
            }
            return sum;
        }
        case NoiseType::worley:
            return {value, cell_error(channel, channel.octaves)};
        case NoiseType::alligator:
        case NoiseType::curly_alligator:
            return {value, alligator_error(channel)};
        case NoiseType::curl:
            return {value, curl_error(channel, noise.period > 0)};
        case NoiseType::perlin_worley: {
            config::NoiseChannel part = channel;
            part.type = NoiseType::perlin;
            const Uncertain gradient = unshaped(noise, part, place);
            part.type = NoiseType::worley;
            part.octaves = channel.worley_octaves;
            const Uncertain cells = unshaped(noise, part, place);
            return cells + gradient * (exactly(1) - cells);
        }
    }
    return {};
}

// Bounds bring values nearer to each other, never farther apart.
inline Uncertain clamped(Uncertain value, Uncertain low, Uncertain high) {
    return {std::clamp(value.value, low.value, high.value),
            value.error + std::max(low.error, high.error)};
}

inline Uncertain shaped(const config::NoiseChannel& channel, Uncertain value) {
    const auto& [low_in, high_in, low_out, high_out] = channel.remap;
    if (channel.remap != std::array<double, 4>{0, 1, 0, 1}) {
        value = (value - cast(low_in)) * cast((high_out - low_out) / (high_in - low_in)) +
                cast(low_out);
    }
    if (channel.smoothstep) {
        const auto& [from, to] = *channel.smoothstep;
        const Uncertain t =
            clamped((value - cast(from)) * cast(1 / (to - from)), exactly(0), exactly(1));
        value = t * t * (exactly(3) - exactly(2) * t);
    }
    if (channel.invert) value = exactly(1) - value;
    // Beyond [0, 1] bias changes nothing; there it is steep, but continuous.
    const double beyond = std::max(-value.value, value.value - 1);
    if (channel.bias != 0.5 && beyond <= value.error) {
        value = value / ((exactly(1) - value) * cast(1 / channel.bias - 2) + exactly(1));
    }
    if (!std::isfinite(channel.clamp[0])) return value;
    return clamped(value, cast(channel.clamp[0]), cast(channel.clamp[1]));
}

// All output channels at a place.
inline std::vector<Uncertain> uncertain_noise(const config::Noise& noise,
                                              const std::array<double, 3>& place) {
    std::vector<Uncertain> values;
    for (const config::NoiseChannel& channel : noise.channels) {
        values.push_back(shaped(channel, unshaped(noise, channel, place)));
    }
    if (noise.pack == config::NoisePacking::none) return values;
    const auto weighted = [&](std::size_t first) {
        return (values[first] * exactly(0.625) + values[first + 1] * exactly(0.25)) +
               values[first + 2] * exactly(0.125);
    };
    if (noise.pack == config::NoisePacking::detail) return {weighted(0)};
    const Uncertain gap = exactly(1) - weighted(1);
    return {(values[0] + gap) / (gap + exactly(1))};
}

// The largest error of a voxel's channels, as noise_at makes them, against the reference, as a share of
// its bound.
inline double error_share(const config::Noise& noise, const noise::NoisePlan& plan,
                          const noise::Voxel& voxel) {
    const std::vector<Uncertain> wanted = uncertain_noise(noise, place_of(plan.axes, voxel));
    const std::vector<float> found = noise_at(plan, voxel);
    double worst = 0;
    for (std::size_t c = 0; c < found.size(); ++c) {
        worst = std::max(worst, std::fabs(found[c] - wanted[c].value) / wanted[c].error);
    }
    return worst;
}

}  // namespace skybake::test
