// Renders a lit picture of a cloud volume by marching rays, as a runtime would. Sunlight takes a
// second march towards the sun; sky and ground light is the mean radiance of each. All light comes
// from the baked tables, but the sky behind the layer may be the solved one (cloud_air.h), and the light within
// the cloud that of march/light_in_cloud.h.
//
// The layer is flat. It repeats along x and y unless the medium says otherwise, and it is marched
// up to `reach_m` from the camera, as scene_march.h describes.
//
// The air between camera and cloud attenuates and adds light as if everything seen were at its mean
// distance (Hillaire 2016, section 5.9). With the transmittance T up to that distance and T_end
// along the whole ray, the air adds the share (1 - T) / (1 - T_end) of the radiance of all air in that
// direction, without the ground behind it.
#pragma once

#include <array>
#include <cstddef>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/march/cloud_medium.h"
#include "bakers/march/cloud_rays.h"
#include "bakers/march/layer_march.h"
#include "bakers/math/bake_options.h"
#include "bakers/render/sky_tables.h"
#include "bakers/render/solved_sky.h"

namespace skybake {

// Azimuths are from +x towards +y.
struct CloudCamera {
    glm::dvec3 position_m{};  // x and y from the tile's corner; z is the altitude
    double azimuth_degrees = 0;
    double elevation_degrees = 0;
    double horizontal_field_degrees = 60;
};

struct CloudViewSettings {
    int width = 0;
    int height = 0;
    CloudCamera camera;
    SunDirection sun;
    double step_m = 1;
    double light_step_m = 1;
    double reach_m = 1;
    bool leaping = true;                   // uses medium.leaps; changes no pixel
    bool sunlit = true;                    // false: march_view does not march towards the sun
    const LightInCloud* solved = nullptr;  // null: the light of octaves
};

// The result of the march, which does not depend on the colours of light: one channel for each
// member of RayResults, in their order. Row 0 is at the top. The bits are the same for any number
// of threads and any instruction set, with or without leaping.
struct MarchedView {
    static constexpr int kChannels = 6;
    Image2<float> results;
    FetchCounts fetches;
    double through = 1;  // the share of diffuse light that passes the layer
};
MarchedView march_view(const CloudMedium& medium, const CloudViewSettings& settings, int threads,
                       Progress* progress = nullptr);

// The light around a cloud layer, per unit of solar irradiance, with one entry per channel.
struct CloudIllumination {
    Spectrum sun_at_base{};  // irradiance at normal incidence
    Spectrum sun_at_top{};
    Spectrum sky{};     // mean radiance of the upper hemisphere at the layer's top
    Spectrum ground{};  // of the lower one at its base, without clouds above
};

struct Atmosphere {
    const SkyMedium& medium;
    const SkyTables& tables;
    const SolvedSky* solved = nullptr;  // the sky of one camera and sun; null: that of the tables
};
CloudIllumination illumination(const CloudMedium& medium, const Atmosphere& atmosphere,
                               const SunDirection& sun, int threads);

// The irradiance of level ground under a clear sky, per unit of solar irradiance.
struct GroundIrradiance {
    Spectrum sun{};
    Spectrum sky{};
};
GroundIrradiance ground_irradiance(const Atmosphere& atmosphere, const SunDirection& sun,
                                   int threads);

// The picture of cloud, air and sky: radiance in the atmosphere's channels. `progress` reports the
// march. After an interruption the picture must not be used.
struct CloudView {
    Image2<float> radiance;
    FetchCounts fetches;
    int refined_pixels = 0;  // pixels with four samples
};
CloudView render_cloud(const CloudMedium& medium, const Atmosphere& atmosphere,
                       const CloudViewSettings& settings, int threads,
                       Progress* progress = nullptr);

}  // namespace skybake
