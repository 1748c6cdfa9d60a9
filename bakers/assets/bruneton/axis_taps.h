// Linear lookups along axes with end points on texel centres.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "bakers/assets/bruneton/scattering_mapping.h"

namespace skybake {

// Two neighbours along an axis of `count` texels.
struct AxisTaps {
    std::array<int, 2> texel{};
    std::array<double, 2> weight{1, 0};
};

inline AxisTaps axis_taps(double x, int count) {
    if (count == 1) return {};
    const double position = std::clamp(x, 0.0, 1.0) * (count - 1);
    const int first = std::min(static_cast<int>(position), count - 2);
    return {{first, first + 1}, {1 - (position - first), position - first}};
}

// Calls visit(u, v, w, weight) for the texels that a runtime blends: linear in each of the four
// coordinates, within one half of the view's axis.
template <class Visit>
void for_each_tap(const ScatteringMapping& mapping, const ScatteringCoordinates& x,
                  const Visit& visit) {
    const AxisTaps nu = axis_taps(x.x_nu, mapping.nu_size());
    const AxisTaps sun = axis_taps(x.x_mu_s, mapping.sun_size());
    const AxisTaps view = axis_taps(x.x_mu, mapping.half_size());
    const AxisTaps altitude = axis_taps(x.x_r, mapping.size()[2]);
    for (std::size_t tap = 0; tap < 16; ++tap) {
        const std::size_t a = tap & 1, b = tap >> 1 & 1, c = tap >> 2 & 1, d = tap >> 3;
        const double weight = nu.weight[a] * sun.weight[b] * view.weight[c] * altitude.weight[d];
        if (weight == 0) continue;
        visit(nu.texel[a] * mapping.sun_size() + sun.texel[b],
              mapping.v_of(view.texel[c], x.meets_ground), altitude.texel[d], weight);
    }
}

}  // namespace skybake
