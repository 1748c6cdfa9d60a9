#include "bakers/assets/sky/sky_samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/light/sky_view_mapping.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// Shares of the angle between the horizon and the zenith, or the edge of the air seen from space.
constexpr double kSharesAbove[] = {0.003, 0.006, 0.01, 0.02, 0.04, 0.08,
                                   0.15,  0.25,  0.4,  0.6,  0.8,  0.95};
constexpr double kAzimuths_deg[] = {8, 35, 80, 125, 172};
// Shares of the angle between the horizon and straight down.
constexpr double kSharesBelow[] = {0.01, 0.08, 0.4};
constexpr double kAzimuthsBelow_deg[] = {20, 150};
// Offsets from the sun: up and sideways.
constexpr double kStepsFromSun_deg[][2] = {{0.6, 0.2}, {-0.3, 1.5}, {2.5, 1}, {-3, 2}};

// Angles in degrees, as those of SkySample.
struct Angles {
    double above_horizon;
    double azimuth;
};

// Numbers in [-1, 1) that are spread evenly and follow no grid of texels: multiples of the inverse
// powers of the plastic number (Roberts 2018, "The unreasonable effectiveness of quasirandom
// sequences").
constexpr double kFirstStep = 0.7548776662466927;
constexpr double kSecondStep = 0.5698402909980532;
double spread(std::size_t i, double step) {
    const double x = static_cast<double>(i) * step;
    return 2 * (x - std::floor(x)) - 1;
}

// The direction at a share of the range and at about this azimuth; a share of 1 is not passed.
Angles moved(double share, double range_deg, double azimuth_deg, std::size_t i) {
    const double moved_share = share * (1 + 0.4 * (1 - share) * spread(i, kFirstStep));
    return {moved_share * range_deg, azimuth_deg + 7 * spread(i, kSecondStep)};
}

void add_next_to_sun(const SkyViewCamera& camera, double sun_elevation_deg,
                     std::vector<Angles>& angles) {
    const double dip_deg = camera.dip() * kDegreesPerRadian;
    const double zenith_deg = 90 + dip_deg;  // above the horizon
    // Under a sun below the horizon, the brightest air is next to the horizon.
    const double sun_deg = std::max(sun_elevation_deg + dip_deg, 0.0);
    for (const auto& [up, aside] : kStepsFromSun_deg) {
        double height = std::fabs(sun_deg + up);
        if (height >= zenith_deg) height = sun_deg - std::fabs(up);
        const double circle = cosine_of((height - dip_deg) / kDegreesPerRadian);
        // Next to the zenith any azimuth is next to the sun.
        angles.push_back({height, circle * 90 > aside ? aside / circle : 90});
    }
}

std::vector<Angles> angles_of(const SkyViewCamera& camera, double sun_elevation_deg) {
    const double above = camera.range_above() * kDegreesPerRadian;
    const double below = camera.range_below() * kDegreesPerRadian;
    std::vector<Angles> angles;
    for (const double share : kSharesAbove) {
        for (const double azimuth : kAzimuths_deg) {
            angles.push_back(moved(share, above, azimuth, angles.size()));
        }
    }
    for (const double share : kSharesBelow) {
        for (const double azimuth : kAzimuthsBelow_deg) {
            angles.push_back(moved(share, -below, azimuth, angles.size()));
        }
    }
    add_next_to_sun(camera, sun_elevation_deg, angles);
    std::erase_if(angles, [&](const Angles& one) { return one.above_horizon >= above; });
    return angles;
}

SkySample sample_at(const SkyViewCamera& camera, double altitude_km, double sun_elevation_deg,
                    const Angles& angles) {
    SkySample sample;
    sample.altitude_km = altitude_km;
    sample.sun_elevation_deg = sun_elevation_deg;
    const double margin_deg = kHorizonMargin * kDegreesPerRadian;
    sample.above_horizon_deg = angles.above_horizon < 0
                                   ? std::min(angles.above_horizon, -margin_deg)
                                   : std::max(angles.above_horizon, margin_deg);
    sample.azimuth_deg = std::clamp(angles.azimuth, 0.0, 180.0);
    sample.sun = sun_at_elevation(sun_elevation_deg / kDegreesPerRadian);
    const double elevation = sample.above_horizon_deg / kDegreesPerRadian - camera.dip();
    sample.direction = sky_direction(sample.sun, sine_of(elevation), cosine_of(elevation),
                                     cosine_of(sample.azimuth_deg / kDegreesPerRadian));
    return sample;
}

}  // namespace

SkySample sky_sample(const Shell& shell, double altitude_km, double sun_elevation_deg,
                     double above_horizon_deg, double azimuth_deg) {
    return sample_at(SkyViewCamera(shell, altitude_km), altitude_km, sun_elevation_deg,
                     {above_horizon_deg, azimuth_deg});
}

std::vector<SkySample> sky_samples(const Shell& shell, double altitude_km,
                                   double sun_elevation_deg) {
    const SkyViewCamera camera(shell, altitude_km);
    return mapped<SkySample>(angles_of(camera, sun_elevation_deg), [&](const Angles& angles) {
        return sample_at(camera, altitude_km, sun_elevation_deg, angles);
    });
}

std::vector<SkySample> sky_samples(const Shell& shell, const std::vector<double>& altitudes_km,
                                   const std::vector<double>& sun_elevations_deg, int stride) {
    std::vector<SkySample> samples;
    std::size_t first = 0;
    const auto step = static_cast<std::size_t>(stride);
    for (const double altitude_km : altitudes_km) {
        for (const double elevation_deg : sun_elevations_deg) {
            const std::vector<SkySample> all = sky_samples(shell, altitude_km, elevation_deg);
            for (std::size_t i = first++ % step; i < all.size(); i += step) {
                samples.push_back(all[i]);
            }
        }
    }
    return samples;
}

std::vector<LevelSample> level_samples(const Shell& shell) {
    constexpr double kAltitudeShares[] = {0, 0.02, 0.1};
    constexpr double kSuns_deg[] = {88, 72, 55, 40, 28, 18, 11, 6, 3, 1, -0.5, -2, -3.5, -5};
    std::vector<LevelSample> samples;
    for (const double share : kAltitudeShares) {
        for (const double sun : kSuns_deg) {
            // No altitude has the suns of another.
            const double elevation_deg = sun + 0.8 * spread(samples.size(), kFirstStep);
            samples.push_back({share * shell.thickness_km, elevation_deg,
                               sun_at_elevation(elevation_deg / kDegreesPerRadian)});
        }
    }
    return samples;
}

std::vector<Place> irradiance_probes_at(const std::vector<LevelSample>& samples) {
    return mapped<Place>(samples, [&](const LevelSample& sample) {
        return Place{{"altitude_km", sample.altitude_km}, {"sun_cos_zenith", sample.sun.cosine}};
    });
}

std::vector<Place> places_of(const std::vector<SkySample>& samples) {
    return mapped<Place>(samples, [&](const SkySample& sample) {
        return Place{{"altitude_km", sample.altitude_km},
                     {"sun_elevation_deg", sample.sun_elevation_deg},
                     {"above_horizon_deg", sample.above_horizon_deg},
                     {"azimuth_deg", sample.azimuth_deg}};
    });
}

std::vector<Place> places_of(const std::vector<LevelSample>& samples) {
    return mapped<Place>(samples, [&](const LevelSample& sample) {
        return Place{{"altitude_km", sample.altitude_km},
                     {"sun_elevation_deg", sample.sun_elevation_deg}};
    });
}

}  // namespace skybake
