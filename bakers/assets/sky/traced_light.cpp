#include "bakers/assets/sky/traced_light.h"

#include <algorithm>
#include <array>
#include <utility>

#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/light/sky_radiance.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// The light scattered once into a view from the air.
Spectrum first_order(const SkyMedium& medium, const SkySample& sample) {
    const CameraRay ray =
        camera_ray(shell_of(medium.air), sample.altitude_km, sample.sun, sample.direction);
    return SkyIntegrator(medium, nullptr).radiance(ray.in_air).single;
}

// Returns the light that comes straight from the sun onto a level surface.
Spectrum sunlight_on(const TracedAir& air, const LevelSample& at) {
    if (!(at.sun.cosine > 0)) return {};
    const AirShells& shells = air.path_medium().air();
    const double r = shells.planet().ground_radius_km + at.altitude_km;
    return at.sun.cosine *
           shells.sunlight(at.altitude_km, r * at.sun.cosine, shells.shell_at(at.altitude_km));
}

}  // namespace

TracedAir::TracedAir(const config::Atmosphere& atmosphere)
    : path_medium_(make_sky_medium(atmosphere)) {}

TraceOfPlace trace_of_sky(std::shared_ptr<const TracedAir> air, std::vector<SkySample> samples,
                          config::SkyOrders orders, bool includes_ground) {
    return [=, air = std::move(air), samples = std::move(samples)](std::size_t place,
                                                                   PathTracerSettings settings) {
        settings.include_seen_ground = includes_ground;
        const SkySample& at = samples[place];
        PathTracedRadiance light =
            trace_paths(air->path_medium(), at.altitude_km, at.sun, at.direction, settings, 1);
        if (orders == config::SkyOrders::multiple) {
            light.radiance -= first_order(air->medium(), at);
        }
        return light;
    };
}

TraceOfPlace trace_of_air(std::shared_ptr<const TracedAir> air, std::vector<AirSample> samples,
                          config::SkyOrders orders) {
    return [=, air = std::move(air), samples = std::move(samples)](std::size_t place,
                                                                   PathTracerSettings settings) {
        settings.include_seen_ground = false;
        const AirSample& at = samples[place];
        settings.length_km = at.distance_km;
        PathTracedRadiance light =
            trace_paths(air->path_medium(), at.altitude_km, at.sun, at.direction, settings, 1);
        if (orders == config::SkyOrders::multiple) light.radiance -= light.orders[0];
        return light;
    };
}

TraceOfPlace trace_of_irradiance(std::shared_ptr<const TracedAir> air,
                                 std::vector<LevelSample> samples, config::SkyOrders orders) {
    return [=, air = std::move(air), samples = std::move(samples)](
               std::size_t place, const PathTracerSettings& settings) {
        const LevelSample& at = samples[place];
        PathTracedRadiance light =
            trace_irradiance(air->path_medium(), at.altitude_km, at.sun, settings, 1);
        if (orders == config::SkyOrders::multiple) {
            light.radiance -= light.orders[0];
            light.walked = light.radiance;
            for (Spectrum& mean : light.replicates) mean -= light.orders[0];
        }
        return light;
    };
}

TraceOfPlace trace_of_daylight(const std::shared_ptr<const TracedAir>& air,
                               const std::vector<LevelSample>& samples) {
    return [=, of_sky = trace_of_irradiance(air, samples, config::SkyOrders::all)](
               std::size_t place, const PathTracerSettings& settings) {
        PathTracedRadiance light = of_sky(place, settings);
        light.radiance += sunlight_on(*air, samples[place]);
        return light;
    };
}

StoredTexels stored_texels(const Baked& baked) {
    const std::array<int, 3>& size = baked.levels.front().size;
    return {baked.mapping, {size.begin(), size.end()}, baked.channel_names.size()};
}

std::vector<std::vector<double>> look_up_places(const Baked& baked, const AssetPlaces& places,
                                                const std::vector<Place>& at) {
    std::vector<std::vector<double>> found;
    for (const Place& place : at) {
        std::vector<double> sum(baked.channel_names.size(), 0.0);
        Probe probe;
        probe.at = place;
        for (const ProbeLookup& lookup : places.lookups(probe, 0)) {
            const std::vector<double> value =
                look_up(baked.levels.front(), baked.pixel_type, lookup.uvw);
            for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += lookup.share * value[c];
        }
        found.push_back(std::move(sum));
    }
    return found;
}

LightAtPlaces light_looked_up(std::function<AssetPlaces(const StoredTexels&)> places,
                              std::vector<Place> at) {
    return [=](const Baked& baked, int) {
        std::vector<Spectrum> light;
        for (const std::vector<double>& channels :
             look_up_places(baked, places(stored_texels(baked)), at)) {
            Spectrum spectrum{};
            std::copy_n(channels.begin(), std::min<std::size_t>(channels.size(), kMaxChannels),
                        data(spectrum));
            light.push_back(spectrum);
        }
        return light;
    };
}

LightAtPlaces per_irradiance(LightAtPlaces found, std::vector<double> irradiance) {
    return [=](const Baked& baked, int threads) {
        std::vector<Spectrum> light = found(baked, threads);
        for (Spectrum& one : light) {
            for (std::size_t c = 0; c < irradiance.size(); ++c) one[c] /= irradiance[c];
        }
        return light;
    };
}

std::vector<glm::dvec3> weights_of(const ColorConvention& color) {
    std::vector<glm::dvec3> weights;
    for (std::size_t i = 0; i + 2 < color.weights.size(); i += 3) {
        weights.emplace_back(color.weights[i], color.weights[i + 1], color.weights[i + 2]);
    }
    return weights;
}

std::vector<glm::dvec3> weights_of(const Conventions& conventions) {
    const auto& color = conventions.color;
    return color && color->is_applied ? weights_of(*color) : std::vector<glm::dvec3>{};
}

std::vector<TraceOfPlace> traces_of_packets(
    const Parameters& parameters,
    const std::function<TraceOfPlace(std::shared_ptr<const TracedAir> air)>& trace_of) {
    return mapped<TraceOfPlace>(light_packets(parameters), [&](const config::Atmosphere& packet) {
        return trace_of(std::make_shared<const TracedAir>(packet));
    });
}

TracedLight traced_sky(const Parameters& parameters, const std::vector<SkySample>& samples,
                       config::SkyOrders orders, LightAtPlaces found) {
    const auto trace_of = [&](std::shared_ptr<const TracedAir> air) {
        return trace_of_sky(std::move(air), samples, orders, true);
    };
    return TracedLight{light_channels(parameters), places_of(samples), std::move(found),
                       traces_of_packets(parameters, trace_of)};
}

}  // namespace skybake
