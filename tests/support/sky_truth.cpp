#include "tests/support/sky_truth.h"

#include <fmt/format.h>

#include <cmath>

#include "bakers/light/path_tracer/path_tracer.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

constexpr std::string_view kColumns =
    "h_km,sun_zenith_deg,view_zenith_deg,azimuth_deg,channel,L1,L2,L3,L4,L5,L6plus,L_total,"
    "stderr_total";

// Exact at 90 and 0 degrees.
double cosine_deg(double angle) { return cosine_of_pi(angle / 180); }
double sine_deg(double angle) { return cosine_of_pi(std::fabs(90 - angle) / 180); }

}  // namespace

std::vector<SkyTruthDirection> sky_truth_directions(double altitude_km,
                                                    const std::vector<double>& suns,
                                                    const std::vector<double>& views,
                                                    const std::vector<double>& azimuths) {
    std::vector<SkyTruthDirection> directions;
    for (const double sun : suns) {
        for (const double view : views) {
            for (const double azimuth : azimuths) {
                if (azimuth > 0 && (sun == 0 || view == 0)) continue;
                directions.push_back({altitude_km, sun, view, azimuth});
            }
        }
    }
    return directions;
}

std::vector<SkyTruthDirection> sky_truth_directions(double altitude_km) {
    return sky_truth_directions(altitude_km, {0, 30, 60, 80, 85, 88, 90, 92, 94, 96},
                                {0, 30, 60, 75, 85, 88, 89.5}, {0, 90, 180});
}

std::vector<SkyTruth> trace_sky_truth(const SkyMedium& medium,
                                      const std::vector<SkyTruthDirection>& directions,
                                      const SkyTruthSettings& settings, int threads) {
    const PathMedium path_medium(medium);
    std::vector<SkyTruth> result;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const SkyTruthDirection& at = directions[i];
        const SunZenith sun = {cosine_deg(at.sun_zenith_degrees), sine_deg(at.sun_zenith_degrees)};
        const SkyDirection view =
            sky_direction(sun, cosine_deg(at.view_zenith_degrees), sine_deg(at.view_zenith_degrees),
                          cosine_deg(at.azimuth_degrees));
        PathTracerSettings path_settings;
        path_settings.seed = settings.seed;
        path_settings.ray = static_cast<std::uint32_t>(i);
        path_settings.paths = settings.paths;
        path_settings.include_seen_ground = false;
        const PathTracedRadiance traced =
            trace_paths(path_medium, at.altitude_km, sun, view, path_settings, threads);
        for (int channel = 0; channel < medium.air.channels; ++channel) {
            const auto c = static_cast<std::size_t>(channel);
            SkyTruth truth{at, channel, {}, traced.radiance[c], traced.standard_error[c]};
            for (std::size_t n = 0; n < kPathOrders; ++n) truth.orders[n] = traced.orders[n][c];
            result.push_back(truth);
        }
    }
    return result;
}

std::string sky_truth_csv(const std::vector<SkyTruth>& values, std::string_view comment) {
    std::string text = fmt::format("# {}\n{}\n", comment, kColumns);
    for (const SkyTruth& value : values) {
        const SkyTruthDirection& at = value.direction;
        text += fmt::format("{},{},{},{},{}", at.altitude_km, at.sun_zenith_degrees,
                            at.view_zenith_degrees, at.azimuth_degrees, value.channel);
        for (const double order : value.orders) text += fmt::format(",{}", order);
        text += fmt::format(",{},{}\n", value.radiance, value.standard_error);
    }
    return text;
}

}  // namespace skybake
