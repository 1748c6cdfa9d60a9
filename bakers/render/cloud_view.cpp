#include "bakers/render/cloud_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/field/interpolation.h"
#include "bakers/render/scene_march.h"
#include "bakers/render/scene_view.h"
#include "bakers/render/sky_view.h"
#include "bakers/render/tone_curve.h"
#include "config/text/mapped.h"

namespace skybake {

std::optional<SolvedSky> SolvedSky::of(const PreviewAsset& sky_view, const Shell& shell,
                                       const Place& place) {
    const bool is_one =
        sky_view.entry.kind == "sky_view" && sky_view.table.width > 1 && sky_view.table.height > 1;
    if (!is_one) return std::nullopt;
    return SolvedSky(sky_view.table, shell, place);
}

void SolvedSky::look_up(double elevation_degrees, double azimuth_degrees, double* radiance) const {
    const double above_horizon = elevation_degrees / kDegreesPerRadian + camera_.dip();
    const double x = std::fabs(std::remainder(azimuth_degrees, 360.0)) / 180;
    const double u =
        texture_coordinate(TexelConvention::end_points_on_texel_centres, x, table_.width);
    bilinear(table_, u, sky_view_v(camera_.coordinate(above_horizon), table_.height), radiance);
}

namespace {

double clamped_altitude_km(const Shell& shell, double altitude_m) {
    return std::clamp(altitude_m / 1000, 0.0, shell.thickness_km);
}

Spectrum sunlight_at(const Atmosphere& atmosphere, double altitude_m, const SunDirection& sun) {
    const Shell shell = shell_of(atmosphere.medium.air);
    const double altitude_km = clamped_altitude_km(shell, altitude_m);
    const double r = shell.ground_radius_km + altitude_km;
    return look_up_sunlight(atmosphere.tables, shell, altitude_km,
                            r * sine_of_degrees(sun.elevation_degrees));
}

// Returns the mean radiance over the directions between two elevations. All directions have the same
// weight or, for irradiances, the sine of their elevation.
enum class DirectionWeight { even, sine };
Spectrum mean_radiance(const Atmosphere& atmosphere, double altitude_m, const SunDirection& sun,
                       double lowest_degrees, double highest_degrees, int threads,
                       DirectionWeight weighting = DirectionWeight::even) {
    SkyView view;
    view.projection = SkyProjection::panorama;
    view.width = 64;
    view.height = 64;
    view.camera_altitude_km = clamped_altitude_km(shell_of(atmosphere.medium.air), altitude_m);
    view.sun_elevation_degrees = sun.elevation_degrees;
    view.lowest_degrees = lowest_degrees;
    view.highest_degrees = highest_degrees;
    const Image2<float> radiance = render_sky(atmosphere.medium, atmosphere.tables, view, threads);
    Spectrum sum{};
    double weights = 0;
    for (int y = 0; y < radiance.height; ++y) {
        const double t = (y + 0.5) / radiance.height;
        const double elevation = highest_degrees + t * (lowest_degrees - highest_degrees);
        const double weight =
            cosine_of_degrees(elevation) *
            (weighting == DirectionWeight::sine ? sine_of_degrees(elevation) : 1.0);
        for (int x = 0; x < radiance.width; ++x) {
            for (int c = 0; c < radiance.channels; ++c) {
                sum[static_cast<std::size_t>(c)] += weight * double{radiance.texel(x, y)[c]};
            }
            weights += weight;
        }
    }
    return sum / weights;
}

}  // namespace

CloudIllumination illumination(const CloudMedium& medium, const Atmosphere& atmosphere,
                               const SunDirection& sun, int threads) {
    const double top_m = medium.base_m + medium.extent_m[2];
    return {.sun_at_base = sunlight_at(atmosphere, medium.base_m, sun),
            .sun_at_top = sunlight_at(atmosphere, top_m, sun),
            .sky = mean_radiance(atmosphere, top_m, sun, 0, 90, threads),
            .ground = mean_radiance(atmosphere, medium.base_m, sun, -90, 0, threads)};
}

GroundIrradiance ground_irradiance(const Atmosphere& atmosphere, const SunDirection& sun,
                                   int threads) {
    const double slope = std::max(sine_of_degrees(sun.elevation_degrees), 0.0);
    return {slope * sunlight_at(atmosphere, 0, sun),
            std::numbers::pi *
                mean_radiance(atmosphere, 0, sun, 0, 90, threads, DirectionWeight::sine)};
}

namespace {

// The light of level ground, as one texel.
Image2<float> ground_light(const Atmosphere& atmosphere, const SunDirection& sun, int threads) {
    const GroundIrradiance ground = ground_irradiance(atmosphere, sun, threads);
    Image2<float> light(1, 1, atmosphere.medium.air.channels);
    for (std::size_t c = 0; c < light.texels.size(); ++c) {
        light.texels[c] = static_cast<float>(ground.sun[c] + ground.sky[c]);
    }
    return light;
}

// Few azimuths suffice, because the sky changes slowly along azimuth.
constexpr int kAzimuths = 256;

// Returns the atmosphere's solved sky if it is that of this picture.
const SolvedSky* solved_in(const Atmosphere& atmosphere, const SkyView& view) {
    const SolvedSky* solved = atmosphere.solved;
    const SolvedSky::Place place = {view.camera_altitude_km, view.sun_elevation_degrees};
    const bool is_it = solved != nullptr && solved->place() == place &&
                       solved->channels() == atmosphere.medium.air.channels;
    return is_it ? solved : nullptr;
}

}  // namespace

double camera_altitude_km(const Medium& air, const CloudCamera& camera) {
    return std::clamp(camera.position_m[2] / 1000, 0.0, shell_of(air).thickness_km);
}

CloudAir::CloudAir(const Atmosphere& atmosphere, const CloudCamera& camera, const SunDirection& sun,
                   const Range& range, int threads)
    : range_(range),
      sun_azimuth_degrees_(sun.azimuth_degrees),
      depths_(atmosphere.medium.air, camera_altitude_km(atmosphere.medium.air, camera),
              {range.lowest_degrees, range.highest_degrees, range.reach_m}) {
    SkyView view;
    view.projection = SkyProjection::panorama;
    view.camera_altitude_km = camera_altitude_km(atmosphere.medium.air, camera);
    view.sun_elevation_degrees = sun.elevation_degrees;
    view.lowest_degrees = range.lowest_degrees;
    view.highest_degrees = range.highest_degrees;
    view.width = kAzimuths;
    view.height = std::max(2, static_cast<int>((range.highest_degrees - range.lowest_degrees) /
                                               range.degrees_per_pixel));
    panorama_ = render_sky(atmosphere.medium, atmosphere.tables, view, threads);
    SkyMedium over_black_ground = atmosphere.medium;
    over_black_ground.air.ground_albedo = Spectrum(0.0);
    air_share_ = render_sky(over_black_ground, atmosphere.tables, view, threads);
    for (std::size_t i = 0; i < panorama_.texels.size(); ++i) {
        const float whole = panorama_.texels[i];  // never less but for rounding
        air_share_.texels[i] = whole > 0 ? std::min(air_share_.texels[i] / whole, 1.0f) : 1.0f;
    }
    solved_ = solved_in(atmosphere, view);
}

CloudAir::Along CloudAir::along(double elevation_degrees, double azimuth_degrees,
                                double distance_m) const {
    const double span = range_.highest_degrees - range_.lowest_degrees;
    const double height = std::clamp((elevation_degrees - range_.lowest_degrees) / span, 0.0, 1.0);
    const double turns = (azimuth_degrees - sun_azimuth_degrees_) / 360 + 0.5;
    const double u = turns - std::floor(turns);
    Along result;
    if (solved_ != nullptr) {
        solved_->look_up(elevation_degrees, azimuth_degrees - sun_azimuth_degrees_,
                         data(result.sky));
    } else {
        bilinear(panorama_, u, 1 - height, data(result.sky));
    }

    const AirDepths::Depths depths = depths_.at(height, distance_m);
    Spectrum share{};
    bilinear(air_share_, u, 1 - height, data(share));
    for (int c = 0; c < panorama_.channels; ++c) {
        const auto i = static_cast<std::size_t>(c);
        const double air = result.sky[i] * share[i];
        result.ground[i] = result.sky[i] - air;
        result.transmittance[i] = exponential(-depths.near[i]);
        const double opacity = 1 - exponential(-depths.whole[i]);
        result.in_scattered[i] =
            opacity > 0 ? air * std::min(1.0, (1 - result.transmittance[i]) / opacity) : 0;
    }
    return result;
}

std::vector<double> daylight_shares(const Atmosphere& atmosphere,
                                    const std::vector<SunDirection>& suns, int threads) {
    const auto seen = [&](const SunDirection& sun) {
        const Image2<float> light = ground_light(atmosphere, sun, threads);
        const Image2<float> shown = atmosphere.tables.screen.shown(light);
        return luminance(shown.texel(0, 0), shown.channels);
    };
    const double by_day = seen({kDaylightElevation, 0});
    return mapped<double>(
        suns, [&](const SunDirection& sun) { return by_day > 0 ? seen(sun) / by_day : 1; });
}

ScreenColor daylight_screen(const Atmosphere& atmosphere, int threads) {
    return atmosphere.tables.screen.with_white(
        ground_light(atmosphere, {kDaylightElevation, 0}, threads),
        "the light of sun and sky on level ground under a sun of 30 degrees");
}

}  // namespace skybake
