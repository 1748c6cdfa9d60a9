// Optical depths of the air along the rays of one camera: up to any distance, and to a ray's end at
// the ground or at the top of the atmosphere.
//
// They are held by elevation and by distance, which is spaced quadratically, and interpolated
// linearly. Between two distances, extinction is integrated by Simpson's rule.
#pragma once

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/math/vectors.h"

namespace skybake {

class AirDepths {
  public:
    // The directions are from `lowest_degrees` to `highest_degrees` above the horizontal, the
    // distances up to `reach_m`.
    struct Range {
        double lowest_degrees = 0;
        double highest_degrees = 0;
        double reach_m = 0;
        int elevations = 256;  // optical depths change fast with the elevation next to the horizon
    };
    // The camera is at an altitude in [0, thickness].
    AirDepths(const Medium& air, double altitude_km, const Range& range);

    struct Depths {
        Spectrum near{};   // up to the distance
        Spectrum whole{};  // to the ray's end
    };
    // `height` is the share of the range of elevations, in [0, 1]. Distances beyond the reach count
    // as the reach.
    Depths at(double height, double distance_m) const;

  private:
    void fill_row(const Medium& air, double altitude_km, int row);

    Range range_;
    // Channels interleaved. Columns are distances from 0 to the reach; the last column is for the
    // whole ray. Rows are elevations from the lowest up.
    Image2<float> depths_;
};

}  // namespace skybake
