#include "bakers/assets/multiple_scattering/fit_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/light/camera_ray.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/gauss_legendre.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

SunZenith sun_of(double cosine) { return {cosine, std::sqrt((1 - cosine) * (1 + cosine))}; }

std::vector<SunZenith> suns_of(const SunAxis& axis, const FitScene& scene, int suns_per_column) {
    // Darker suns than the axis' last bring that one's light.
    const double lowest = std::max(cosine_of(scene.largest_sun_zenith), axis.darkest);
    const double highest = std::max(cosine_of(scene.smallest_sun_zenith), lowest);
    std::vector<SunZenith> suns = {sun_of(lowest)};
    for (std::size_t i = 0; i + 1 < axis.cosines.size(); ++i) {
        for (int k = 0; k < suns_per_column; ++k) {
            const double share = static_cast<double>(k) / suns_per_column;
            const double cosine = (1 - share) * axis.cosines[i] + share * axis.cosines[i + 1];
            if (cosine > lowest && cosine < highest) suns.push_back(sun_of(cosine));
        }
    }
    if (highest > lowest) suns.push_back(sun_of(highest));
    return suns;
}

// mu = from + (to - from) x^2: Gauss' nodes in x, d mu = 2 x dx.
void add_views(int camera, double from, double to, int count, bool meets_ground,
               std::vector<FitView>& views) {
    const QuadratureRule rule = gauss_legendre(count);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double x = rule.nodes[i];
        const double mu = from + (to - from) * x * x;
        views.push_back(
            {camera, mu, std::sqrt((1 - mu) * (1 + mu)), meets_ground, 2 * x * rule.weights[i]});
    }
}

}  // namespace

SkyRay FitSample::ray(const Shell& shell, const FitView& view, std::size_t index) const {
    const SunZenith& sun = suns[index / azimuth_cosines.size()];
    const SkyDirection direction =
        sky_direction(sun, view.mu, view.sine, azimuth_cosines[index % azimuth_cosines.size()]);
    const double altitude_km = cameras_km[static_cast<std::size_t>(view.camera)];
    return camera_ray(shell, altitude_km, sun, direction).in_air;
}

FitSample sample_scene(const Shell& shell, const SunAxis& axis, const FitScene& scene,
                       const FitDensity& density) {
    FitSample sample;
    sample.suns = suns_of(axis, scene, density.suns_per_column);
    for (int i = 0; i < density.azimuths; ++i) {
        sample.azimuth_cosines.push_back(cosine_of_pi((i + 0.5) / density.azimuths));
    }
    const double range_km = scene.highest_camera_km - scene.lowest_camera_km;
    const int cameras = range_km > 0 ? density.cameras : 1;
    for (int i = 0; i < cameras; ++i) {
        const double x = cameras > 1 ? static_cast<double>(i) / (cameras - 1) : 0;
        const double altitude_km = scene.lowest_camera_km + range_km * x * x;
        const double r = shell.ground_radius_km + altitude_km;
        const double horizon = -horizon_distance_km(shell, altitude_km) / r;
        // From space the sky ends where rays graze the top of the air.
        const double above_top_km = altitude_km - shell.thickness_km;
        const double top = shell.ground_radius_km + shell.thickness_km;
        const double edge =
            above_top_km > 0 ? -std::sqrt(above_top_km * (2 * top + above_top_km)) / r : 1;
        sample.cameras_km.push_back(altitude_km);
        add_views(i, horizon, edge, density.sky_views, false, sample.views);
        if (altitude_km > 0) {
            add_views(i, horizon, -1, density.ground_views, true, sample.views);
        }
    }
    return sample;
}

}  // namespace skybake
