#include "bakers/assets/bruneton/scattering_mapping.h"

#include <cassert>
#include <cmath>

#include "bakers/air/transmittance_mapping.h"
#include "bakers/field/image.h"

namespace skybake {
namespace {

constexpr auto kScatteringTexels = TexelConvention::end_points_on_texel_centres;

}  // namespace

ScatteringMapping::ScatteringMapping(const Shell& shell, const std::array<int, 3>& size,
                                     int nu_size, double sun_cos_zenith_min)
    : shell_(shell),
      size_(size),
      nu_size_(nu_size),
      sun_cos_zenith_min_(sun_cos_zenith_min),
      top_distance_km_(horizon_distance_km(shell, shell.thickness_km)),
      largest_share_(
          share_of(distance_to_top_km(shell, 0, shell.ground_radius_km * sun_cos_zenith_min))) {
    assert(nu_size >= 1 && size[0] % nu_size == 0 && size[1] % 2 == 0);
}

double ScatteringMapping::share_of(double distance_km) const {
    return (distance_km - shell_.thickness_km) / (top_distance_km_ - shell_.thickness_km);
}

ScatteringView ScatteringMapping::view(double x_mu, bool meets_ground, double x_r) const {
    ScatteringView view;
    view.meets_ground = meets_ground;
    if (!meets_ground) {
        const TransmittanceRay ray = transmittance_ray(shell_, {x_mu, x_r});
        view.altitude_km = ray.altitude_km;
        view.s_km = ray.s_km;
        view.length_km = distance_to_top_km(shell_, ray.altitude_km, ray.s_km);
        return view;
    }
    view.altitude_km = transmittance_ray(shell_, {1, x_r}).altitude_km;
    const double rho = horizon_distance_km(shell_, view.altitude_km);
    const double r = shell_.ground_radius_km + view.altitude_km;
    view.length_km = view.altitude_km + x_mu * (rho - view.altitude_km);
    // From d^2 + 2 d s = R^2 - r^2; a ray of no length looks straight down.
    view.s_km = view.length_km > 0
                    ? std::clamp(-0.5 * (rho * (rho / view.length_km) + view.length_km), -r, -rho)
                    : -r;
    return view;
}

double ScatteringMapping::sun_cos_zenith(double x_mu_s) const {
    if (x_mu_s <= 0) return sun_cos_zenith_min_;
    if (x_mu_s >= 1) return 1;
    const double a = largest_share_ * (1 - x_mu_s) / (1 + x_mu_s * largest_share_);
    const double d = shell_.thickness_km + a * (top_distance_km_ - shell_.thickness_km);
    const double h = top_distance_km_;
    return std::clamp((h - d) * (h + d) / (2 * shell_.ground_radius_km * d), sun_cos_zenith_min_,
                      1.0);
}

ScatteringCoordinates ScatteringMapping::coordinates(const ScatteringView& view,
                                                     double sun_cos_zenith, double nu) const {
    ScatteringCoordinates x;
    x.meets_ground = view.meets_ground;
    const double rho = horizon_distance_km(shell_, view.altitude_km);
    x.x_r = rho / top_distance_km_;
    if (view.meets_ground) {
        const double range = rho - view.altitude_km;
        x.x_mu =
            range > 0 ? std::clamp((view.length_km - view.altitude_km) / range, 0.0, 1.0) : 0.0;
    } else {
        const double shortest = shell_.thickness_km - view.altitude_km;
        x.x_mu =
            std::clamp((view.length_km - shortest) / (rho + top_distance_km_ - shortest), 0.0, 1.0);
    }
    const double a =
        share_of(distance_to_top_km(shell_, 0, shell_.ground_radius_km * sun_cos_zenith));
    x.x_mu_s = std::max(1 - a / largest_share_, 0.0) / (1 + a);
    x.x_nu = 0.5 * (nu + 1);
    return x;
}

int ScatteringMapping::v_of(int half_index, bool meets_ground) const {
    return meets_ground ? half_size() - 1 - half_index : half_size() + half_index;
}

ScatteringView ScatteringMapping::view_of_texel(int v, int w) const {
    const bool meets_ground = v < half_size();
    const int index = meets_ground ? half_size() - 1 - v : v - half_size();
    return view(texel_coordinate(kScatteringTexels, index, half_size()), meets_ground,
                texel_coordinate(kScatteringTexels, w, size_[2]));
}

double ScatteringMapping::sun_of_texel(int u) const {
    return sun_cos_zenith(texel_coordinate(kScatteringTexels, u % sun_size(), sun_size()));
}

double ScatteringMapping::nu_of_texel(int u) const {
    return nu(texel_coordinate(kScatteringTexels, u / sun_size(), nu_size_));
}

FeasibleCosines feasible_cosines(double view_cos_zenith, double sun_cos_zenith) {
    const double product = view_cos_zenith * sun_cos_zenith;
    const double sines = std::sqrt((1 - view_cos_zenith) * (1 + view_cos_zenith) *
                                   (1 - sun_cos_zenith) * (1 + sun_cos_zenith));
    return {product - sines, product + sines};
}

}  // namespace skybake
