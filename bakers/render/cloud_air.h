// The air around a cloud layer, as the layer's picture needs it: the sky behind the cloud, and the
// air between camera and cloud.
#pragma once

#include "bakers/field/image.h"
#include "bakers/march/air_depths.h"
#include "bakers/render/cloud_view.h"

namespace skybake {

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
    CloudAir(const Atmosphere& atmosphere, const CloudCamera& camera, const SunDirection& sun,
             const Range& range, int threads);

    // What the air does along a direction, given by its elevation and azimuth in degrees.
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
    Image2<float> panorama_;
    Image2<float> air_;  // the same without the light of the ground
    AirDepths depths_;
};

}  // namespace skybake
