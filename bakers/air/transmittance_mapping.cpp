#include "bakers/air/transmittance_mapping.h"

#include <algorithm>
#include <cmath>

namespace skybake {

TransmittanceRay transmittance_ray(const Shell& shell, UnitCoordinates x) {
    const double top_distance = horizon_distance_km(shell, shell.thickness_km);  // H
    const double rho = x.x_r * top_distance;
    // r - R = rho^2 / (r + R); at the ends the altitude is exactly 0 and the thickness.
    const double r = std::sqrt(shell.ground_radius_km * shell.ground_radius_km + rho * rho);
    const double altitude =
        x.x_r >= 1 ? shell.thickness_km
                   : std::min(rho * rho / (r + shell.ground_radius_km), shell.thickness_km);
    const double d_min = shell.thickness_km - altitude;
    const double d_max = rho + top_distance;
    const double d = d_min + x.x_mu * (d_max - d_min);
    if (d <= 0) return {altitude, r};
    // From d^2 + 2 d s = R_top^2 - r^2 = d_min (d_min + 2 r).
    const double s = 0.5 * (d_min * (d_min + 2 * r) / d - d);
    return {altitude, std::clamp(s, -rho, r)};
}

UnitCoordinates transmittance_coordinates(const Shell& shell, double altitude_km,
                                          double cos_zenith) {
    const double top_distance = horizon_distance_km(shell, shell.thickness_km);
    const double rho = horizon_distance_km(shell, altitude_km);
    const double s = (shell.ground_radius_km + altitude_km) * cos_zenith;
    const double d_min = shell.thickness_km - altitude_km;
    const double d = distance_to_top_km(shell, altitude_km, s);
    return {(d - d_min) / (rho + top_distance - d_min), rho / top_distance};
}

UnitCoordinates off_the_horizon(const Shell& shell, UnitCoordinates x) {
    const TransmittanceRay ray = transmittance_ray(shell, x);
    const double lowest_s = lowest_s_of_sky_km(shell, ray.altitude_km);
    if (ray.s_km >= lowest_s) return x;
    const double r = shell.ground_radius_km + ray.altitude_km;
    return transmittance_coordinates(shell, ray.altitude_km, lowest_s / r);
}

double cos_zenith_of(const Shell& shell, const TransmittanceRay& ray) {
    return ray.s_km / (shell.ground_radius_km + ray.altitude_km);
}

}  // namespace skybake
