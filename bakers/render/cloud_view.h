// A lit picture of a cloud volume, ray-marched as a runtime would: the sun by a second march
// towards it, sky and ground by their mean radiances, all from the baked tables.
//
// The layer is flat, repeats along x and y unless the medium says that it does not, and is marched
// up to `reach_m` from the camera. Samples stand every `step_m` along a ray, shifted for each
// sample of the picture by interleaved gradient noise (Jimenez, "Next Generation Post Processing in
// Call of Duty: Advanced Warfare", SIGGRAPH 2014), which turns bands into fine grain; those towards
// the sun by another noise.
//
// Air between camera and cloud dims and adds light as at the mean distance of what is seen
// (Hillaire 2016, section 5.9): with T that far and T_end along the whole ray, the share
// (1 - T) / (1 - T_end) of the sky's radiance in that direction; of the horizon's, for rays that
// meet the ground.
#pragma once

#include <array>
#include <cstddef>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/math/bake_options.h"
#include "bakers/render/cloud_medium.h"
#include "bakers/render/cloud_rays.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

inline constexpr double kSunSamples = 256;

// Azimuths are from +x towards +y.
struct CloudCamera {
    glm::dvec3 position_m{};  // x, y from the tile's corner, altitude
    double azimuth_degrees = 0;
    double elevation_degrees = 0;
    double horizontal_field_degrees = 60;
};

struct SunDirection {
    double elevation_degrees = 0;
    double azimuth_degrees = 0;
};

// How far a march towards the sun goes: to where sunlight enters the layer, but no farther than a
// tile is long, where the same clouds come again, or than its diagonal where they do not.
double sun_march_length_m(const CloudMedium& medium, const SunDirection& sun);

struct CloudViewSettings {
    int width = 0;
    int height = 0;
    CloudCamera camera;
    SunDirection sun;
    double step_m = 1;
    double light_step_m = 1;
    double reach_m = 1;
    bool leaping = true;  // by medium.leaps; changes no pixel
    bool sunlit = true;   // else nothing is marched towards the sun
};

// What the march sees before anything is known of light's colours: RayResults, a channel each, in
// their order. Row 0 at the top. The same bits for any number of threads and instruction set, and
// with or without leaping.
struct MarchedView {
    static constexpr int kChannels = 6;
    Image2<float> results;
    FetchCounts fetches;
    double through = 1;  // of diffuse light, through the whole layer
};
MarchedView march_view(const CloudMedium& medium, const CloudViewSettings& settings, int threads,
                       Progress* progress = nullptr);

// The light that a cloud layer is in, per unit of solar irradiance: one entry a channel.
struct CloudIllumination {
    Spectrum sun_at_base{};  // irradiance at normal incidence
    Spectrum sun_at_top{};
    Spectrum sky{};     // mean radiance of the upper hemisphere at the layer's top
    Spectrum ground{};  // of the lower one at its base, without a cloud above
};

struct Atmosphere {
    const SkyMedium& medium;
    const SkyTables& tables;
};
CloudIllumination illumination(const CloudMedium& medium, const Atmosphere& atmosphere,
                               const SunDirection& sun, int threads);

// The picture: cloud, air and sky; radiance of the atmosphere's channels. What `progress` is told
// is the march; after an interruption the picture is not to be used.
struct CloudView {
    Image2<float> radiance;
    FetchCounts fetches;
};
CloudView render_cloud(const CloudMedium& medium, const Atmosphere& atmosphere,
                       const CloudViewSettings& settings, int threads,
                       Progress* progress = nullptr);

}  // namespace skybake
