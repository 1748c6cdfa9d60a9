// The air about a cloud layer as its picture needs it: the sky behind, and what lies between.
#pragma once

#include <vector>

#include "bakers/field/image.h"
#include "bakers/render/cloud_view.h"

namespace skybake {

class CloudAir {
  public:
    // For directions at the camera from `lowest_degrees` to `highest_degrees` above the horizontal
    // and distances of clouds up to `reach_m`.
    struct Range {
        double lowest_degrees = 0;
        double highest_degrees = 0;
        double degrees_per_pixel = 0;
        double reach_m = 0;
    };
    CloudAir(const Atmosphere& atmosphere, const CloudCamera& camera, const SunDirection& sun,
             const Range& range, int threads);

    // Along a direction, told by its elevation and azimuth in degrees.
    struct Along {
        Spectrum sky{};            // radiance of everything behind
        Spectrum transmittance{};  // of the air up to a distance
        Spectrum in_scattered{};   // radiance of the air up to there
    };
    Along along(double elevation_degrees, double azimuth_degrees, double distance_m) const;

  private:
    void fill_optical_depths(const Medium& air, double altitude_km);

    Range range_;
    double sun_azimuth_degrees_;
    double horizon_degrees_;
    Image2<float> panorama_;
    // Of the air, channels interleaved: distances to the square from 0 to reach across, elevations
    // as the panorama's in few rows, from the lowest up; then, in the last column, of the whole
    // ray.
    Image2<float> optical_depth_;
};

}  // namespace skybake
