// The light of an asset at some places: as a runtime finds it in the stored texels, and by paths of
// light, which share nothing with the solver, its tables and its quadrature along rays.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/ext/vector_double3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bakers/assets/description/probe_places.h"
#include "bakers/assets/sky/sky_samples.h"
#include "bakers/field/choose_probes.h"
#include "bakers/field/conventions.h"
#include "bakers/light/path_tracer/path_tracer.h"
#include "bakers/math/bake_options.h"
#include "config/sections/parameters.h"
#include "config/sections/scene.h"

namespace skybake {

struct Baked;

// An atmosphere for paths of light: all its layers scatter, by their whole phase functions.
class TracedAir {
  public:
    explicit TracedAir(const config::Atmosphere& atmosphere);
    const SkyMedium& medium() const { return path_medium_.sky(); }
    const PathMedium& path_medium() const { return path_medium_; }

  private:
    PathMedium path_medium_;
};

// Returns the light of a place by paths, on one thread.
using TraceOfPlace =
    std::function<PathTracedRadiance(std::size_t place, const PathTracerSettings& settings)>;

// Returns the radiance of the samples by paths: of all orders, or without light that the air
// scattered once; with the ground that a view sees, or of the air alone.
TraceOfPlace trace_of_sky(std::shared_ptr<const TracedAir> air, std::vector<SkySample> samples,
                          config::SkyOrders orders, bool includes_ground);

// Returns the light at all places, as a runtime finds it in the stored texels.
using LightAtPlaces = std::function<std::vector<Spectrum>(const Baked& baked, int threads)>;

// Returns the facts of an asset in memory as a file would state them.
StoredTexels stored_texels(const Baked& baked);

// Returns the channels of lookups at probes' coordinates, one vector per entry of `at`.
std::vector<std::vector<double>> look_up_places(const Baked& baked, const AssetPlaces& places,
                                                const std::vector<Place>& at);

// Returns the light of an asset whose first channels are light: they are looked up as probes with
// the coordinates `at` are.
LightAtPlaces light_looked_up(std::function<AssetPlaces(const StoredTexels&)> places,
                              std::vector<Place> at);

// Returns the same of an asset's places, as its baker has them. The arguments must outlive it.
template <class Asset>
LightAtPlaces light_looked_up(AssetPlaces (*places)(const Parameters&, const Asset&,
                                                    const StoredTexels&),
                              const Parameters& parameters, const Asset& asset,
                              std::vector<Place> at) {
    return light_looked_up(
        [=, &parameters, &asset](const StoredTexels& stored) {
            return places(parameters, asset, stored);
        },
        std::move(at));
}

// Returns the same light for an irradiance of 1 in place of one of the sun's for each channel.
LightAtPlaces per_irradiance(LightAtPlaces found, std::vector<double> irradiance);

// A view up to a thing in the air, or to the ground before it.
struct AirSample {
    double altitude_km = 0;  // of the camera
    SunZenith sun;
    SkyDirection direction;
    double distance_km = 0;
};

// Returns the light that the air scatters into the views by paths: of all orders, or without light that
// it scattered once.
TraceOfPlace trace_of_air(std::shared_ptr<const TracedAir> air, std::vector<AirSample> samples,
                          config::SkyOrders orders);

// Returns the irradiance of the samples by the sky, by paths: of all orders, or without light that the
// air scattered once; and that by the sky and the sun.
TraceOfPlace trace_of_irradiance(std::shared_ptr<const TracedAir> air,
                                 std::vector<LevelSample> samples, config::SkyOrders orders);
TraceOfPlace trace_of_daylight(const std::shared_ptr<const TracedAir>& air,
                               const std::vector<LevelSample>& samples);

// Returns the traces of each packet of the recipe's wavelengths: one packet, unless its tables of
// light hold colours.
std::vector<TraceOfPlace> traces_of_packets(
    const Parameters& parameters,
    const std::function<TraceOfPlace(std::shared_ptr<const TracedAir> air)>& trace_of);

// Returns the weight of each wavelength in colours.
std::vector<glm::dvec3> weights_of(const ColorConvention& color);

// Returns the weight of each wavelength in channels that are colours; none if channels are wavelengths.
std::vector<glm::dvec3> weights_of(const Conventions& conventions);

// The light of an asset at some places, in the asset's unit for a solar irradiance of 1.
struct TracedLight {
    int channels = 0;  // of the asset
    std::vector<Place> places;
    LightAtPlaces found;
    std::vector<TraceOfPlace> traced;  // of each packet of wavelengths
    std::string better = {};           // what would come nearer to the paths, or empty
    bool air_scatters = true;          // else paths have nothing to find but the ground
};

// Returns the radiance of the samples, with the ground that views see, and what the files have of it.
TracedLight traced_sky(const Parameters& parameters, const std::vector<SkySample>& samples,
                       config::SkyOrders orders, LightAtPlaces found);

}  // namespace skybake
