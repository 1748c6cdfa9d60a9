// The light around a camera as a function of the coordinates of a map, for each mapping, with clouds
// or without them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>

#include "bakers/assets/environment/cloudy_sky.h"
#include "bakers/assets/environment/environment_clouds.h"
#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/assets/environment/environment_sky.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/bake_options.h"

namespace skybake::config {
struct EnvironmentBake;
}  // namespace skybake::config

namespace skybake {

// The clear sky by longitude and latitude: radiance (1/sr) towards the camera, computed row by row as
// in wide_sky_model. The sun is at `sun_azimuth` radians to the right of the middle. All arguments
// must outlive the model.
TableModel environment_model(const SkyLight& light, const SkyViewCamera& camera,
                             const SunZenith& sun, double sun_azimuth = 0);

// The models of all parts of an environment.
class EnvironmentModels {
  public:
    // `media` are of the layers of clouds. The arguments must outlive this object and its models.
    // After an interruption it must not be used.
    EnvironmentModels(const SkyLights& lights, const config::EnvironmentBake& bake,
                      std::span<const CloudMedium> media, const BakeOptions& options);
    EnvironmentModels(const EnvironmentModels&) = delete;
    EnvironmentModels& operator=(const EnvironmentModels&) = delete;

    TableModel of_part(int part) const;

    const EnvironmentLayout& layout() const { return layout_; }
    const SkyViewCamera& camera() const { return camera_; }
    const CloudsAround* clouds() const { return clouds_ ? &*clouds_ : nullptr; }

  private:
    TableModel clear_rows() const;
    TableModel clear_part(int part) const;
    TableModel cloudy_part(int part) const;
    TableModel cloudy_packet(const SkyLight& light, int part) const;

    const SkyLights& lights_;
    const config::EnvironmentBake& bake_;
    EnvironmentLayout layout_;
    SkyViewCamera camera_;
    SunZenith sun_;
    TableModel sky_;                   // of sky_view
    std::optional<SkyAround> around_;  // of other mappings than longitude_latitude, without clouds
    std::optional<CloudsAround> clouds_;
    std::map<const SkyLight*, std::unique_ptr<CloudySky>> cloudy_;  // of each packet
};

}  // namespace skybake
