#include "bakers/assets/environment/cloudy_sky.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "bakers/assets/environment/environment_sky.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

double clamped_altitude_km(const SkyLight& light, double altitude_m) {
    return std::clamp(altitude_m / 1000, 0.0, light.shell().thickness_km);
}

Spectrum sunlight_on_layer(const SkyLight& light, double altitude_m, const SunZenith& sun) {
    const double altitude_km = clamped_altitude_km(light, altitude_m);
    return light.sun_transmittance(altitude_km,
                                   (light.shell().ground_radius_km + altitude_km) * sun.cosine);
}

// Returns the mean radiance of a hemisphere, all of whose directions have the same weight.
Spectrum mean_of_hemisphere(const SkyLight& light, double altitude_m, const SunZenith& sun,
                            bool upper, const BakeOptions& options) {
    constexpr int kSlices = 48;
    constexpr int kAzimuths = 32;
    const SkyViewCamera camera(light.shell(), clamped_altitude_km(light, altitude_m));
    const TableModel model = wide_sky_model(light, camera, sun);
    std::vector<double> azimuths;
    for (int i = 0; i < kAzimuths; ++i) azimuths.push_back((i + 0.5) / kAzimuths);
    std::vector<Spectrum> means(kSlices);
    parallel_for(kSlices, options.threads, [&](int slice) {
        const double sine = (slice + 0.5) / kSlices;
        const double elevation = std::numbers::pi / 2 - arc_cosine(sine);
        const double angle = (upper ? elevation : -elevation) + camera.dip();
        if (!sees_air(camera, angle)) return;
        std::vector<double> row(static_cast<std::size_t>(kAzimuths * model.channels));
        model.row(0, camera.coordinate(angle), azimuths, row.data());
        Spectrum& mean = means[static_cast<std::size_t>(slice)];
        for (std::size_t i = 0; i < row.size(); ++i) {
            mean[i % static_cast<std::size_t>(model.channels)] += row[i] / kAzimuths;
        }
    });
    Spectrum sum{};
    for (const Spectrum& mean : means) sum += mean;
    return sum / double{kSlices};
}

// Elevations of the air's depths, a tenth of a degree apart.
constexpr int kElevations = 2048;

AirDepths depths_of(const SkyLight& light, double altitude_km, double reach_m) {
    return AirDepths(light.medium().air, std::min(altitude_km, light.shell().thickness_km),
                     {-90, 90, reach_m, kElevations});
}

}  // namespace

bool CloudySky::is_sunlit(const SkyLight& light, const CloudMedium& medium, const SunZenith& sun) {
    const double top_m = medium.base_m + medium.extent_m[2];
    return sunlight_on_layer(light, top_m, sun) != Spectrum{} ||
           sunlight_on_layer(light, medium.base_m, sun) != Spectrum{};
}

CloudySky::CloudySky(const SkyLight& light, const SkyViewCamera& camera, double altitude_km,
                     const SunZenith& sun, double sun_azimuth, const CloudsAround& clouds,
                     const BakeOptions& options)
    : camera_(camera),
      sun_azimuth_(sun_azimuth),
      sky_model_(wide_sky_model(light, camera, sun)),
      air_model_(wide_sky_model(light, camera, sun, SeenGround::black)),
      sky_(sky_model_, camera, options),
      air_(air_model_, camera, options),
      depths_(depths_of(light, altitude_km, clouds.reach_m(1000 * altitude_km))),
      channels_(light.medium().air.channels),
      lights_(lights_of(light, sun, clouds, options)) {}

std::vector<CloudySky::LayerLight> CloudySky::lights_of(const SkyLight& light, const SunZenith& sun,
                                                        const CloudsAround& clouds,
                                                        const BakeOptions& options) {
    std::vector<LayerLight> lights;
    double through = 1;
    for (const CloudMedium* medium : clouds.media()) {
        const double top_m = medium->base_m + medium->extent_m[2];
        LayerLight& of_layer = lights.emplace_back();
        of_layer.sun_at_base = sunlight_on_layer(light, medium->base_m, sun);
        of_layer.sun_at_top = sunlight_on_layer(light, top_m, sun);
        of_layer.from_sky = through * mean_of_hemisphere(light, top_m, sun, true, options);
        of_layer.from_ground = mean_of_hemisphere(light, medium->base_m, sun, false, options);
        through *= clouds.through(lights.size() - 1);
    }
    for (LayerLight& of_layer : lights) of_layer.from_ground *= through;
    return lights;
}

Spectrum CloudySky::sky_at(const TableModel& model, const SkyAround& around, double elevation,
                           double half_turns, bool exact) const {
    Spectrum values{};
    if (exact) {
        const double y = camera_.coordinate(elevation + camera_.dip());
        model.reference(y, {turn_from_sun(half_turns)}, data(values));
    } else {
        around.at(elevation, half_turns, data(values));
    }
    return values;
}

Spectrum CloudySky::radiance(const glm::dvec3& direction, const SeenClouds& seen,
                             bool exact) const {
    const MapAngles angles = angles_of(direction);
    const double half_turns = (angles.azimuth - sun_azimuth_) / std::numbers::pi;
    const Spectrum sky = sky_at(sky_model_, sky_, angles.elevation, half_turns, exact);
    Spectrum sum = seen.transmittance * sky;
    std::optional<Spectrum> air;
    for (std::size_t l = 0; l < seen.layers.size(); ++l) {
        if (!(seen.layers[l].opacity > 0)) continue;
        if (!air) air = sky_at(air_model_, air_, angles.elevation, half_turns, exact);
        sum += light_of_layer(lights_[l], seen.layers[l], angles.elevation, *air);
    }
    return sum;
}

Spectrum CloudySky::light_of_layer(const LayerLight& light, const SeenLayer& seen, double elevation,
                                   const Spectrum& air) const {
    const Spectrum cloud = light.sun_at_base * seen.sun_at_base +
                           light.sun_at_top * seen.sun_at_top + light.from_sky * seen.from_sky +
                           light.from_ground * seen.from_ground;
    const double height = std::clamp(0.5 + elevation / std::numbers::pi, 0.0, 1.0);
    const AirDepths::Depths depths = depths_.at(height, seen.distance_m / seen.opacity);
    Spectrum sum{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
        const double near = exponential(-depths.near[c]);
        const double far = exponential(-depths.whole[c]);
        const double share = far < 1 ? std::min(1.0, (1 - near) / (1 - far)) : 0;
        sum[c] = near * cloud[c] + seen.opacity * share * air[c];
    }
    return sum;
}

}  // namespace skybake
