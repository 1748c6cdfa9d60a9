#include "bakers/render/ground_albedo.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace skybake {

namespace {

constexpr int kNoises = 6;
constexpr double kWidestCell_m = 3000;
constexpr double kNarrowing = 2.75;   // from one noise to the next
constexpr double kAmplitude = 0.125;  // of each noise
constexpr double kGreatest = kNoises * kAmplitude;

// Returns a number in [-1, 1) for a corner of a noise's lattice.
double corner_value(std::int32_t x, std::int32_t y, int noise) {
    std::uint32_t bits = static_cast<std::uint32_t>(x) * 0x9e3779b1U ^
                         static_cast<std::uint32_t>(y) * 0x85ebca77U ^
                         static_cast<std::uint32_t>(noise) * 0xc2b2ae3dU;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6dU;
    bits = (bits ^ bits >> 12) * 0x297a2d39U;
    bits ^= bits >> 15;
    return (bits >> 8) * 0x1p-23 - 1;
}

double smooth(double x) { return x * x * (3 - 2 * x); }

double value_noise(double x, double y, int noise) {
    const double low_x = std::floor(x);
    const double low_y = std::floor(y);
    const auto row = [&](int up) {
        const auto i = static_cast<std::int32_t>(low_x);
        const std::int32_t j = static_cast<std::int32_t>(low_y) + up;
        return std::lerp(corner_value(i, j, noise), corner_value(i + 1, j, noise),
                         smooth(x - low_x));
    };
    return std::lerp(row(0), row(1), smooth(y - low_y));
}

}  // namespace

double ground_mottle(double x_m, double y_m, double footprint_m) {
    double sum = 0;
    double cell_m = kWidestCell_m;
    for (int noise = 0; noise < kNoises; ++noise, cell_m /= kNarrowing) {
        // All of a noise is there whose cells are four footprints wide, nothing at one.
        const double share = smooth(std::clamp((cell_m / footprint_m - 1) / 3, 0.0, 1.0));
        if (share == 0) break;
        sum += share * kAmplitude * value_noise(x_m / cell_m, y_m / cell_m, noise);
        // The next lattice is turned, by angles that are no simple fractions of a turn.
        const double turned = 0.8 * x_m - 0.6 * y_m;
        y_m = 0.6 * x_m + 0.8 * y_m;
        x_m = turned;
    }
    return sum;
}

double ground_mottle_along(const glm::dvec3& eye_m, const glm::dvec3& direction, double pixel) {
    // Beyond this distance not even the widest cells are as wide as a pixel's footprint.
    const double distance_m = eye_m.z / -direction.z;
    if (!(direction.z < 0) || !(distance_m * pixel < kWidestCell_m)) return 0;
    const double footprint_m = std::max(distance_m * pixel / -direction.z, 1e-3);
    return ground_mottle(eye_m.x + distance_m * direction.x, eye_m.y + distance_m * direction.y,
                         footprint_m);
}

Spectrum mottled(const Spectrum& albedo, double mottle) {
    Spectrum share(1.0);
    for (std::size_t c = 0; c < 4; ++c) {
        const double room = albedo[c] > 0 ? (1 / albedo[c] - 1) / kGreatest : 1.0;
        share[c] += std::min(room, 1.0) * mottle;
    }
    return share;
}

}  // namespace skybake
