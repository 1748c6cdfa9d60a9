#include "bakers/render/cloud_air.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/air/ray.h"
#include "bakers/field/interpolation.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/parallel.h"
#include "bakers/render/cloud_camera.h"
#include "bakers/render/sky_view.h"

namespace skybake {

namespace {

constexpr int kDistances = 48;
// Optical depths change fast with the elevation next to the horizon.
constexpr int kElevations = 256;
// Few azimuths suffice, because the sky changes slowly along azimuth.
constexpr int kAzimuths = 256;

// Returns the length of the whole ray, which ends at the ground or at the top of the atmosphere.
double ray_length_km(const Shell& shell, double altitude_km, double s_km) {
    if (s_km < -horizon_distance_km(shell, altitude_km)) {
        return distance_to_ground_km(shell, altitude_km, s_km);
    }
    return distance_to_top_km(shell, altitude_km, s_km);
}

// Writes the optical depths at ascending distances, by Simpson's rule between neighbouring
// distances.
void optical_depths(const Medium& air, double altitude_km, double mu,
                    const std::vector<double>& distances_km, float* out, std::size_t stride) {
    const Shell shell = shell_of(air);
    const double s = (shell.ground_radius_km + altitude_km) * mu;
    const auto extinction = [&](double distance) {
        const double altitude = altitude_along_km(shell, altitude_km, s, distance);
        return extinction_at(air, std::clamp(altitude, 0.0, shell.thickness_km));
    };
    Spectrum sum{};
    Spectrum before = extinction(0);
    double from = 0;
    for (const double to : distances_km) {
        const Spectrum middle = extinction(0.5 * (from + to));
        const Spectrum after = extinction(to);
        for (int c = 0; c < air.channels; ++c) {
            const auto i = static_cast<std::size_t>(c);
            sum[i] += (to - from) / 6 * (before[i] + 4 * middle[i] + after[i]);
            out[i] = static_cast<float>(sum[i]);
        }
        out += stride;
        before = after;
        from = to;
    }
}

}  // namespace

CloudAir::CloudAir(const Atmosphere& atmosphere, const CloudCamera& camera, const SunDirection& sun,
                   const Range& range, int threads)
    : range_(range), sun_azimuth_degrees_(sun.azimuth_degrees) {
    const Medium& air = atmosphere.medium.air;
    const Shell shell = shell_of(air);
    SkyView view;
    view.projection = SkyProjection::panorama;
    view.camera_altitude_km = std::clamp(camera.position_m[2] / 1000, 0.0, shell.thickness_km);
    view.sun_elevation_degrees = sun.elevation_degrees;
    view.lowest_degrees = range.lowest_degrees;
    view.highest_degrees = range.highest_degrees;
    view.width = kAzimuths;
    view.height = std::max(2, static_cast<int>((range.highest_degrees - range.lowest_degrees) /
                                               range.degrees_per_pixel));
    panorama_ = render_sky(atmosphere.medium, atmosphere.tables, view, threads);
    SkyMedium over_black_ground = atmosphere.medium;
    over_black_ground.air.ground_albedo = Spectrum(0.0);
    air_ = render_sky(over_black_ground, atmosphere.tables, view, threads);
    fill_optical_depths(air, view.camera_altitude_km);
}

void CloudAir::fill_optical_depths(const Medium& air, double altitude_km) {
    const Shell shell = shell_of(air);
    optical_depth_ = Image2<float>(kDistances + 1, kElevations, air.channels);
    for (int row = 0; row < kElevations; ++row) {
        const double t = static_cast<double>(row) / (kElevations - 1);
        const double elevation =
            range_.lowest_degrees + t * (range_.highest_degrees - range_.lowest_degrees);
        const double mu = sine_of_degrees(elevation);
        const double length_km =
            ray_length_km(shell, altitude_km, (shell.ground_radius_km + altitude_km) * mu);
        std::vector<double> distances_km;
        for (int i = 0; i < kDistances; ++i) {
            const double x = static_cast<double>(i) / (kDistances - 1);
            distances_km.push_back(std::min(x * x * range_.reach_m / 1000, length_km));
        }
        optical_depths(air, altitude_km, mu, distances_km, optical_depth_.texel(0, row),
                       static_cast<std::size_t>(air.channels));
        // The whole ray has the same number of steps, and short ones come first.
        std::vector<float> whole(static_cast<std::size_t>(air.channels * kDistances));
        for (int i = 0; i < kDistances; ++i) {
            const double x = (i + 1.0) / kDistances;
            distances_km[static_cast<std::size_t>(i)] = x * x * length_km;
        }
        optical_depths(air, altitude_km, mu, distances_km, data(whole),
                       static_cast<std::size_t>(air.channels));
        std::copy(whole.end() - air.channels, whole.end(), optical_depth_.texel(kDistances, row));
    }
}

CloudAir::Along CloudAir::along(double elevation_degrees, double azimuth_degrees,
                                double distance_m) const {
    const double span = range_.highest_degrees - range_.lowest_degrees;
    const double height = std::clamp((elevation_degrees - range_.lowest_degrees) / span, 0.0, 1.0);
    const double turns = (azimuth_degrees - sun_azimuth_degrees_) / 360 + 0.5;
    const double u = turns - std::floor(turns);
    Along result;
    bilinear(panorama_, u, 1 - height, data(result.sky));

    // Row and column in the table, where texel i is at i.
    const double column =
        std::sqrt(std::clamp(distance_m / range_.reach_m, 0.0, 1.0)) * (kDistances - 1);
    const double v = (0.5 + height * (kElevations - 1)) / kElevations;
    Spectrum depth{};
    Spectrum whole{};
    bilinear(optical_depth_, (column + 0.5) / (kDistances + 1), v, data(depth));
    bilinear(optical_depth_, 1, v, data(whole));
    Spectrum air{};
    bilinear(air_, u, 1 - height, data(air));
    for (int c = 0; c < panorama_.channels; ++c) {
        const auto i = static_cast<std::size_t>(c);
        result.ground[i] = std::max(result.sky[i] - air[i], 0.0);
        result.transmittance[i] = exponential(-depth[i]);
        const double opacity = 1 - exponential(-whole[i]);
        result.in_scattered[i] =
            opacity > 0 ? air[i] * std::min(1.0, (1 - result.transmittance[i]) / opacity) : 0;
    }
    return result;
}

}  // namespace skybake
