// Perlin's "Improving Noise" of 2002 as in its appendix, and the curl of three such noises.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "bakers/noise/lattice_hash.h"

namespace skybake::test {

using Place = std::array<double, 3>;

inline double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
inline double lerp(double t, double a, double b) { return a + t * (b - a); }

// The appendix' twelve directions to the middles of a cube's edges, by the low bits of a hash.
inline double grad(int hash, double x, double y, double z) {
    const int h = hash & 15;
    const double u = h < 8 ? x : y;
    const double v = h < 4 ? y : h == 12 || h == 14 ? x : z;
    return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
}

// Returns which of grad's sixteen directions is this lattice point's gradient.
inline int direction_of(const noise::Gradient& gradient) {
    for (int h = 0; h < 12; ++h) {
        if (grad(h, 1, 0, 0) == gradient.x && grad(h, 0, 1, 0) == gradient.y &&
            grad(h, 0, 0, 1) == gradient.z) {
            return h;
        }
    }
    ADD_FAILURE() << "no edge: " << gradient.x << ' ' << gradient.y << ' ' << gradient.z;
    return 0;
}

inline double perlin_2002(std::uint64_t key, const std::array<int, 3>& period, const Place& place) {
    const double px = place[0] * period[0];
    const double py = place[1] * period[1];
    const double pz = place[2] * period[2];
    const auto X = static_cast<std::int64_t>(std::floor(px));
    const auto Y = static_cast<std::int64_t>(std::floor(py));
    const auto Z = static_cast<std::int64_t>(std::floor(pz));
    const double x = px - std::floor(px);
    const double y = py - std::floor(py);
    const double z = pz - std::floor(pz);
    const double u = fade(x);
    const double v = fade(y);
    const double w = fade(z);
    const auto hash = [&](int i, int j, int k) {
        const auto wrap = [](std::int64_t cell, int p) {
            return static_cast<std::uint32_t>(((cell % p) + p) % p);
        };
        return direction_of(
            lattice_gradient(noise::row_key(key, wrap(Y + j, period[1]), wrap(Z + k, period[2])),
                             wrap(X + i, period[0])));
    };
    return lerp(
        w,
        lerp(v, lerp(u, grad(hash(0, 0, 0), x, y, z), grad(hash(1, 0, 0), x - 1, y, z)),
             lerp(u, grad(hash(0, 1, 0), x, y - 1, z), grad(hash(1, 1, 0), x - 1, y - 1, z))),
        lerp(v, lerp(u, grad(hash(0, 0, 1), x, y, z - 1), grad(hash(1, 0, 1), x - 1, y, z - 1)),
             lerp(u, grad(hash(0, 1, 1), x, y - 1, z - 1),
                  grad(hash(1, 1, 1), x - 1, y - 1, z - 1))));
}

// The curl of the potentials of these purposes, of one octave of seed 7, by fourth-order differences:
// per tile and over the greatest frequency.
inline Place curl_of_perlin_2002(const std::array<noise::Purpose, 3>& potentials,
                                 const std::array<int, 3>& frequency, const Place& place) {
    const auto slope = [&](std::size_t i, std::size_t along) {
        constexpr double kStep = 1e-5;
        const std::uint64_t key = noise::octave_key(7, 0, potentials[i], frequency);
        const auto at = [&](int steps) {
            Place moved = place;
            moved[along] += steps * kStep;
            return perlin_2002(key, frequency, moved);
        };
        return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * kStep);
    };
    Place curl;
    const double unit = *std::max_element(frequency.begin(), frequency.end());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t next = (axis + 1) % 3;
        const std::size_t last = (axis + 2) % 3;
        curl[axis] = (slope(last, next) - slope(next, last)) / unit;
    }
    return curl;
}

}  // namespace skybake::test
