// Renders one sky with all its cloud layers: clouds in the order of depth, the air before them, the
// sky and the ground behind them.
//
// Clouds are lit as cloud_view.h says, each layer by its own light, which the layers above it dim: their
// optical depths towards the sun are added, and each lets the share `through` of the sky's light pass
// (cloud_light.h). The air before a layer is that up to the mean distance of what is seen of it.
//
// The ground's light behind clouds' shadows is scaled by
//
//   f = (E_sun T + E_sky D + E_sun max(D - T_mean, 0)) / (E_sun + E_sky)
//
// with E the irradiances of the ground under a clear sky, T the transmittance towards the sun from the
// point that is seen, D the product of the layers' `through`, and T_mean the product of their mean
// transmittances: the sunlight that passes the layers, but not directly, is spread evenly. Without
// clouds, f is 1. The ground's albedo varies from place to place. A tile that does not repeat
// covers no share of the sky, so D and T_mean are 1 for it.
// Beyond the reach, T is T_mean. Clouds do not shade the air.
//
// How the albedo of the ground varies in pictures: fields, woods and bare soil, as no map says where they are.
//
// The albedo at a place is its mean times 1 + m, where m is a sum of value noises of cells of 3 km down to
// 20 m. The mean of m over a wide area is 0. A noise whose cells are not wider than a pixel's footprint is left
// out, so that far ground has its mean albedo and does not flicker.
#pragma once

#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "bakers/math/vectors.h"
#include "bakers/render/cloud_view.h"
#include "bakers/render/scene_march.h"

namespace skybake {

// Returns m at a place, x and y in metres, for a pixel that covers `footprint_m` of the ground.
double ground_mottle(double x_m, double y_m, double footprint_m);

// Returns m where a ray from `eye_m` of a pixel as wide as `pixel`, at distance 1, meets the ground; 0 where it
// meets none. x and y are in metres, z is the altitude.
double ground_mottle_along(const glm::dvec3& eye_m, const glm::dvec3& direction, double pixel);

// Returns 1 + m of each channel. White ground varies less than dark ground, so that none is whiter than white.
Spectrum mottled(const Spectrum& albedo, double mottle);

// Renders pictures of a scene under one sun. What does not depend on the camera is made once.
class SceneRenderer {
  public:
    // The order of layers does not matter but for rounding. Media and atmosphere must outlive the
    // renderer.
    SceneRenderer(const std::vector<SceneLayer>& layers, const Atmosphere& atmosphere,
                  const SunDirection& sun, int threads);

    // After an interruption the picture must not be used.
    CloudView render(const SceneFrame& frame, int threads, Progress* progress = nullptr);

    // Elevation and azimuth of a direction, in degrees.
    struct Bearing {
        double elevation = 0;
        double azimuth = 0;
    };

  private:
    // Returns f, if the ground sees the share `direct` of the sun.
    Spectrum ground_share(double direct) const;
    // `ground` is the share of its light that ground behind clouds sends.
    Spectrum radiance(const CloudAir& air, const Bearing& bearing, const Spectrum& ground,
                      const float* seen) const;
    const CloudAir& air_for(const SceneFrame& frame, int threads);

    std::vector<SceneLayer> layers_;
    Atmosphere atmosphere_;
    SunDirection sun_;
    std::vector<CloudIllumination> lights_;
    std::optional<SceneMarch> march_;
    double farthest_m_ = 0;
    // The ground's irradiance under a clear sky, by the sun and by the sky.
    Spectrum ground_sun_{};
    Spectrum ground_sky_{};
    double through_ = 1;
    double ground_through_ = 1;  // of the layers that repeat
    // The air of the last camera: pictures of a turntable share it.
    std::unique_ptr<const CloudAir> air_;
    std::tuple<double, double, double, double> air_key_{};
};

}  // namespace skybake
