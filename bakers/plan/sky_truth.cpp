#include "bakers/plan/sky_truth.h"

#include <algorithm>
#include <utility>

#include "bakers/light/sky_view_mapping.h"
#include "config/sweep/sobol.h"

namespace skybake {
namespace {

// Cameras at the top itself see no air above them.
constexpr double kHighestShare = 0.99;

double between(double low, double high, double share) { return low + share * (high - low); }

}  // namespace

SceneRange range_of(const config::Scene& scene, const Shell& shell) {
    SceneRange range;
    const double highest_km = kHighestShare * shell.thickness_km;
    range.lowest_altitude_km = std::min(scene.altitude[0].kilometers(), highest_km);
    range.highest_altitude_km = std::min(scene.altitude[1].kilometers(), highest_km);
    for (const config::Angle& sun : scene.suns) {
        range.suns_deg.push_back(sun.radians * kDegreesPerRadian);
    }
    range.lowest_sun_deg = scene.sun_elevation[0].radians * kDegreesPerRadian;
    range.highest_sun_deg = scene.sun_elevation[1].radians * kDegreesPerRadian;
    if (range.highest_sun_deg > kLowestSun_deg) {
        range.lowest_sun_deg = std::max(range.lowest_sun_deg, kLowestSun_deg);
    }
    return range;
}

std::vector<SkySample> scene_views(const SceneRange& range, const Shell& shell, int count,
                                   std::uint32_t first) {
    std::vector<SkySample> views;
    for (std::uint32_t i = first; i < first + static_cast<std::uint32_t>(count); ++i) {
        const auto share = [i](int dimension) { return config::sobol_coordinate(i, dimension); };
        const double sun_deg = range.suns_deg.empty()
                                   ? between(range.lowest_sun_deg, range.highest_sun_deg, share(0))
                                   : range.suns_deg[static_cast<std::size_t>(
                                         share(0) * static_cast<double>(range.suns_deg.size()))];
        const double altitude_km =
            between(range.lowest_altitude_km, range.highest_altitude_km, share(1));
        const SkyViewCamera camera(shell, altitude_km);
        views.push_back(sky_sample(shell, altitude_km, sun_deg,
                                   share(2) * camera.range_above() * kDegreesPerRadian,
                                   180 * share(3)));
    }
    return views;
}

namespace {

TracedLight light_of(const std::shared_ptr<const TracedAir>& air,
                     const std::vector<SkySample>& views, bool makes_colors) {
    TracedLight light;
    light.channels = makes_colors ? 3 : air->medium().air.channels;
    light.places = places_of(views);
    light.traced = {trace_of_sky(air, views, config::SkyOrders::all, false)};
    return light;
}

}  // namespace

SceneTruth::SceneTruth(const config::Atmosphere& air, std::vector<SkySample> views,
                       std::vector<glm::dvec3> weights, BakeOptions options)
    : views_(std::move(views)),
      options_(options),
      air_(std::make_shared<const TracedAir>(air)),
      weights_(std::move(weights)),
      light_(light_of(air_, views_, !weights_.empty())),
      comparison_(light_, weights_, options_) {}

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
    std::vector<Spectrum> light;
    for (const TracedPlace& place : comparison_.places()) light.push_back(place.light.radiance);
    return light;
}

}  // namespace skybake
