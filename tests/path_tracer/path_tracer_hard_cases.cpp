// Where path tracing goes wrong, held against identities and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bakers/air/medium.h"
#include "bakers/air/particles/phase_function.h"
#include "bakers/light/path_tracer/air_shells-inl.h"
#include "config/sections/layer.h"
#include "tests/path_tracer/path_media.h"
#include "tests/support/hard_case.h"

namespace skybake {
namespace {

using namespace test;

double worst_furnace(const SkyMedium& medium, std::int64_t count) {
    const PathMedium path_medium(medium);
    double worst = 0;
    std::uint32_t ray = 0;
    for (const double altitude : {0.0, 0.1 * medium.air.thickness_km, medium.air.thickness_km}) {
        for (const double mu : {0.7, -0.02, -0.8}) {
            const PathTracedRadiance radiance =
                trace_ambient_paths(path_medium, altitude, mu, paths(count, ++ray), 1);
            worst = std::max(worst, test::furnace_deviation(radiance, 3));
        }
    }
    return worst;
}

// Radiances that are no numbers, negative or infinite.
double bad_values(const PathTracedRadiance& radiance) {
    double bad = 0;
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        bad += std::isfinite(radiance.radiance[c]) && radiance.radiance[c] >= 0 ? 0 : 1;
        bad += std::isfinite(radiance.standard_error[c]) ? 0 : 1;
        for (const Spectrum& order : radiance.orders) {
            bad += std::isfinite(order[c]) && order[c] >= 0 ? 0 : 1;
        }
    }
    return bad;
}

TEST(PathTracerHardCase, Case06DenseAir) {
    hold("6 50x air over white ground, paths", "white furnace, standard errors",
         worst_furnace(test::white_furnace(50), 1000), kFourDeviations);
    // A path that enters such air has a hundred thousand events.
    const SkyMedium thousand = test::white_furnace(1000);
    hold("6 1000x air over white ground, paths", "white furnace, standard errors",
         test::furnace_deviation(trace_ambient_paths(PathMedium(thousand), 30, -0.5, paths(64), 1),
                                 3),
         kFourDeviations);
    const SkyMedium dense = preset_sky("dense_earth", {"atmosphere.ground_albedo=1"});
    const PathMedium path_medium(dense);
    double bad = 0;
    for (const double sun : {0.0, 80.0, 95.0}) {
        for (const double zenith : {10.0, 89.9, 130.0}) {
            bad += bad_values(trace(path_medium, view_at(1, sun, zenith, 40), paths(1000)));
        }
    }
    hold("6 50x Rayleigh, paths", "finite and not negative (count)", bad, 0);
}

TEST(PathTracerHardCase, Case07WhiteFurnace) {
    hold("7 Earth without absorption, paths", "white furnace, standard errors",
         worst_furnace(test::white_furnace(1), 20000), kFourDeviations);
    hold("7 tiny planet without absorption, paths", "white furnace, standard errors",
         worst_furnace(test::white_furnace(8, "0.8", "tiny_planet"), 5000), kFourDeviations);
}

TEST(PathTracerHardCase, Case08ExtremePhaseFunctions) {
    double worst = 0;
    for (const double g : {0.999, 0.95, 0.0, -0.5, -0.999}) {
        for (const config::Phase kind :
             {config::Phase::henyey_greenstein, config::Phase::cornette_shanks}) {
            const PhaseFunction phase = make_phase_function(kind, g);
            const double mean_cosine = legendre_moments(phase, 1)[1];
            RandomStream random(8, 0, 0);
            constexpr int kSamples = 100000;
            double sum = 0;
            double squares = 0;
            for (int i = 0; i < kSamples; ++i) {
                const double apart = sample_phase(phase, random.next(), random).one_minus;
                sum += apart;
                squares += apart * apart;
            }
            const double mean = sum / kSamples;
            const double error = std::sqrt((squares / kSamples - mean * mean) / kSamples);
            worst = std::max(worst, std::fabs(mean - (1 - mean_cosine)) / error);
        }
    }
    hold("8 g = +-0.999, 0.95, -0.5, 0: sampled mean of 1 - nu", "closed form, standard errors",
         worst, 4);
    hold("8 g = 0.999 in 10x air, paths", "white furnace, standard errors",
         worst_furnace(test::white_furnace(10, "0.999"), 1000), kFourDeviations);
    const SkyMedium peaked = preset_sky("earth_hillaire", {"atmosphere.layers.mie.g=0.999"});
    const PathMedium path_medium(peaked);
    double bad = 0;
    for (const double zenith : {60.0, 60.1, 120.0}) {
        bad += bad_values(trace(path_medium, view_at(0.5, 60, zenith, 0), paths(5000)));
    }
    hold("8 g = 0.999, the view into the sun", "finite and not negative (count)", bad, 0);
}

// Each channel has a phase function of its own, and any of them leads the path.
TEST(PathTracerHardCase, Case08Spheres) {
    const SkyMedium spheres = make_sky_medium(
        test::recipe_of("preset = 'earth_hillaire'\n[particles.dust]\nmaterial = 'constant'\n"
                        "refractive_index = 1.5\neffective_radius = '1 um'\n"
                        "[atmosphere.layers.dust]\nprofile = 'exponential'\n"
                        "scale_height = '2 km'\nphase = { mie = 'dust' }\n"
                        "number_density = '30 /cm3'\n",
                        {"atmosphere.layers.mie.enabled=false",
                         "atmosphere.layers.ozone.enabled=false", "atmosphere.ground_albedo=1"})
            .parameters.atmosphere);
    hold("8 spheres that do not absorb, paths", "white furnace, standard errors",
         worst_furnace(spheres, 5000), kFourDeviations);
}

TEST(PathTracerHardCase, Case09NoAirAndNoScattering) {
    const SkyMedium vacuum = preset_sky("vacuum", {"atmosphere.ground_albedo=0.7"});
    const PathMedium path_medium(vacuum);
    double error = 0;
    for (const bool walked : {false, true}) {
        PathTracerSettings settings = paths(100);
        settings.deterministic_first_order = !walked;
        const PathTracedRadiance sky = trace(path_medium, view_at(3, 60, 30, 0), settings);
        const PathTracedRadiance ground = trace(path_medium, view_at(3, 60, 180, 0), settings);
        for (std::size_t c = 0; c < 3; ++c) {
            error = std::max(error, sky.radiance[c]);
            error =
                std::max(error, std::fabs(ground.radiance[c] / (0.7 * 0.5 / std::numbers::pi) - 1));
            error = std::max(error, ground.radiance[c] - ground.orders[0][c]);
        }
        settings.include_seen_ground = false;
        error = std::max(error, trace(path_medium, view_at(3, 60, 180, 0), settings).radiance[0]);
    }
    hold("9 no air: black sky, ground albedo mu_s / pi, once", "closed form, relative", error,
         1e-13);
    // Ozone alone takes light and gives none.
    const SkyMedium ozone = preset_sky(
        "earth_hillaire", {"atmosphere.layers.rayleigh.enabled=false",
                           "atmosphere.layers.mie.enabled=false", "atmosphere.ground_albedo=1"});
    PathTracerSettings settings = paths(2000);
    settings.include_seen_ground = false;
    const PathTracedRadiance black = trace(PathMedium(ozone), view_at(0.5, 30, 40, 0), settings);
    hold("9 layers that only absorb", "exactly 0",
         black.radiance[0] + black.radiance[1] + black.radiance[2] + bad_values(black), 0);
}

TEST(PathTracerHardCase, Case13SunBelowTheHorizon) {
    const SkyMedium earth = preset_sky("earth_hillaire");
    const PathMedium path_medium(earth);
    const PathTracedRadiance night = trace(path_medium, view_at(0, 140, 30, 0), paths(2000));
    hold("13 midnight, paths", "exactly 0",
         night.radiance[0] + night.radiance[1] + night.radiance[2], 0);
    double bad = 0;
    for (const double sun : {90.0, 96.0, 102.0, 108.0}) {
        bad += bad_values(trace(path_medium, view_at(0, sun, 85, 0), paths(2000)));
    }
    hold("13 twilight, paths", "finite and not negative (count)", bad, 0);
}

TEST(PathTracerHardCase, Case15CameraAtGroundAndTop) {
    const SkyMedium earth = preset_sky("earth_hillaire");
    const PathMedium path_medium(earth);
    PathTracerSettings settings = paths(20000);
    const PathTracedRadiance at = trace(path_medium, view_at(0, 50, 150, 30), settings);
    settings.ray = 1;
    const PathTracedRadiance above = trace(path_medium, view_at(1e-6, 50, 150, 30), settings);
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        worst = std::max(worst, std::fabs(at.radiance[c] - above.radiance[c]) /
                                    std::hypot(at.standard_error[c], above.standard_error[c]));
    }
    hold("15 ground seen from h = 0", "1 mm above, standard errors", worst, 4);
    settings.include_seen_ground = false;
    hold("15 h = 0, downwards, without the ground", "exactly 0",
         trace(path_medium, view_at(0, 50, 150, 30), settings).radiance[1], 0);
    hold("15 h at the top, upwards", "exactly 0",
         trace(path_medium, view_at(100, 50, 40, 30), paths(100)).radiance[1], 0);
}

// In a furnace light that the ground gave twice would make more than 1, and light that it gave in
// the first bounces alone less. Thin air: 1 % of it is scattered.
TEST(PathTracerHardCase, Case19GroundBounceOnceInAllOrders) {
    const SkyMedium thin = test::white_furnace(0.03);
    const PathTracedRadiance radiance =
        trace_ambient_paths(PathMedium(thin), 0, -1, paths(50000), 1);
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        worst = std::max(worst, std::fabs(radiance.radiance[c] - 1));
    }
    hold("19 ground bounces in all orders, thin air", "white furnace", worst, 1e-4);
}

// Distances are drawn from depths themselves, by no majorant. What must hold for every layer is
// that the shells' densities are the layers'.
TEST(PathTracerHardCase, Case20DensitiesOfEveryLayerCombination) {
    const std::array<const char*, 4> layers = {
        "atmosphere.layers.fog={profile=\"slab\", bottom_altitude=\"0 m\", top_altitude=\"1 m\", "
        "scattering=\"0.2 /m\"}",
        "atmosphere.layers.thick={profile=\"exponential\", scale_height=\"300 m\", "
        "scattering=\"1e-3 /m\"}",
        "atmosphere.layers.veil={profile=\"tent\", center_altitude=\"20 km\", half_width=\"50 m\", "
        "scattering=\"1e-3 /m\"}",
        "atmosphere.layers.table={profile=\"tabulated\", table=[[\"3 km\", 0.5], [\"3.001 km\", "
        "1.0], [\"30 km\", 0.0]], scattering=\"1e-4 /m\"}"};
    double worst = 0;
    for (unsigned chosen = 0; chosen < 16; ++chosen) {
        std::vector<std::string> settings;
        for (unsigned k = 0; k < 4; ++k) {
            if (chosen & (1U << k)) settings.emplace_back(layers[k]);
        }
        const SkyMedium medium = preset_sky("earth_hillaire", settings);
        const AirShells air(medium);
        const Spectrum largest = extinction_at(medium.air, 0);
        for (int i = 0; i < 20000; ++i) {
            // Off the levels themselves, where densities jump.
            const double share = (i + 0.4142) / 20000;
            const double altitude = 100 * share * share * share;
            const std::size_t shell = air.shell_at(altitude);
            const Spectrum exact = extinction_at(medium.air, altitude);
            const Spectrum value =
                HWY_NAMESPACE::extinction_at(air.tables(), shell, altitude).spectrum();
            Spectrum sum{};
            for (std::size_t k = 0; k < medium.layers.size(); ++k) {
                const Spectrum unit = full_coefficients(medium.layers[k]).extinction_per_km;
                const double density = HWY_NAMESPACE::density_at(air.tables(), shell, k, altitude);
                sum += density * unit;
            }
            for (std::size_t c = 0; c < 3; ++c) {
                const double scale = exact[c] + 1e-6 * largest[c];
                worst = std::max({worst, std::fabs(value[c] - exact[c]) / scale,
                                  std::fabs(sum[c] - exact[c]) / scale});
            }
        }
    }
    hold("20 densities of 16 layer combinations", "definition on a dense grid, relative", worst,
         1e-6);
}

}  // namespace
}  // namespace skybake
