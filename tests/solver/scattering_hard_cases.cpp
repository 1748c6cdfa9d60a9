// Where all orders of scattering go wrong, held against energy, limits and invariances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/solver/energy_balance.h"
#include "bakers/light/solver/solve_light.h"
#include "tests/light/sky_media.h"
#include "tests/path_tracer/path_media.h"
#include "tests/support/hard_case.h"

namespace skybake {
namespace {

using test::hold;

SkyMedium rayleigh_times(double factor, const std::vector<std::string>& settings = {}) {
    config::Atmosphere atmosphere = test::preset_atmosphere("earth_hillaire", settings);
    for (config::Layer& layer : atmosphere.layers) {
        if (layer.name != "rayleigh") continue;
        for (config::InverseLength& value : layer.scattering) value.per_meter *= factor;
        layer.extinction = layer.scattering;
    }
    return make_sky_medium(atmosphere);
}

double count_bad(const SolvedLight& light) {
    double bad = 0;
    for (int level = 0; level < light.light.levels; ++level) {
        for (int sun = 0; sun < light.light.suns; ++sun) {
            const double* at = light.light.at(level, sun);
            for (std::size_t c = 0; c < 3; ++c) bad += std::isfinite(at[c]) && at[c] >= 0 ? 0 : 1;
        }
    }
    return bad;
}

// Radiance from 2 km, all that comes through the air.
Spectrum radiance(const SkyMedium& medium, const SolvedLight& light, double sun_degrees,
                  double view_degrees, double azimuth_degrees, double altitude_km = 2) {
    const SolvedOrders orders(medium, light, light.degree());
    const SkyIntegrator integrator(medium, &orders);
    const test::View view = test::view_at(altitude_km, sun_degrees, view_degrees, azimuth_degrees);
    return integrator.radiance(altitude_km, view.sun, view.direction).total();
}

// The largest relative error of a channel.
double largest_error(const Spectrum& found, const Spectrum& wanted) {
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::fabs(found[c] / wanted[c] - 1));
    return worst;
}

void hold_energy(const std::string& name, const SkyMedium& medium, double bound,
                 const SolverSettings& settings = {}) {
    const SolvedLight light = solve_light(medium, settings, 0);
    hold(name, "energy in = out + absorbed, share of in",
         energy_balance(medium, light).largest_error(), bound);
    hold(name, "finite and not negative (count)", count_bad(light), 0);
}

TEST(ScatteringHardCase, Case06DenseAir) {
    hold_energy("6 10x Rayleigh, all orders", rayleigh_times(10), 1e-2);
    hold_energy("6 50x Rayleigh, all orders", rayleigh_times(50), 2e-2);
}

TEST(ScatteringHardCase, Case07NothingAbsorbs) {
    const std::vector<std::string> white = {"atmosphere.layers.mie.enabled=false",
                                            "atmosphere.layers.ozone.enabled=false",
                                            "atmosphere.ground_albedo=1"};
    hold_energy("7 albedo 1, conservative air", rayleigh_times(1, white), 1e-2);
    hold_energy("7 albedo 1, conservative air 10x", rayleigh_times(10, white), 1e-2);
}

TEST(ScatteringHardCase, Case08Peaks) {
    for (const char* g : {"0.999", "0.95", "0", "-0.9"}) {
        const SkyMedium medium =
            test::preset_sky("earth_hillaire", {std::string("atmosphere.layers.mie.g=") + g});
        hold_energy(std::string("8 Cornette-Shanks g = ") + g, medium,
                    g == std::string("0.999") ? 3e-2 : 1e-2);
    }
}

TEST(ScatteringHardCase, Case08Spheres) {
    for (const char* kind : {"haze", "fog", "cloud"}) {
        const std::string number = kind == std::string("haze") ? "5e4 /cm3" : "2 /cm3";
        const SkyMedium medium =
            make_sky_medium(test::earth_with_drops("", number, kind).parameters.atmosphere);
        hold_energy(std::string("8 spheres of ") + kind, medium, 1e-2);
    }
}

TEST(ScatteringHardCase, Case09And10NothingAndThinLayers) {
    const SkyMedium nothing = test::preset_sky("vacuum");
    hold("9 no layers at all", "finite and not negative (count)",
         count_bad(solve_light(nothing, {}, 0)), 0);
    const SkyMedium fog =
        test::preset_sky("earth_hillaire", {"atmosphere.layers.fog.profile=\"slab\"",
                                            "atmosphere.layers.fog.bottom_altitude=\"200 m\"",
                                            "atmosphere.layers.fog.top_altitude=\"201 m\"",
                                            "atmosphere.layers.fog.scattering=\"0.3 /m\"",
                                            "atmosphere.layers.fog.phase=\"isotropic\""});
    hold_energy("10 1 m of fog", fog, 1e-2);
}

TEST(ScatteringHardCase, Case11And12Planets) {
    hold_energy("11 tiny planet", test::preset_sky("tiny_planet"), 1e-2);
    // The same air over ever larger planets: the sky no longer changes.
    const auto sky = [](const char* ground, const char* top) {
        const SkyMedium medium = test::preset_sky(
            "earth_hillaire", {std::string("atmosphere.ground_radius=\"") + ground + "\"",
                               std::string("atmosphere.top_radius=\"") + top + "\""});
        return radiance(medium, solve_light(medium, {}, 0), 50, 40, 60);
    };
    const Spectrum large = sky("63600 km", "63700 km");
    const Spectrum huge = sky("6360000 km", "6360100 km");
    hold("12 huge planet", "its plane-parallel limit, relative", largest_error(large, huge), 3e-3);
}

TEST(ScatteringHardCase, Case13SunBelowTheHorizon) {
    const SkyMedium medium = test::preset_sky("earth_hillaire");
    const SolvedLight light = solve_light(medium, {}, 0);
    double rises = 0;
    Spectrum last(std::numeric_limits<double>::infinity());
    for (double zenith = 86; zenith <= 108; zenith += 0.5) {
        const Spectrum value = radiance(medium, light, zenith, 0, 0);
        for (std::size_t c = 0; c < 3; ++c) rises += value[c] < last[c] && value[c] >= 0 ? 0 : 1;
        last = value;
    }
    hold("13 sun from 86 to 108 degrees, zenith sky", "falls, never negative (count)", rises, 0);
    hold("13 sun at 108 degrees", "share of its noon", last[2], 1e-7);
}

TEST(ScatteringHardCase, Case14Azimuths) {
    const SkyMedium medium = test::preset_sky("earth_hillaire");
    const SolvedLight light = solve_light(medium, {}, 0);
    double worst = 0;
    for (const double azimuth : {0.0, 33.0, 90.0, 180.0}) {
        for (const auto& [sun, view] : {std::pair{0, 60}, {60, 0}}) {
            worst = std::max(worst, largest_error(radiance(medium, light, sun, view, azimuth),
                                                  radiance(medium, light, sun, view, 57)));
        }
    }
    hold("14 sun or view straight up", "any azimuth, relative", worst, 1e-6);
    const Spectrum into_sun = radiance(medium, light, 45, 45, 0);
    const Spectrum away = radiance(medium, light, 45, 135, 180);
    double bad = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        bad += std::isfinite(into_sun[c]) && std::isfinite(away[c]) ? 0 : 1;
    }
    hold("14 view = sun, and away from it", "finite (count)", bad, 0);
}

TEST(ScatteringHardCase, Case15CamerasAtTheEnds) {
    const SkyMedium medium = test::preset_sky("earth_hillaire");
    const SolvedLight light = solve_light(medium, {}, 0);
    double worst = 0;
    for (const double sun : {20.0, 89.0, 94.0}) {
        for (const auto& [view, end, beside] :
             {std::array{70., 0., 1e-5}, {120., 100., 100 - 1e-5}}) {
            worst = std::max(worst, largest_error(radiance(medium, light, sun, view, 40, end),
                                                  radiance(medium, light, sun, view, 40, beside)));
        }
    }
    hold("15 cameras on the ground and at the top", "a centimetre off, relative", worst, 1e-4);
}

TEST(ScatteringHardCase, Case18And19OrdersAndGround) {
    // The solver leaves out as little as it says.
    const SkyMedium medium = rayleigh_times(10);
    SolverSettings settings;
    settings.degree = 2;
    const SolvedLight light = solve_light(medium, settings, 0);
    settings.tolerance = 1e-6;
    const SolvedLight more = solve_light(medium, settings, 0);
    double worst = 0;
    double ground = 0;
    for (const double sun : {0.0, 60.0, 89.0, 95.0}) {
        const double cosine = std::cos(sun * test::kDegree);
        worst = std::max(worst, largest_error(light.mean_radiance_at(1, cosine),
                                              more.mean_radiance_at(1, cosine)));
    }
    hold("18 orders left out, 10x Rayleigh", "1e-6 left out, over what it says",
         worst / light.left_out, 1);
    // L(A) = L(0) + A X / (1 - A s) at every point: three albedos tell the fourth.
    double mean[4];
    const double albedos[4] = {0, 0.3, 0.6, 0.9};
    for (int i = 0; i < 4; ++i) {
        const SkyMedium lit = test::preset_sky(
            "earth_hillaire", {"atmosphere.ground_albedo=" + std::to_string(albedos[i])});
        SolverSettings fine;
        fine.degree = 2;
        fine.tolerance = 1e-6;
        // A sun at the zenith of a point lights its ground alike for a long way around.
        mean[i] = solve_light(lit, fine, 0).mean_radiance_at(0, 0.9)[2];
    }
    const double first = (mean[1] - mean[0]) / albedos[1];
    const double second = (mean[2] - mean[0]) / albedos[2];
    // 1 / first = (1 - a s) / X.
    const double slope = (1 / first - 1 / second) / (albedos[2] - albedos[1]);
    const double expected = mean[0] + albedos[3] / (1 / first - slope * (albedos[3] - albedos[1]));
    ground = std::fabs(mean[3] / expected - 1);
    hold("19 the ground's light of all orders", "its geometric series, relative", ground, 1e-3);
}

}  // namespace
}  // namespace skybake
