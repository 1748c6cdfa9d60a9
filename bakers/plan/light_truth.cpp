#include "bakers/plan/light_truth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/assets/sky/sky_lights.h"
#include "bakers/light/sky_view_mapping.h"
#include "config/sweep/sobol.h"
#include "config/text/mapped.h"

namespace skybake {

using config::Draws;

namespace {

// Cameras at the top itself see no air above them.
constexpr double kHighestShare = 0.99;

double between(double low, double high, double share) { return low + share * (high - low); }

TraceOfPlace trace_of(Draws light, const std::shared_ptr<const TracedAir>& air,
                      const std::vector<LightView>& views) {
    std::vector<SkySample> skies;
    std::vector<AirSample> things;
    std::vector<LevelSample> surfaces;
    for (const auto& [sky, distance_km] : views) {
        skies.push_back(sky);
        things.push_back({sky.altitude_km, sky.sun, sky.direction, distance_km});
        surfaces.push_back({sky.altitude_km, sky.sun_elevation_deg, sky.sun});
    }
    switch (light) {
        case Draws::distance:
            return trace_of_air(air, std::move(things), config::SkyOrders::all);
        case Draws::ground_light:
            return trace_of_daylight(air, surfaces);
        default:
            return trace_of_sky(air, std::move(skies), config::SkyOrders::all,
                                light == Draws::surroundings);
    }
}

std::vector<std::shared_ptr<const TracedAir>> packets_of(const Parameters& parameters) {
    return mapped<std::shared_ptr<const TracedAir>>(
        light_packets(parameters), [&](const config::Atmosphere& packet) {
            return std::make_shared<const TracedAir>(packet);
        });
}

TracedLight light_of(Draws what, const Parameters& parameters,
                     const std::vector<std::shared_ptr<const TracedAir>>& packets,
                     const std::vector<LightView>& views) {
    TracedLight light;
    light.channels = light_channels(parameters);
    const auto skies = mapped<SkySample>(views, &LightView::sky);
    light.places = places_of(skies);
    for (const auto& air : packets) light.traced.push_back(trace_of(what, air, views));
    return light;
}

}  // namespace

SceneRange range_of(const config::Scene& scene, const Shell& shell) {
    SceneRange range;
    const double highest_km = kHighestShare * shell.thickness_km;
    range.lowest_altitude_km = std::min(scene.altitude[0].kilometers(), highest_km);
    range.highest_altitude_km = std::min(scene.altitude[1].kilometers(), highest_km);
    for (const config::Angle& sun : scene.suns) {
        range.suns_deg.push_back(sun.radians * kDegreesPerRadian);
    }
    range.view_distance_km = scene.view_distance.kilometers();
    range.lowest_sun_deg = scene.sun_elevation[0].radians * kDegreesPerRadian;
    range.highest_sun_deg = scene.sun_elevation[1].radians * kDegreesPerRadian;
    if (range.highest_sun_deg > kLowestSun_deg) {
        range.lowest_sun_deg = std::max(range.lowest_sun_deg, kLowestSun_deg);
    }
    return range;
}

double elevation_deg(const Shell& shell, const SkySample& view) {
    return view.above_horizon_deg -
           SkyViewCamera(shell, view.altitude_km).dip() * kDegreesPerRadian;
}

LightView light_view(const SceneRange& range, const Shell& shell, double altitude_km,
                     double sun_deg, double elevation_deg, double azimuth_deg, double share) {
    const double dip_deg = SkyViewCamera(shell, altitude_km).dip() * kDegreesPerRadian;
    LightView view;
    view.sky = sky_sample(shell, altitude_km, sun_deg, elevation_deg + dip_deg, azimuth_deg);
    const SkyRay ray = sky_ray(shell, altitude_km, view.sky.sun, view.sky.direction);
    view.distance_km = share * std::min(range.view_distance_km, ray.length_km);
    return view;
}

std::vector<LightView> scene_views(Draws light, const SceneRange& range, const Shell& shell,
                                   int count, std::uint32_t first) {
    std::vector<LightView> views;
    for (std::uint32_t i = first; i < first + static_cast<std::uint32_t>(count); ++i) {
        const auto share = [i](int dimension) { return config::sobol_coordinate(i, dimension); };
        const double sun_deg = range.suns_deg.empty()
                                   ? between(range.lowest_sun_deg, range.highest_sun_deg, share(0))
                                   : range.suns_deg[static_cast<std::size_t>(
                                         share(0) * static_cast<double>(range.suns_deg.size()))];
        const double altitude_km =
            between(range.lowest_altitude_km, range.highest_altitude_km, share(1));
        const SkyViewCamera camera(shell, altitude_km);
        double elevation_deg = between(-camera.dip() * kDegreesPerRadian, 90, share(2));
        if (light == Draws::distance)
            elevation_deg = between(-kMostTilt_deg, kMostTilt_deg, share(2));
        if (light == Draws::surroundings) {
            elevation_deg = std::asin(between(-1, 1, share(2))) * kDegreesPerRadian;
        }
        views.push_back(light_view(range, shell, altitude_km, sun_deg, elevation_deg,
                                   180 * share(3), share(4)));
    }
    return views;
}

SceneTruth::SceneTruth(Draws light, const Parameters& parameters, std::vector<LightView> views,
                       std::vector<glm::dvec3> weights, BakeOptions options)
    : what_(light),
      views_(std::move(views)),
      options_(options),
      packets_(packets_of(parameters)),
      weights_(std::move(weights)),
      light_(light_of(what_, parameters, packets_, views_)),
      comparison_(light_, weights_, options_),
      whole_light_(light_of(Draws::surroundings, parameters, packets_, views_)),
      whole_(whole_light_, weights_, options_) {}

void SceneTruth::trace(double most_paths) {
    if (what_ != Draws::distance) return comparison_.trace(most_paths);
    comparison_.trace(most_paths / 2);
    if (!options_.cancelled()) whole_.trace(most_paths / 2);
}

SkyError SceneTruth::error(const std::vector<Spectrum>& found) const {
    if (what_ != Draws::distance) return comparison_.error(found);
    std::vector<Spectrum> seen;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Spectrum off = found[i] - comparison_.places()[i].light.radiance;
        seen.push_back(whole_.places()[i].light.radiance + off);
    }
    return whole_.error(seen);
}

std::vector<Spectrum> SceneTruth::as_compared(std::vector<Spectrum> light) const {
    if (weights_.empty()) return light;
    for (Spectrum& one : light) {
        glm::dvec3 color{};
        for (std::size_t c = 0; c < weights_.size(); ++c) color += one[c] * weights_[c];
        one = Spectrum(color, 0);
    }
    return light;
}

std::vector<Spectrum> SceneTruth::light() const {
    return mapped<Spectrum>(comparison_.places(),
                            [&](const TracedPlace& place) { return place.light.radiance; });
}

}  // namespace skybake
