// The sky around a camera and the clouds before it, in the light of one packet of wavelengths.
//
// The light in clouds is the sun's, attenuated and scattered along a second march, and the mean
// radiances of the hemispheres: of the upper one at a layer's top, and of the lower one at its base
// (cloud_light.h). Layers above dim the light of the upper one, and all layers that of the ground,
// by the share of diffuse light that passes them. The air before the cloud dims it and adds light
// as if all that a texel shows of the cloud were at its mean distance (Hillaire 2016, "Physically
// Based Sky, Atmosphere and Cloud Rendering in Frostbite", section 5.9). The ground is lit as it is
// without clouds. The air has the orders of scattering that its light has, and so has what it sends
// into the clouds.
#pragma once

#include <vector>

#include "bakers/assets/environment/environment_clouds.h"
#include "bakers/assets/environment/environment_sky.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/march/air_depths.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// The sky and its clouds in the light of one packet of wavelengths.
class CloudySky {
  public:
    // All arguments must outlive this object.
    CloudySky(const SkyLight& light, const SkyViewCamera& camera, double altitude_km,
              const SunZenith& sun, double sun_azimuth, const CloudsAround& clouds,
              const BakeOptions& options);

    // Returns the radiance along a direction of what is seen of the clouds and of the air around
    // them; with `exact`, the light of the air is integrated along this very ray.
    Spectrum radiance(const glm::dvec3& direction, const SeenClouds& seen, bool exact) const;

    // Whether the sun shines on a layer at all.
    static bool is_sunlit(const SkyLight& light, const CloudMedium& medium, const SunZenith& sun);

  private:
    // The light on a layer: irradiances that face the sun, and mean radiances.
    struct LayerLight {
        Spectrum sun_at_base{};
        Spectrum sun_at_top{};
        Spectrum from_sky{};
        Spectrum from_ground{};
    };
    static std::vector<LayerLight> lights_of(const SkyLight& light, const SunZenith& sun,
                                             const CloudsAround& clouds,
                                             const BakeOptions& options);
    // The light of a layer, and of the air before it, at the camera.
    Spectrum light_of_layer(const LayerLight& light, const SeenLayer& seen, double elevation,
                            const Spectrum& air) const;
    Spectrum sky_at(const TableModel& model, const SkyAround& around, double elevation,
                    double half_turns, bool exact) const;

    const SkyViewCamera& camera_;
    double sun_azimuth_;
    TableModel sky_model_;
    TableModel air_model_;
    SkyAround sky_;
    SkyAround air_;
    AirDepths depths_;
    int channels_;
    std::vector<LayerLight> lights_;
};

}  // namespace skybake
