#include "bakers/assets/multiple_scattering/sky_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

constexpr double kSunZenithDegrees[] = {0, 30, 60, 80, 88, 92, 94, 96};
constexpr double kViewZenithDegrees[] = {15, 60, 85, 89.5};
constexpr double kAzimuthDegrees[] = {10, 75, 160};
constexpr double kCameraShare = 0.005;  // of the shell's thickness: 500 m on Earth

SunZenith sun_at(double zenith_degrees) {
    return {cosine_of_turns(zenith_degrees / 360), cosine_of_turns(zenith_degrees / 360 - 0.25)};
}

}  // namespace

std::vector<SkySample> sky_samples(const Shell& shell, const std::optional<config::Scene>& scene) {
    double altitude_km = kCameraShare * shell.thickness_km;
    std::vector<double> suns(std::begin(kSunZenithDegrees), std::end(kSunZenithDegrees));
    if (scene) {
        altitude_km = std::min(std::clamp(altitude_km, scene->altitude[0].kilometers(),
                                          scene->altitude[1].kilometers()),
                               shell.thickness_km);
        const double degrees = 180 / std::numbers::pi;
        const double highest = 90 - scene->sun_elevation[1].radians * degrees;
        const double lowest = 90 - scene->sun_elevation[0].radians * degrees;
        std::erase_if(suns, [&](double zenith) { return zenith < highest || zenith > lowest; });
        suns.insert(suns.end(), {highest, lowest});
    }
    std::vector<SkySample> samples;
    for (const double sun_zenith : suns) {
        for (const double view_zenith : kViewZenithDegrees) {
            for (const double azimuth : kAzimuthDegrees) {
                const SunZenith sun = sun_at(sun_zenith);
                const SunZenith view = sun_at(view_zenith);
                samples.push_back(
                    {kCameraShare * shell.thickness_km, sun,
                     sky_direction(sun, view.cosine, view.sine, cosine_of_turns(azimuth / 360))});
            }
        }
    }
    return samples;
}

std::vector<Spectrum> sky_values(const SkyMedium& medium, const HigherOrders& higher_orders,
                                 const std::vector<SkySample>& samples, int threads) {
    const SkyIntegrator integrator(medium, &higher_orders);
    std::vector<Spectrum> values(samples.size());
    parallel_for(static_cast<int>(samples.size()), threads, [&](int i) {
        const SkySample& sample = samples[static_cast<std::size_t>(i)];
        const SkyRadiance radiance =
            integrator.radiance(sample.altitude_km, sample.sun, sample.direction);
        values[static_cast<std::size_t>(i)] = radiance.single + radiance.multiple;
    });
    return values;
}

SkyError sky_error(int channels, const std::vector<Spectrum>& values,
                   const std::vector<Spectrum>& references) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
            if (!(references[i][c] > 0)) continue;
            errors.push_back(std::fabs(values[i][c] / references[i][c] - 1));
        }
    }
    SkyError error;
    error.points = static_cast<int>(errors.size());
    if (errors.empty()) return error;
    std::sort(errors.begin(), errors.end());
    error.median = errors[errors.size() / 2];
    error.ninth_decile = errors[errors.size() * 9 / 10];
    error.max = errors.back();
    return error;
}

}  // namespace skybake
