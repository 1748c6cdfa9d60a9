// The air around a cloud layer, as the layer's picture needs it: the sky behind the cloud, and the
// air between camera and cloud.
//
// The radiance along a whole ray is that of the solved sky, if the atmosphere has it for this camera and
// this sun, and else that of the tables. The tables say which share of it the ground sends; the air
// sends the rest.
#pragma once

#include "bakers/field/image.h"
#include "bakers/march/air_depths.h"
#include "bakers/render/cloud_view.h"

namespace skybake {

// Returns the altitude from which a picture shows the sky, which is at most the top of the air.
double camera_altitude_km(const Medium& air, const CloudCamera& camera);

class CloudAir {
  public:
    // The range of lookups: directions at the camera from `lowest_degrees` to `highest_degrees`
    // above the horizontal, and distances of clouds up to `reach_m`.
    struct Range {
        double lowest_degrees = 0;
        double highest_degrees = 0;
        double degrees_per_pixel = 0;
        double reach_m = 0;
    };
    // The solved sky must outlive this object.
    CloudAir(const Atmosphere& atmosphere, const CloudCamera& camera, const SunDirection& sun,
             const Range& range, int threads);

    // The air's effects along a direction, given by its elevation and azimuth in degrees.
    struct Along {
        Spectrum sky{};            // radiance of the sky behind the cloud, or of the ground
        Spectrum ground{};         // the part of it that the ground sends
        Spectrum transmittance{};  // of the air up to the given distance
        Spectrum in_scattered{};   // radiance of the air up to that distance
    };
    Along along(double elevation_degrees, double azimuth_degrees, double distance_m) const;

  private:
    Range range_;
    double sun_azimuth_degrees_;
    const SolvedSky* solved_ = nullptr;
    Image2<float> panorama_;   // of the tables' light
    Image2<float> air_share_;  // of the panorama's light
    AirDepths depths_;
};

}  // namespace skybake
