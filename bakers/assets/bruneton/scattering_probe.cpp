#include "bakers/assets/bruneton/scattering_probe.h"

#include <algorithm>
#include <cmath>

#include "bakers/air/horizon_margin.h"
#include "bakers/field/texel_axis.h"

namespace skybake {

namespace {

constexpr auto kAtCentres = TexelConvention::end_points_on_texel_centres;

// The coordinate in [0, 1] of a position in texels, whose centres are at whole numbers.
double unit_coordinate_of(double position, int count) {
    return count == 1 ? 0.5 : std::clamp(position / (count - 1), 0.0, 1.0);
}

// Rays to the ground have a length only above it.
constexpr double kLowestEyeKm = 0.01;

ScatteringView off_the_horizon(const Shell& shell, ScatteringView view) {
    if (view.meets_ground) {
        view.altitude_km = std::max(view.altitude_km, kLowestEyeKm);
        view.s_km = std::min(view.s_km, highest_s_of_ground_km(shell, view.altitude_km));
        view.s_km = std::max(view.s_km, -(shell.ground_radius_km + view.altitude_km));
        view.length_km = distance_to_ground_km(shell, view.altitude_km, view.s_km);
    } else {
        view.s_km = std::max(view.s_km, lowest_s_of_sky_km(shell, view.altitude_km));
        view.length_km = distance_to_top_km(shell, view.altitude_km, view.s_km);
    }
    return view;
}

}  // namespace

ScatteringPlace scattering_place(const ScatteringMapping& mapping,
                                 const std::array<double, 3>& uvw) {
    const std::array<int, 3>& size = mapping.size();
    const double across = uvw[1] * size[1] - 0.5;
    const bool ground = uvw[1] < 0.5;
    const int half = mapping.half_size();
    const double x_mu = unit_coordinate_of(ground ? half - 1 - across : across - half, half);
    const double x_r = unit_coordinate_of(uvw[2] * size[2] - 0.5, size[2]);
    // u is the sun's within a sub-image. nu lies as far beyond the sub-image's own as the sun is
    // from a texel's centre: any place between two will do.
    const double image = std::clamp(uvw[0] * mapping.nu_size(), 0.0, mapping.nu_size() - 1e-9);
    const double sun = (image - std::floor(image)) * mapping.sun_size() - 0.5;
    const double between = std::floor(image) + (sun - std::floor(sun));
    ScatteringPlace place;
    place.view = off_the_horizon(mapping.shell(), mapping.view(x_mu, ground, x_r));
    place.sun_cos_zenith = mapping.sun_cos_zenith(unit_coordinate_of(sun, mapping.sun_size()));
    const double r = mapping.shell().ground_radius_km + place.view.altitude_km;
    const FeasibleCosines there_are = feasible_cosines(place.view.s_km / r, place.sun_cos_zenith);
    place.nu = std::clamp(ScatteringMapping::nu(unit_coordinate_of(between, mapping.nu_size())),
                          there_are.low, there_are.high);
    return place;
}

std::vector<ProbeLookup> scattering_lookups(const ScatteringMapping& mapping,
                                            const ScatteringPlace& place) {
    const ScatteringCoordinates x = mapping.coordinates(place.view, place.sun_cos_zenith, place.nu);
    const double half = texture_coordinate(kAtCentres, x.x_mu, mapping.half_size());
    const double v = x.meets_ground ? 0.5 - 0.5 * half : 0.5 + 0.5 * half;
    const double w = texture_coordinate(kAtCentres, x.x_r, mapping.size()[2]);
    const double sun = texture_coordinate(kAtCentres, x.x_mu_s, mapping.sun_size());
    const int images = mapping.nu_size();
    const auto u = [&](double image) { return (image + sun) / images; };
    if (images == 1) return {{{u(0), v, w}}};
    const double position = std::clamp(x.x_nu, 0.0, 1.0) * (images - 1);
    const double first = std::min(std::floor(position), images - 2.0);
    const double share = position - first;
    return {{{u(first), v, w}, 1 - share}, {{u(first + 1), v, w}, share}};
}

ProbePlace scattering_probe_place(const ScatteringMapping& mapping,
                                  const std::array<double, 3>& uvw) {
    const ScatteringPlace place = scattering_place(mapping, uvw);
    const double r = mapping.shell().ground_radius_km + place.view.altitude_km;
    return {{{"altitude_km", place.view.altitude_km},
             {"cos_zenith", place.view.s_km / r},
             {"sun_cos_zenith", place.sun_cos_zenith},
             {"nu", place.nu},
             {"ground", place.view.meets_ground ? 1 : 0}},
            scattering_lookups(mapping, place)};
}

ScatteringPlace scattering_place(const ScatteringMapping& mapping, double altitude_km,
                                 double cos_zenith, double sun_cos_zenith, double nu, bool ground) {
    const Shell& shell = mapping.shell();
    ScatteringView view;
    view.altitude_km = altitude_km;
    view.s_km = (shell.ground_radius_km + altitude_km) * cos_zenith;
    view.meets_ground = ground;
    view.length_km = ground ? distance_to_ground_km(shell, altitude_km, view.s_km)
                            : distance_to_top_km(shell, altitude_km, view.s_km);
    return {view, sun_cos_zenith, nu};
}

}  // namespace skybake
