// Many suns as one view ray meets them.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "bakers/air/ray.h"

namespace skybake {

// Suns, each given by the cosine of its zenith angle where a ray begins and by the cosine of its
// angle to the ray. No direction need have both: the light is then the smooth continuation of that
// of real suns.
struct SunBundle {
    // The count is a multiple of kBundleStep, which gives room for whole vectors of any width; the
    // entries beyond `wanted` are copies.
    static constexpr int kBundleStep = 16;

    SunBundle(std::vector<double> cosines, std::vector<double> cosines_to_sun)
        : wanted(static_cast<int>(cosines.size())),
          count((wanted + kBundleStep - 1) / kBundleStep * kBundleStep),
          sun_cosines(std::move(cosines)),
          nu(std::move(cosines_to_sun)) {
        assert(!sun_cosines.empty() && sun_cosines.size() == nu.size());
        sun_cosines.resize(static_cast<std::size_t>(count), sun_cosines.back());
        nu.resize(static_cast<std::size_t>(count), nu.back());
    }

    int wanted = 0;
    int count = 0;
    std::vector<double> sun_cosines;
    std::vector<double> nu;
};

// A point of a view ray that begins at an altitude with s = r mu.
struct PointOfRay {
    PointOfRay(const Shell& shell, double begin_altitude_km, double begin_s_km, double at_km,
               double at_altitude_km)
        : begin_radius_km(shell.ground_radius_km + begin_altitude_km),
          radius_km(shell.ground_radius_km + at_altitude_km),
          distance_km(at_km),
          altitude_km(at_altitude_km),
          view_cosine(std::clamp((begin_s_km + at_km) / radius_km, -1.0, 1.0)) {}  // rounding

    double begin_radius_km;
    double radius_km;
    double distance_km;  // from the ray's beginning
    double altitude_km;
    double view_cosine;  // of the zenith angle, there
};

}  // namespace skybake
