// The four axes of Bruneton's tables of scattering, as in his implementation of 2017. All end
// points are texel centres.
//
//   x_r     rho / H, the distances to the horizon from here and from the top of the air
//   x_mu    (d - d_min) / (d_max - d_min), d the length of the view ray: to the ground in the lower
//           half of the texels, whose axis runs backwards; to the top in the upper half
//   x_mu_s  (1 - a / A) / (1 + a), a = (D(mu_s) - D(1)) / (D(0) - D(1)), A = a(mu_s_min), D the
//           distance from the ground to the top towards the sun; darker suns are at 0
//   x_nu    (nu + 1) / 2
//
// Texel u is nu_index * sun_size + sun_index: there is one sub-image over suns for each nu. A
// runtime interpolates between two sub-images itself.
//
// Hard cases: the ground (where no ray of the lower half has a length), the top, the horizon from
// both sides (the half decides, not rounding), straight up and down, suns darker than the last.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "bakers/air/ray.h"

namespace skybake {

// A view ray of a texel or of a lookup.
struct ScatteringView {
    double altitude_km = 0;
    double s_km = 0;  // r mu
    double length_km = 0;
    bool meets_ground = false;
};

// Coordinates in [0, 1].
struct ScatteringCoordinates {
    double x_nu = 0;
    double x_mu_s = 0;
    double x_mu = 0;
    bool meets_ground = false;  // the half of the texels to which x_mu belongs
    double x_r = 0;
};

class ScatteringMapping {
  public:
    // `size` holds the numbers of texels along u, v, w. nu_size must divide size[0], and size[1]
    // must be even.
    ScatteringMapping(const Shell& shell, const std::array<int, 3>& size, int nu_size,
                      double sun_cos_zenith_min);

    const Shell& shell() const { return shell_; }
    const std::array<int, 3>& size() const { return size_; }
    int nu_size() const { return nu_size_; }
    double sun_cos_zenith_min() const { return sun_cos_zenith_min_; }
    int sun_size() const { return size_[0] / nu_size_; }
    double largest_share() const { return largest_share_; }  // A
    int half_size() const { return size_[1] / 2; }  // texels along mu on each side of the horizon

    ScatteringView view(double x_mu, bool meets_ground, double x_r) const;
    double sun_cos_zenith(double x_mu_s) const;
    static double nu(double x_nu) { return 2 * x_nu - 1; }

    ScatteringCoordinates coordinates(const ScatteringView& view, double sun_cos_zenith,
                                      double nu) const;

    // The coordinates of texels.
    ScatteringView view_of_texel(int v, int w) const;
    double sun_of_texel(int u) const;
    double nu_of_texel(int u) const;

    // Returns v of the texel that the axis of x_mu counts as half_index, from 0 to half_size - 1,
    // in its half.
    int v_of(int half_index, bool meets_ground) const;

  private:
    double share_of(double distance_km) const;  // a

    Shell shell_;
    std::array<int, 3> size_;
    int nu_size_;
    double sun_cos_zenith_min_;
    double top_distance_km_;  // H
    double largest_share_;    // A
};

// The range of the cosines between view and sun that are possible, given those of both zenith
// angles.
struct FeasibleCosines {
    double low = -1;
    double high = 1;
};
FeasibleCosines feasible_cosines(double view_cos_zenith, double sun_cos_zenith);

// Two neighbouring texels along an axis of `count` texels whose end points are texel centres, with
// the weights of a linear lookup.
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

// Calls visit(u, v, w, weight) for the texels that a runtime blends: linearly in each of the four
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
