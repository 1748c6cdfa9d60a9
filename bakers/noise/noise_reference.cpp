#include "bakers/noise/noise_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "bakers/math/vectors.h"
#include "bakers/noise/lattice_hash.h"

namespace skybake::noise {

namespace {

using config::NoiseChannel;
using config::NoiseFractal;
using config::NoiseOctaves;
using config::NoiseType;
using config::WorleyFeature;
using config::WorleyValue;

using Frequency = std::array<int, 3>;

// One octave's lattice: hashed, with its period.
struct Lattice {
    Frequency period{};
    std::uint64_t key = 0;

    glm::dvec3 periods() const { return {period[0], period[1], period[2]}; }
    std::uint32_t wrap(double cell, std::size_t axis) const {
        const double p = period[axis];
        return static_cast<std::uint32_t>(cell - std::floor(cell / p) * p);
    }
    Gradient gradient(double x, double y, double z) const {
        return lattice_gradient(row_key(key, wrap(y, 1), wrap(z, 2)), wrap(x, 0));
    }
    CellPoint point(double x, double y, double z) const {
        return cell_point(row_key(key, wrap(y, 1), wrap(z, 2)), wrap(x, 0));
    }
};

// What tells an octave's lattice from the others of its sum.
struct OctaveName {
    Frequency frequency{};
    int repetition = 0;
};

Lattice lattice_of(const config::Noise& noise, const NoiseChannel& channel, Purpose purpose,
                   const OctaveName& octave) {
    return {octave.frequency,
            octave_key(noise.seed, channel.seed, purpose, octave.frequency, octave.repetition)};
}

double quintic(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double fade_slope(double t) { return 30 * t * t * (t - 1) * (t - 1); }
double lerp(double a, double b, double t) { return a + t * (b - a); }

// A number with its derivatives along x, y and z.
struct Dual {
    double value = 0;
    glm::dvec3 slope{};
};

// The value and its gradient per cell: Perlin 2002, with the chain rule written out.
Dual improved_noise(const Lattice& lattice, const glm::dvec3& place) {
    const glm::dvec3 position = place * lattice.periods();
    const glm::dvec3 cell = glm::floor(position);
    const glm::dvec3 t = position - cell;
    const glm::dvec3 w = {quintic(t.x), quintic(t.y), quintic(t.z)};
    double value[2][2][2];
    double slope[3][2][2][2];
    for (int k = 0; k < 2; ++k) {
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) {
                const Gradient g = lattice.gradient(cell[0] + i, cell[1] + j, cell[2] + k);
                value[k][j][i] = g.x * (t[0] - i) + g.y * (t[1] - j) + g.z * (t[2] - k);
                slope[0][k][j][i] = g.x;
                slope[1][k][j][i] = g.y;
                slope[2][k][j][i] = g.z;
            }
        }
    }
    const auto blended = [&](const double(&corner)[2][2][2]) {
        const double near = lerp(lerp(corner[0][0][0], corner[0][0][1], w[0]),
                                 lerp(corner[0][1][0], corner[0][1][1], w[0]), w[1]);
        const double far = lerp(lerp(corner[1][0][0], corner[1][0][1], w[0]),
                                lerp(corner[1][1][0], corner[1][1][1], w[0]), w[1]);
        return lerp(near, far, w[2]);
    };
    Dual result;
    result.value = blended(value);
    // d/dx sum(n_i W_i) = sum(dn_i/dx W_i) + sum(n_i dW_i/dx): the second part is a blend of
    // differences across the axis.
    double across[3] = {0, 0, 0};
    for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
            const double wy = a != 0 ? w[1] : 1 - w[1];
            const double wz = b != 0 ? w[2] : 1 - w[2];
            const double wx = a != 0 ? w[0] : 1 - w[0];
            const double wy_second = b != 0 ? w[1] : 1 - w[1];
            across[0] += (value[b][a][1] - value[b][a][0]) * wy * wz;
            across[1] += (value[b][1][a] - value[b][0][a]) * wx * wz;
            across[2] += (value[1][b][a] - value[0][b][a]) * wx * wy_second;
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        result.slope[i] = blended(slope[i]) + across[i] * fade_slope(t[i]);
    }
    return result;
}

// Distances to the nearest and second nearest of the points of 125 cells.
std::array<double, 2> nearest_points(const Lattice& lattice, const glm::dvec3& place) {
    const glm::dvec3 position = place * lattice.periods();
    const glm::dvec3 cell = glm::floor(position);
    std::array<double, 2> nearest = {std::numeric_limits<double>::infinity(),
                                     std::numeric_limits<double>::infinity()};
    for (int k = -2; k <= 2; ++k) {
        for (int j = -2; j <= 2; ++j) {
            for (int i = -2; i <= 2; ++i) {
                const CellPoint point = lattice.point(cell[0] + i, cell[1] + j, cell[2] + k);
                const double distance = std::hypot(cell[0] + i + point.x - position[0],
                                                   cell[1] + j + point.y - position[1],
                                                   cell[2] + k + point.z - position[2]);
                if (distance < nearest[0]) {
                    nearest = {distance, nearest[0]};
                } else {
                    nearest[1] = std::min(nearest[1], distance);
                }
            }
        }
    }
    return nearest;
}

double worley(const NoiseChannel& channel, const Lattice& lattice, const glm::dvec3& place) {
    const auto [first, second] = nearest_points(lattice, place);
    double distance = first;
    if (channel.feature == WorleyFeature::f2) distance = second;
    if (channel.feature == WorleyFeature::f2_minus_f1) distance = second - first;
    switch (channel.value_form) {
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

double gradient_part(const config::Noise& noise, const NoiseChannel& channel,
                     const glm::dvec3& place) {
    const double sum = weighted_mean(channel.octaves, [&](const OctaveName& octave) {
        const double n =
            improved_noise(lattice_of(noise, channel, Purpose::gradient, octave), place).value;
        if (channel.fractal == NoiseFractal::ridged) return 1 - std::fabs(n);
        return channel.fractal == NoiseFractal::billow ? std::fabs(n) : n;
    });
    if (channel.fractal == NoiseFractal::fbm) return 0.5 + 0.5 * sum;
    return channel.fractal == NoiseFractal::rectified ? std::max(0.0, sum) : sum;
}

double cell_part(const config::Noise& noise, const NoiseChannel& channel,
                 const NoiseOctaves& octaves, const glm::dvec3& place) {
    return weighted_mean(octaves, [&](const OctaveName& octave) {
        return worley(channel, lattice_of(noise, channel, Purpose::cells, octave), place);
    });
}

// A component of the curl, per tile, over the greatest frequency of the first octave.
double curl_part(const config::Noise& noise, const NoiseChannel& channel, const glm::dvec3& place) {
    constexpr Purpose kPotentials[] = {Purpose::potential_x, Purpose::potential_y,
                                       Purpose::potential_z};
    const auto axis = static_cast<std::size_t>(channel.component);
    const std::size_t next = (axis + 1) % 3;
    const std::size_t last = (axis + 2) % 3;
    const double sum = weighted_mean(channel.octaves, [&](const OctaveName& octave) {
        const auto slope = [&](std::size_t potential, std::size_t along) {
            const Lattice lattice = lattice_of(noise, channel, kPotentials[potential], octave);
            return improved_noise(lattice, place).slope[along] * octave.frequency[along];
        };
        return slope(last, next) - slope(next, last);
    });
    const Frequency& first = channel.octaves.frequencies.front();
    return sum / *std::max_element(first.begin(), first.end());
}

double value_of(const config::Noise& noise, const NoiseChannel& channel, const glm::dvec3& place) {
    switch (channel.type) {
        case NoiseType::constant:
            return channel.value;
        case NoiseType::perlin:
            return gradient_part(noise, channel, place);
        case NoiseType::worley:
            return cell_part(noise, channel, channel.octaves, place);
        case NoiseType::curl:
            return curl_part(noise, channel, place);
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

std::vector<double> noise_reference(const config::Noise& noise,
                                    const std::array<double, 3>& place) {
    const auto& [x, y, z] = place;
    std::vector<double> values;
    for (const NoiseChannel& channel : noise.channels) {
        values.push_back(shaped(channel, value_of(noise, channel, {x, y, z})));
    }
    if (noise.pack == config::NoisePacking::none) return values;
    if (noise.pack == config::NoisePacking::detail) {
        return {0.625 * values[0] + 0.25 * values[1] + 0.125 * values[2]};
    }
    const double low = 0.625 * values[1] + 0.25 * values[2] + 0.125 * values[3] - 1;
    return {(values[0] - low) / (1 - low)};
}

}  // namespace skybake::noise
