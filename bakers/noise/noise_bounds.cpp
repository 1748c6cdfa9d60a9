#include "bakers/noise/noise_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bakers/noise/noise_reference.h"

namespace skybake::noise {
namespace {

using config::WorleyFeature;

using Interval = std::array<double, 2>;

constexpr Interval kEverything = {-std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::infinity()};

// Improved noise is a blend of eight dot products g . d with g = (0, ±1, ±1) or a permutation, each
// at most the sum of the two greater |d_i|. With the best gradient at every corner the blend
// reaches 1.03635 (noise_bounds_test searches the cell).
constexpr double kGradientNoiseBound = 1.0364;
// The same in four dimensions, where g = (0, ±1, ±1, ±1): the blend reaches 1.53659.
constexpr double kMovingNoiseBound = 1.5366;

// The nearest point is no farther than the one of the own cell.
constexpr double kFarthestNearest = std::numbers::sqrt3;
// Nor is the second nearest farther than both that one and the one in the cell beyond the nearest
// face, which is at most half a cell away: sqrt(1.5^2 + 1 + 1).
constexpr double kFarthestSecond = 2.0615528128088303;

template <class Function>
Interval over_corners(const Interval& a, const Interval& b, const Function& function) {
    const std::array<double, 4> values = {function(a[0], b[0]), function(a[0], b[1]),
                                          function(a[1], b[0]), function(a[1], b[1])};
    const auto [least, most] = std::ranges::minmax_element(values);
    return {*least, *most};
}

Interval gradient_bounds(NoiseFractal fractal, bool moves) {
    const double bound = moves ? kMovingNoiseBound : kGradientNoiseBound;
    switch (fractal) {
        case NoiseFractal::fbm:
            return {0.5 - 0.5 * bound, 0.5 + 0.5 * bound};
        case NoiseFractal::ridged:
            return {1 - bound, 1};
        case NoiseFractal::rectified:
        case NoiseFractal::billow:
            break;
    }
    return {0, bound};
}

// A weighted mean of octaves is bounded as each of them is.
Interval cell_bounds(const NoiseChannel& channel) {
    const double farthest =
        channel.feature == WorleyFeature::f1 ? kFarthestNearest : kFarthestSecond;
    const double near = worley_value(channel.value_form, 0);
    const double far = worley_value(channel.value_form, farthest);
    return {std::min(near, far), std::max(near, far)};
}

// Displaced noise has the values of noise that is not.
Interval plain_bounds(const NoiseChannel& channel, bool moves) {
    switch (channel.type) {
        case NoiseType::constant:
            return {channel.value, channel.value};
        case NoiseType::perlin:
            return gradient_bounds(channel.fractal, moves);
        case NoiseType::worley:
            return cell_bounds(channel);
        case NoiseType::perlin_worley:
            return over_corners(gradient_bounds(channel.fractal, moves), cell_bounds(channel),
                                [](double g, double c) { return c + g * (1 - c); });
        case NoiseType::alligator:
        case NoiseType::curly_alligator:
            return {0, 1};  // 1 at a point of height 1 that no other bump reaches
        case NoiseType::curl:
            break;
    }
    return kEverything;
}

Interval in_order(const Interval& bounds) {
    return bounds[0] > bounds[1] ? Interval{bounds[1], bounds[0]} : bounds;
}

Interval remapped_bounds(const NoiseChannel& channel, const Interval& bounds) {
    const auto& [low_in, high_in, low_out, high_out] = channel.remap;
    const double slope = (high_out - low_out) / (high_in - low_in);
    if (!std::isfinite(bounds[1])) return kEverything;
    return in_order(
        {low_out + (bounds[0] - low_in) * slope, low_out + (bounds[1] - low_in) * slope});
}

double smooth_step(const std::array<double, 2>& edges, double value) {
    const double t = std::clamp((value - edges[0]) / (edges[1] - edges[0]), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// A step may be so steep that it makes much of what kernels are off by, which is 2e-7 of their
// values before the remap: the step is taken of an interval that has room for it.
Interval stepped_bounds(const NoiseChannel& channel, const Interval& bounds) {
    constexpr double kRoom = 1e-6;
    const double low_in = channel.remap[0];
    const double high_in = channel.remap[1];
    const std::array<double, 2>& edges = *channel.smoothstep;
    const double slope = std::fabs((channel.remap[3] - channel.remap[2]) / (high_in - low_in));
    const auto room = [&](double value) {
        const double largest = std::max({1.0, std::fabs(low_in), std::fabs(high_in)});
        return kRoom * (slope * largest + std::max({1.0, std::fabs(value), std::fabs(edges[0])}));
    };
    return {smooth_step(edges, bounds[0] - room(bounds[0])),
            smooth_step(edges, bounds[1] + room(bounds[1]))};
}

// Returns what invert, bias and clamp make of a bound.
double finished(const NoiseChannel& channel, double bound) {
    if (channel.invert) bound = 1 - bound;
    // Bias leaves 0, 1 and what is beyond where it is, and is monotonic.
    if (bound > 0 && bound < 1) bound /= (1 / channel.bias - 2) * (1 - bound) + 1;
    return std::clamp(bound, channel.clamp[0], channel.clamp[1]);
}

Interval channel_bounds(const NoiseChannel& channel, bool moves) {
    Interval bounds = remapped_bounds(channel, plain_bounds(channel, moves));
    if (channel.smoothstep) bounds = stepped_bounds(channel, bounds);
    return in_order({finished(channel, bounds[0]), finished(channel, bounds[1])});
}

Interval weighted(const Interval& a, const Interval& b, const Interval& c) {
    return {0.625 * a[0] + 0.25 * b[0] + 0.125 * c[0], 0.625 * a[1] + 0.25 * b[1] + 0.125 * c[1]};
}

}  // namespace

std::array<double, 2> value_bounds(const Noise& noise, std::size_t channel) {
    std::array<Interval, 4> channels{};
    for (std::size_t i = 0; i < noise.channels.size(); ++i) {
        channels[i] = channel_bounds(noise.channels[i], noise.period > 0);
    }
    switch (noise.pack) {
        case NoisePacking::none:
            return channels[channel];
        case NoisePacking::detail:
            return weighted(channels[0], channels[1], channels[2]);
        case NoisePacking::shape:
            break;
    }
    // (r + 1 - w) / (2 - w) is monotonic in r and in w while w < 2.
    const Interval w = weighted(channels[1], channels[2], channels[3]);
    if (!(w[1] < 2) || !std::isfinite(channels[0][1])) return kEverything;
    return over_corners(channels[0], w, [](double r, double v) { return (r + 1 - v) / (2 - v); });
}

std::array<double, 2> nominal_range(const NoiseChannel& channel) {
    Interval range = {0, 1};
    if (channel.type == NoiseType::curl) range = {-1, 1};
    if (channel.type == NoiseType::constant)
        range = {std::min(0.0, channel.value), std::max(1.0, channel.value)};
    const auto& [low_in, high_in, low_out, high_out] = channel.remap;
    for (double& bound : range) {
        bound = low_out + (bound - low_in) * (high_out - low_out) / (high_in - low_in);
        if (channel.smoothstep) bound = smooth_step(*channel.smoothstep, bound);
        bound = finished(channel, bound);
    }
    range = in_order(range);
    // One value alone: a range about it.
    if (range[0] == range[1]) range = {range[0] - 0.5, range[1] + 0.5};
    return range;
}

}  // namespace skybake::noise
