#include "bakers/render/cloud_air.h"

#include <algorithm>
#include <cmath>

#include "bakers/air/ray.h"
#include "bakers/field/interpolation.h"
#include "bakers/render/cloud_camera.h"
#include "bakers/render/sky_view.h"

namespace skybake {

namespace {

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

}  // namespace skybake
