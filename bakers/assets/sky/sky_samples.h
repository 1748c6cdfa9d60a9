// Directions in which the sky of an asset is compared with paths of light.
//
// Solutions and tables are least accurate next to the horizon, next to the sun and in twilight:
// most directions lie there, and some all over the dome.
#pragma once

#include <vector>

#include "bakers/air/ray.h"
#include "bakers/field/choose_probes.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

struct SkySample {
    double altitude_km = 0;  // of the camera, which may be in space
    double sun_elevation_deg = 0;
    double above_horizon_deg = 0;  // of the view; the ground is below the horizon
    double azimuth_deg = 0;        // of the view from the sun, in [0, 180]
    SunZenith sun;
    SkyDirection direction;
};

// Returns one direction; no direction is nearer to the horizon than kHorizonMargin.
SkySample sky_sample(const Shell& shell, double altitude_km, double sun_elevation_deg,
                     double above_horizon_deg, double azimuth_deg);

// Returns 60 directions above the horizon, 4 next to the sun, and 6 below the horizon; from space
// only those that meet the air. No direction is nearer to the horizon than kHorizonMargin.
std::vector<SkySample> sky_samples(const Shell& shell, double altitude_km,
                                   double sun_elevation_deg);

// Returns directions of all cameras under all suns. For each camera and sun, every `stride`-th
// direction is taken; which ones these are differs between cameras and suns.
std::vector<SkySample> sky_samples(const Shell& shell, const std::vector<double>& altitudes_km,
                                   const std::vector<double>& sun_elevations_deg, int stride);

// A level surface that faces up.
struct LevelSample {
    double altitude_km = 0;
    double sun_elevation_deg = 0;
    SunZenith sun;
};

// Returns 42 suns and altitudes, from the ground to the upper air and from the zenith to 6 degrees
// below the horizon.
std::vector<LevelSample> level_samples(const Shell& shell);

// Returns the coordinates that probes of tables of irradiance have at the samples.
std::vector<Place> irradiance_probes_at(const std::vector<LevelSample>& samples);

// Return the samples' coordinates, for output.
std::vector<Place> places_of(const std::vector<SkySample>& samples);
std::vector<Place> places_of(const std::vector<LevelSample>& samples);

}  // namespace skybake
