// Media and views that tests of the path tracer share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bakers/light/path_tracer/path_tracer.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/math/transcendental.h"
#include "tests/support/atmospheres.h"
#include "tests/support/number_rows.h"
#include "tests/support/sky_truth.h"

namespace skybake::test {

// Earth's Rayleigh and Mie layers alone, without absorption, over white ground; coefficients are
// multiplied by `factor`.
inline SkyMedium white_furnace(double factor, const std::string& mie_g = "0.8",
                               const std::string& planet = "earth_hillaire") {
    const auto per_meter = [&](double value) {
        return "\"" + std::to_string(value * factor * 1e6) + "e-6 /m\"";
    };
    const std::string rayleigh =
        "[" + per_meter(5.802e-6) + ", " + per_meter(13.558e-6) + ", " + per_meter(33.1e-6) + "]";
    const std::string mie = per_meter(3.996e-6);
    std::vector<std::string> settings = {
        "atmosphere.ground_albedo=1", "atmosphere.layers.rayleigh.scattering=" + rayleigh,
        "atmosphere.layers.mie.scattering=" + mie, "atmosphere.layers.mie.extinction=" + mie,
        "atmosphere.layers.mie.g=" + mie_g};
    if (planet == "earth_hillaire") settings.push_back("atmosphere.layers.ozone.enabled=false");
    return preset_sky(planet, settings);
}

inline double cosine_of_degrees(double angle) { return cosine_of_pi(angle / 180); }
inline double sine_of_degrees(double angle) { return cosine_of_pi(std::fabs(90 - angle) / 180); }

struct View {
    double altitude_km = 0;
    SunZenith sun;
    SkyDirection direction;
};

inline View view_at(double altitude_km, double sun_zenith, double view_zenith, double azimuth) {
    View view;
    view.altitude_km = altitude_km;
    view.sun = {cosine_of_degrees(sun_zenith), sine_of_degrees(sun_zenith)};
    view.direction = sky_direction(view.sun, cosine_of_degrees(view_zenith),
                                   sine_of_degrees(view_zenith), cosine_of_degrees(azimuth));
    return view;
}

inline PathTracedRadiance trace(const PathMedium& path_medium, const View& view,
                                const PathTracerSettings& settings, int threads = 1) {
    return trace_paths(path_medium, view.altitude_km, view.sun, view.direction, settings, threads);
}

inline PathTracerSettings paths(std::int64_t count, std::uint32_t ray = 0) {
    PathTracerSettings settings;
    settings.seed = 20;
    settings.ray = ray;
    settings.paths = count;
    return settings;
}

// Standard errors come from 16 replicates: this many of them are as improbable as four of a normal
// distribution whose width is known (Student's t with 15 degrees of freedom, 6e-5).
inline constexpr double kFourDeviations = 5.47;

// The largest |a - 1| in standard errors; an error too small to be seen counts as rounding of 1e-9.
inline double furnace_deviation(const PathTracedRadiance& radiance, int channels) {
    double worst = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
        const double error = std::fabs(radiance.radiance[c] - 1);
        worst = std::max(worst, error / (radiance.standard_error[c] + 1e-9));
    }
    return worst;
}

// Differences in standard errors, summed up: chi-square and the largest.
struct Agreement {
    double chi_square = 0;
    double largest = 0;
    int count = 0;

    void add(double a, double error_a, double b, double error_b) {
        const double error = std::hypot(error_a, error_b);
        if (a == b) return;  // both dark
        const double z = (a - b) / error;
        chi_square += z * z;
        largest = std::max(largest, std::fabs(z));
        ++count;
    }
    double mean() const { return chi_square / count; }
};

// A file of sky_truth_csv's, as tests/data has them.
inline std::vector<SkyTruth> sky_truth_of(const std::string& path) {
    std::vector<SkyTruth> truths;
    for (const std::vector<double>& row : number_rows(path)) {
        EXPECT_EQ(row.size(), 13U) << path;
        truths.push_back({{row.at(0), row.at(1), row.at(2), row.at(3)},
                          static_cast<int>(row.at(4)),
                          {},
                          row.at(11),
                          row.at(12)});
        std::copy_n(row.begin() + 5, kPathOrders, truths.back().orders.begin());
    }
    return truths;
}

// The relative errors of a sky without its ground against traced values, under suns from `from` to `to`
// degrees from the zenith, ascending.
class SkyErrors {
  public:
    SkyErrors(const SkyIntegrator& integrator, const std::vector<SkyTruth>& truth, double from,
              double to) {
        for (const auto& [at, channel, orders, radiance, standard_error] : truth) {
            if (at.sun_zenith_degrees < from || at.sun_zenith_degrees > to) continue;
            const View view = view_at(at.altitude_km, at.sun_zenith_degrees, at.view_zenith_degrees,
                                      at.azimuth_degrees);
            const SkyRadiance sky = integrator.radiance(at.altitude_km, view.sun, view.direction);
            const auto c = static_cast<std::size_t>(channel);
            all_.push_back(std::fabs((sky.single[c] + sky.multiple[c]) / radiance - 1));
        }
        std::sort(all_.begin(), all_.end());
    }
    double median() const { return all_.at(all_.size() / 2); }
    double ninth_decile() const { return all_.at(all_.size() * 9 / 10); }
    double largest() const { return all_.back(); }

  private:
    std::vector<double> all_;
};

}  // namespace skybake::test
