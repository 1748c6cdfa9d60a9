#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdio>

#include "bakers/air/optical_depth.h"
#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/light/ray_pieces.h"
#include "bakers/light/sky_row.h"
#include "bakers/light/wide_row.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using config::SkyOrders;
using namespace test;

// Rows against the integration of each ray by itself, and the parts of light against the whole.

std::vector<double> azimuths(int count) {
    std::vector<double> cosines;
    for (int i = 0; i < count; ++i) {
        cosines.push_back(count == 1 ? 1 : std::cos(std::numbers::pi * i / (count - 1)));
    }
    return cosines;
}

// The largest difference of a row from its rays, relative to max(ray, 1e-3 of the row's largest).
double error_of_row(const SkyLight& light, const SkyViewCamera& camera, double y,
                    const SunZenith& sun, const std::vector<double>& cosines) {
    const auto ray_at = [&](double cosine) { return camera.ray(y, sun, cosine); };
    const SkyRow row(light.integrator(), light.medium(), light.higher_orders(), ray_at(1),
                     &light.sunlight());
    const std::vector<SkyRadiance> found = row.radiance(ray_at, cosines);
    std::vector<Spectrum> wanted;
    double scale = 0;
    for (const double cosine : cosines) {
        wanted.push_back(light.wanted(light.integrator().radiance(ray_at(cosine))));
        scale = std::max(scale, largest(wanted.back()));
    }
    double error = 0;
    for (std::size_t i = 0; i < cosines.size(); ++i) {
        const Spectrum value = light.wanted(found[i]);
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            const double floor = std::max(wanted[i][c], 1e-3 * scale);
            if (floor > 0) error = std::max(error, std::fabs(value[c] - wanted[i][c]) / floor);
        }
    }
    return error;
}

// Whether a ray comes below six scale heights of the highest layer. Rays are not cut above ten, so
// neither rows nor single rays resolve how the air thins out above in a high shell: from eleven
// scale heights upwards they differed by 16 % of a radiance of 1e-6.
bool comes_down_to_resolved_air(const Medium& air, const SkyRay& ray) {
    const std::vector<double> cuts_km = quadrature_altitudes_km(air);
    if (ray.length_km <= 0 || cuts_km.size() < 4) return true;
    const double lowest_km = altitude_along_km(shell_of(air), ray.altitude_km, ray.s_km,
                                               std::clamp(-ray.s_km, 0.0, ray.length_km));
    return lowest_km < cuts_km[cuts_km.size() - 3];
}

TEST(SkyRow, IsWhatItsRaysAre) {
    for (const char* preset : {"earth_hillaire", "mars_rgb", "tiny_planet", "dense_earth"}) {
        const config::Atmosphere atmosphere = test::preset_atmosphere(preset);
        const TestSky sky(atmosphere, SkyOrders::all);
        for (const double altitude_share : {0.0, 0.02, 1.0, 5.0}) {
            const SkyViewCamera camera(sky.light().shell(),
                                       altitude_share * sky.light().shell().thickness_km);
            for (const double elevation : {90.0, 30.0, 0.0, -3.0, -8.0}) {
                const SunZenith sun = sun_at_elevation(elevation * kDegree);
                for (const double y : {0.0, 0.3, 0.49, 0.5, 0.51, 0.8, 1.0}) {
                    // All the way along the horizon, away from a sun on it, rays to the sun touch
                    // the ground: rounding decides whether they pass.
                    if (elevation == 0 && y == 0.5) continue;
                    EXPECT_LT(error_of_row(sky.light(), camera, y, sun, azimuths(25)), 4e-3)
                        << preset << " altitude " << altitude_share << " sun " << elevation << " y "
                        << y;
                }
            }
        }
    }
}

// Tests what tables of sky views read in place of exact sunlight.
TEST(SkyLight, SunlightIsReadAsItIs) {
    for (const char* preset : {"earth_hillaire", "mars_rgb", "tiny_planet", "dense_earth"}) {
        const TestSky sky(test::preset_atmosphere(preset), SkyOrders::single);
        const Medium& air = sky.light().medium().air;
        const Shell shell = sky.light().shell();
        double largest_error = 0;
        double squares = 0;
        for (const PointRow& point : low_discrepancy_points(4000, 1)) {
            const double altitude_km = point.y * point.y * shell.thickness_km;
            const double r = shell.ground_radius_km + altitude_km;
            const double horizon = -horizon_distance_km(shell, altitude_km);
            const double s_km = horizon + point.x[0] * point.x[0] * (r - horizon);
            const Spectrum exact = exponential(-optical_depth_to_top(air, altitude_km, s_km));
            Spectrum found{};
            sky.light().sunlight().read(altitude_km, &s_km, 1, data(found));
            for (std::size_t c = 0; c < static_cast<std::size_t>(air.channels); ++c) {
                const double error = found[c] - exact[c];
                largest_error = std::max(largest_error, std::fabs(error));
                squares += error * error;
            }
        }
        std::printf("  sunlight of %s: largest error %.1e, root mean square %.1e\n", preset,
                    largest_error, std::sqrt(squares / 12000));
        EXPECT_LT(largest_error, 4e-4) << preset << ": next to the edge of Earth's ozone";
        EXPECT_LT(std::sqrt(squares / 12000), 6e-6) << preset;
    }
}

// The number of pieces that the greatest length of a piece asks for along a ray.
int pieces_of(const Shell& shell, const SkyRay& ray, double from_km, double to_km) {
    const double longest =
        ray_pieces::longest_piece_km(shell, ray.altitude_km, ray.s_km, from_km, to_km);
    if (to_km - from_km <= longest) return 1;
    const double middle = 0.5 * (from_km + to_km);
    return pieces_of(shell, ray, from_km, middle) + pieces_of(shell, ray, middle, to_km);
}

// A planet of a metre in air of a hundred metres.
TEST(SkyRow, IsWhatItsRaysAreInAirManyRadiiDeep) {
    const TestSky sky(test::preset_atmosphere(
                          "earth_hillaire",
                          {"atmosphere.ground_radius=\"1 m\"", "atmosphere.top_radius=\"101 m\"",
                           "atmosphere.layers.rayleigh.scale_height=\"10 m\"",
                           "atmosphere.layers.mie.scale_height=\"30 m\""}),
                      SkyOrders::all);
    const Shell shell = sky.light().shell();
    for (const double altitude_km : {0.0, 0.5e-3, 20e-3}) {
        const SkyViewCamera camera(shell, altitude_km);
        for (const double elevation : {90.0, 30.0, 3.0}) {
            const SunZenith sun = sun_at_elevation(elevation * kDegree);
            for (const double y : {0.0, 0.3, 0.51, 0.8, 1.0}) {
                EXPECT_LT(error_of_row(sky.light(), camera, y, sun, azimuths(9)), 4e-3)
                    << altitude_km << " sun " << elevation << " y " << y;
                const SkyRay ray = camera.ray(y, sun, 1);
                EXPECT_LT(pieces_of(shell, ray, 0, ray.length_km), 1500) << altitude_km << ' ' << y;
            }
        }
    }
}

// In air that is less deep than the planet is large, pieces are as long everywhere.
TEST(SkyRow, PiecesAreTheSameAroundPlanetsWithThinAir) {
    const Shell shell{6360, 6360};
    for (const double s_km : {-8000.0, -300.0, 0.0, 9000.0}) {
        EXPECT_EQ(ray_pieces::longest_piece_km(shell, 3000, s_km, 10, 200), 6360.0 / 48);
    }
    EXPECT_GT(ray_pieces::longest_piece_km({1, 100}, 50, 51, 0, 1), 0.5);
}

RC_GTEST_PROP(SkyRow, IsWhatItsRaysAreInAnyAtmosphere, ()) {
    const TestSky sky(test::random_atmosphere(), SkyOrders::all);
    const SkyViewCamera camera(sky.light().shell(),
                               uniform(0, 1.2) * sky.light().shell().thickness_km);
    // By day: at dusk rows are held to their rays in the presets above, and not yet in any air.
    const SunZenith sun = sun_at_elevation(uniform(5, 90) * kDegree);
    const double y = uniform(0, 1);
    RC_PRE(comes_down_to_resolved_air(sky.light().medium().air, camera.ray(y, sun, 1)));
    RC_ASSERT(error_of_row(sky.light(), camera, y, sun, azimuths(20)) < 2e-2);
}

TEST(SkyRow, HasTheSameLightFromAllSidesUnderASunAtTheZenith) {
    const SkyViewCamera camera(earth().light().shell(), 0.5);
    const SunZenith sun = sun_at_elevation(90 * kDegree);
    const auto ray_at = [&](double cosine) { return camera.ray(0.7, sun, cosine); };
    const SkyRow row(earth().light().integrator(), earth().light().medium(),
                     earth().light().higher_orders(), ray_at(1), &earth().light().sunlight());
    const std::vector<SkyRadiance> radiance = row.radiance(ray_at, azimuths(24));
    for (const SkyRadiance& value : radiance) {
        EXPECT_NEAR(value.total()[2], radiance[0].total()[2], 1e-13);
    }
}

// Single scattering by one layer, by the others, and the rest are all the light there is.
RC_GTEST_PROP(SkyRow, PartsOfTheLightAddUp, ()) {
    config::Atmosphere atmosphere = test::random_atmosphere();
    atmosphere.layers.push_back(atmosphere.layers.front());
    atmosphere.layers.back().name = "z";
    std::vector<std::string> others;
    for (const config::Layer& layer : atmosphere.layers) {
        if (layer.name != "z") others.push_back(layer.name);
    }
    const TestSky all(atmosphere, SkyOrders::all);
    const TestSky rest(atmosphere, SkyOrders::multiple);
    const TestSky one(atmosphere, SkyOrders::single, {"z"});
    const TestSky remaining(atmosphere, SkyOrders::single, others);
    const SkyViewCamera camera(all.light().shell(),
                               uniform(0, 1) * all.light().shell().thickness_km);
    const SunZenith sun = sun_at_elevation(uniform(-20, 90) * kDegree);
    const double y = uniform(0, 1);
    const TransmittanceField& sunlight = all.light().sunlight();  // the air of all four
    const auto of = [&](const TestSky& sky) {
        const auto ray_at = [&](double cosine) { return camera.ray(y, sun, cosine); };
        const SkyRow row(sky.light().integrator(), sky.light().medium(),
                         sky.light().higher_orders(), ray_at(1), &sunlight);
        return sky.light().wanted(row.radiance(ray_at, {0.3}).front());
    };
    const Spectrum whole = of(all);
    const Spectrum sum_rest = of(rest);
    const Spectrum sum_one = of(one);
    const Spectrum sum_remaining = of(remaining);
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        const double sum = sum_rest[c] + sum_one[c] + sum_remaining[c];
        RC_ASSERT(std::fabs(sum - whole[c]) <= 1e-12 * whole[c]);
    }
}

TEST(SkyIntegrator, AddsUpAlongARay) {
    const SunZenith sun = sun_at_elevation(3 * kDegree);
    const SkyRay ray = SkyViewCamera(earth().light().shell(), 2).ray(0.55, sun, 0.9);
    const SkyIntegrator& integrator = earth().light().integrator();
    const double half = ray.length_km / 2;
    const auto parts = integrator.up_to(ray, {0, half, half, ray.length_km});
    EXPECT_EQ(parts[0].single[0], 0);
    EXPECT_EQ(parts[0].transmittance[0], 1);
    EXPECT_EQ(parts[1].single, parts[2].single);
    const SkyRadiance whole = integrator.radiance(ray);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(parts[3].single[c] / whole.single[c], 1, 1e-4);
        EXPECT_NEAR(parts[3].transmittance[c] / whole.transmittance[c], 1, 1e-12);
    }
}

// Rows of many azimuths against the same rows at each of them.

// The largest difference of the parts of a wide row from those of the row itself, relative to
// max(light, 1e-3 of the row's largest).
double error_of(const SkyLight& light, const SkyViewCamera& camera, double y, const SunZenith& sun,
                const std::vector<double>& azimuths) {
    const RowOfView view(camera, y, sun);
    const SkyRow row(light.integrator(), light.medium(), light.higher_orders(), view.ray(1),
                     &light.sunlight());
    std::vector<double> cosines;
    for (const double azimuth : azimuths) cosines.push_back(cosine_of_pi(azimuth));
    const auto wanted =
        row.radiance([&](double cosine) { return camera.ray(y, sun, cosine); }, cosines);
    const auto found = wide_radiance(row, light.medium(), view, azimuths);
    double scale = 0;
    for (const SkyRadiance& radiance : wanted) scale = std::max(scale, largest(radiance.total()));
    double error = 0;
    for (std::size_t i = 0; i < azimuths.size(); ++i) {
        const Spectrum parts[][2] = {{found[i].single, wanted[i].single},
                                     {found[i].multiple, wanted[i].multiple},
                                     {found[i].ground, wanted[i].ground}};
        EXPECT_EQ(found[i].transmittance, wanted[i].transmittance);
        for (const auto& [value, exact] : parts) {
            for (std::size_t c = 0; c < kMaxChannels; ++c) {
                const double floor = std::max(wanted[i].total()[c], 1e-3 * scale);
                if (floor > 0) error = std::max(error, std::fabs(value[c] - exact[c]) / floor);
            }
        }
    }
    return error;
}

TEST(WideRow, IsTheRow) {
    std::vector<double> azimuths;
    for (int i = 0; i < 300; ++i) azimuths.push_back((i + 0.5) / 300);
    for (const char* preset : {"earth_hillaire", "mars_rgb", "tiny_planet", "dense_earth"}) {
        const TestSky sky(test::preset_atmosphere(preset), SkyOrders::all);
        double largest_error = 0;
        for (const double altitude_share : {0.0, 0.02, 5.0}) {
            const SkyViewCamera camera(sky.light().shell(),
                                       altitude_share * sky.light().shell().thickness_km);
            for (const double elevation : {90.0, 30.0, 2.0, 0.0, -4.0}) {
                const SunZenith sun = sun_at_elevation(elevation * kDegree);
                for (const double y : {0.0, 0.3, 0.49, 0.51, 0.8, 1.0}) {
                    const double error = error_of(sky.light(), camera, y, sun, azimuths);
                    EXPECT_LT(error, 2e-5) << preset << " altitude " << altitude_share << " sun "
                                           << elevation << " y " << y;
                    largest_error = std::max(largest_error, error);
                }
            }
        }
        std::printf("  %s: largest error %.1e\n", preset, largest_error);
    }
}

RC_GTEST_PROP(WideRow, IsTheRowInAnyAir, ()) {
    const TestSky sky(test::random_atmosphere(), SkyOrders::all);
    const SkyViewCamera camera(sky.light().shell(),
                               uniform(0, 1.2) * sky.light().shell().thickness_km);
    const SunZenith sun = sun_at_elevation(uniform(-20, 90) * kDegree);
    std::vector<double> azimuths;
    const int count = *rc::gen::inRange(1, 90);
    for (int i = 0; i < count; ++i) azimuths.push_back(uniform(0, 1));
    RC_ASSERT(error_of(sky.light(), camera, camera.off_the_edges(uniform(0, 1)), sun, azimuths) <
              2e-5);
}

// Any order, the same azimuth more than once, and both ends.
TEST(WideRow, TakesAnyAzimuths) {
    const SkyViewCamera camera(earth().light().shell(), 1);
    const SunZenith sun = sun_at_elevation(10 * kDegree);
    std::vector<double> azimuths = {1, 0, 0.5, 0.5, 1};
    EXPECT_LT(error_of(earth().light(), camera, 0.7, sun, azimuths), 1e-12);
    for (int i = 0; i < 100; ++i) azimuths.push_back(std::fmod(0.618034 * i, 1));
    for (int i = 0; i < 50; ++i) azimuths.push_back(azimuths[static_cast<std::size_t>(7 * i % 60)]);
    EXPECT_LT(error_of(earth().light(), camera, 0.7, sun, azimuths), 2e-5);
    EXPECT_EQ(error_of(earth().light(), camera, 0.7, sun, {}), 0);
}

}  // namespace
}  // namespace skybake
