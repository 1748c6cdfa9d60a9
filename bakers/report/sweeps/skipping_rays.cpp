#include "bakers/report/sweeps/skipping_rays.h"

#include <algorithm>
#include <cmath>

#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

using occupancy::Ray;
using Member = std::array<double, 5>;

// fraction(1/2 + n / g^i), g the real root of g^6 = g + 1 (M. Roberts, "The unreasonable
// effectiveness of quasirandom sequences", 2018).
Member member(int n) {
    constexpr double kRoot = 1.1347241384015194;
    Member values;
    double power = 1;
    for (double& value : values) {
        power *= kRoot;
        const double sum = 0.5 + n / power;
        value = sum - std::floor(sum);
    }
    return values;
}

std::array<double, 3> direction(double cosine, double turn) {
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    return {sine * cosine_of_turns(turn), sine * cosine_of_turns(turn - 0.25), cosine};
}

// Uniform from cos 60 deg to 1.
double steep_cosine(double share) {
    constexpr double kLeast = 0.5;
    return kLeast + (1 - kLeast) * share;
}

}  // namespace

std::array<RaySet, 3> skipping_rays(const std::array<double, 3>& extent, int count) {
    constexpr double kLayer = 0.25;
    std::array<RaySet, 3> sets = {{{"up", {}}, {"within", {}}, {"down", {}}}};
    for (int n = 1; n <= count; ++n) {
        const auto [x, y, cosine, turn, z] = member(n);
        const std::array<double, 3> base = {x * extent[0], y * extent[1], 0};
        std::array<double, 3> layer = base;
        layer[2] = z * kLayer * extent[2];
        std::array<double, 3> top = base;
        top[2] = extent[2];
        const double steep = steep_cosine(cosine);
        sets[0].rays.push_back({base, direction(steep, turn)});
        sets[1].rays.push_back({layer, direction(2 * cosine - 1, turn)});
        sets[2].rays.push_back({top, direction(-steep, turn)});
    }
    return sets;
}

}  // namespace skybake
