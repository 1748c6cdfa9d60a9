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
// clouds, f is 1. The ground's albedo varies from place to place (ground_albedo.h). A tile that does not repeat covers no share of the sky, so D and T_mean are 1 for it.
// Beyond the reach, T is T_mean. Clouds do not shade the air.
#pragma once

#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "bakers/render/cloud_air.h"
#include "bakers/render/cloud_view.h"
#include "bakers/render/scene_march.h"

namespace skybake {

// Renders pictures of a scene under one sun. What does not depend on the camera is made once.
class SceneRenderer {
  public:
    // The order of layers does not matter but for rounding. Media and atmosphere must outlive the
    // renderer.
    SceneRenderer(const std::vector<SceneLayer>& layers, const Atmosphere& atmosphere,
                  const SunDirection& sun, int threads, bool leaping = true);

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
