// A lit picture of a cloud volume, which scene_view.h makes by marching rays, as a runtime would: its
// camera, and the light and the air around it. Sunlight takes a second march towards the sun; sky and ground light is the mean radiance of each. All light comes
// from the baked tables, but the sky behind the layer may be the solved one, and the light
// within the cloud that of march/light_in_cloud.h.
//
// The layer is flat. It repeats along x and y unless the medium says otherwise, and it is marched
// up to `reach_m` from the camera, as scene_march.h describes.
//
// The air between camera and cloud attenuates and adds light as if everything seen were at its mean
// distance (Hillaire 2016, section 5.9). With the transmittance T up to that distance and T_end
// along the whole ray, the air adds the share (1 - T) / (1 - T_end) of the radiance of all air in that
// direction, without the ground behind it.
//
// The solved sky that a camera sees under a sun, looked up in a baked asset `sky_view`: all orders
// of scattering, without the sun's disc, with the ground below the horizon.
//
// The air around a cloud layer, as the layer's picture needs it: the sky behind the cloud, and the
// air between camera and cloud.
//
// The radiance along a whole ray is that of the solved sky, if the atmosphere has it for this camera and
// this sun, and else that of the tables. The tables say which share of it the ground sends; the air
// sends the rest.
#pragma once

#include <optional>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/ray.h"
#include "bakers/field/image.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/march/air_depths.h"
#include "bakers/march/cloud_medium.h"
#include "bakers/march/cloud_rays.h"
#include "bakers/march/layer_march.h"
#include "bakers/math/bake_options.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

class SolvedSky {
  public:
    // The camera's altitude, and the sun's elevation.
    struct Place {
        double altitude_km = 0;
        double sun_elevation_degrees = 0;
        bool operator==(const Place&) const = default;
    };
    // Returns nothing if the asset is not a sky view, in this shell, of one sun.
    static std::optional<SolvedSky> of(const PreviewAsset& sky_view, const Shell& shell,
                                       const Place& place);

    const Place& place() const { return place_; }
    int channels() const { return table_.channels; }

    // Writes the radiance (1/sr, for a solar irradiance of 1) of each channel along an elevation and an
    // azimuth from the sun, in degrees.
    void look_up(double elevation_degrees, double azimuth_degrees, double* radiance) const;

  private:
    SolvedSky(const Image2<float>& table, const Shell& shell, const Place& place)
        : table_(table), camera_(shell, place.altitude_km), place_(place) {}

    Image2<float> table_;
    SkyViewCamera camera_;
    Place place_;
};

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
};

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

// Returns the altitude from which a picture shows the sky, which is at most the top of the air.
double camera_altitude_km(const Medium& air, const CloudCamera& camera);

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
    // The solved sky must outlive this object.
    CloudAir(const Atmosphere& atmosphere, const CloudCamera& camera, const SunDirection& sun,
             const Range& range, int threads);

    // The air's effects along a direction, given by its elevation and azimuth in degrees.
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
    const SolvedSky* solved_ = nullptr;
    Image2<float> panorama_;   // of the tables' light
    Image2<float> air_share_;  // of the panorama's light
    AirDepths depths_;
};

inline constexpr double kDaylightElevation = 30;  // degrees

// Returns the luminance of level ground under each sun, as a share of that under a sun of 30 degrees.
std::vector<double> daylight_shares(const Atmosphere& atmosphere,
                                    const std::vector<SunDirection>& suns, int threads);

// Returns how the tables' channels are shown, with the white of pictures: the light of sun and sky on
// level ground, under a sun of 30 degrees in the picture's own air. It is the "daylight" that a camera is
// set to, and stays so in the evening, so that a low sun is orange and dusk is blue. Baked files keep
// their own white (bakers/color/color_space.h), in which the sun outside the air is white and clouds in
// the sun are beige.
//
// Hard cases: one channel, which has no colour, and air that lets no light through stay as they are.
ScreenColor daylight_screen(const Atmosphere& atmosphere, int threads);

}  // namespace skybake
