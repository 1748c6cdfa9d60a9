// Tests the path tracer's views: part of a ray, the air from space, and a level surface.
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/light/sky_irradiance.h"
#include "bakers/light/sky_radiance.h"
#include "tests/path_tracer/path_media.h"

namespace skybake::test {
namespace {

// The light of a ray's first part, and that of the rest from where the part ends, dimmed on its way,
// add up to that of the whole ray. The parts of falling rays end before their lowest point, behind
// it, and before they reach the ground.
TEST(PathViews, PartsOfRaysAddUp) {
    const SkyMedium medium = preset_sky("earth_hillaire");
    const PathMedium path_medium(medium);
    const Shell shell = shell_of(medium.air);
    const SkyIntegrator integrator(medium, nullptr);
    Agreement agreement;
    std::uint32_t ray = 0;
    for (const auto& [zenith, length_km] :
         {std::pair{30.0, 2.0}, {88.0, 60.0}, {92.0, 80.0}, {92.0, 400.0}, {130.0, 9.0}}) {
        const View view = view_at(10, 65, zenith, 40);
        PathTracerSettings settings = paths(40000, ++ray);
        settings.include_seen_ground = false;
        const PathTracedRadiance whole = trace(path_medium, view, settings, 2);
        settings.length_km = length_km;
        settings.ray += 100;
        const PathTracedRadiance part = trace(path_medium, view, settings, 2);
        const SkyRay line = sky_ray(shell, view.altitude_km, view.sun, view.direction);
        const Spectrum passing = integrator.up_to(line, {length_km}).front().transmittance;

        View rest = view;
        rest.altitude_km = altitude_along_km(shell, line.altitude_km, line.s_km, length_km);
        const double r = shell.ground_radius_km + rest.altitude_km;
        const double sun_cosine = (line.sun_s_km + length_km * line.cosine_to_sun) / r;
        rest.sun = {sun_cosine, std::sqrt((1 - sun_cosine) * (1 + sun_cosine))};
        rest.direction.mu = (line.s_km + length_km) / r;
        settings.length_km = std::numeric_limits<double>::infinity();
        settings.ray += 100;
        const PathTracedRadiance behind = trace(path_medium, rest, settings, 2);
        for (std::size_t c = 0; c < 3; ++c) {
            agreement.add(
                whole.radiance[c], whole.standard_error[c],
                part.radiance[c] + passing[c] * behind.radiance[c],
                std::hypot(part.standard_error[c], passing[c] * behind.standard_error[c]));
            EXPECT_LT(part.radiance[c], whole.radiance[c]) << zenith << ' ' << length_km;
        }
    }
    EXPECT_LT(agreement.mean(), 2);
    EXPECT_LT(agreement.largest, 4);
}

// A part that is longer than the ray is the ray: the same paths, the same bits.
TEST(PathViews, ALongPartIsTheWholeRay) {
    const SkyMedium medium = preset_sky("earth_hillaire");
    const PathMedium path_medium(medium);
    for (const double zenith : {20.0, 91.0, 150.0}) {
        const View view = view_at(3, 50, zenith, 60);
        PathTracerSettings settings = paths(2000);
        const PathTracedRadiance whole = trace(path_medium, view, settings);
        settings.length_km = 1e5;
        const PathTracedRadiance part = trace(path_medium, view, settings);
        EXPECT_EQ(whole.radiance, part.radiance) << zenith;
    }
}

// A camera in space sees what a camera sees where its ray enters the air.
TEST(PathViews, SpaceIsEmpty) {
    const SkyMedium medium = preset_sky("mars_rgb");
    const PathMedium path_medium(medium);
    const Shell shell = shell_of(medium.air);
    const View above = view_at(shell.thickness_km + 500, 70, 125, 30);
    const CameraRay ray = camera_ray(shell, above.altitude_km, above.sun, above.direction);
    ASSERT_GT(ray.in_air.length_km, 0);
    View entry = above;
    entry.altitude_km = shell.thickness_km;
    const double r = shell.ground_radius_km + shell.thickness_km;
    const double sun_cosine = ray.in_air.sun_s_km / r;
    entry.sun = {sun_cosine, std::sqrt((1 - sun_cosine) * (1 + sun_cosine))};
    entry.direction.mu = ray.in_air.s_km / r;
    const PathTracedRadiance from_space = trace(path_medium, above, paths(40000, 1), 2);
    const PathTracedRadiance from_air = trace(path_medium, entry, paths(40000, 2), 2);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(from_space.radiance[c], from_air.radiance[c],
                    4 * std::hypot(from_space.standard_error[c], from_air.standard_error[c]));
    }
    const View beside = view_at(shell.thickness_km + 500, 70, 80, 30);
    EXPECT_EQ(trace(path_medium, beside, paths(100)).radiance, Spectrum{});
}

// The first order of the irradiance by paths is what quadrature over the dome finds.
TEST(PathViews, IrradianceIsTheDomesIntegral) {
    for (const char* preset : {"earth_hillaire", "mars_rgb"}) {
        const SkyLight single(preset_sky(preset), config::SkyOrders::single, nullptr);
        const PathMedium path_medium(single.medium());
        for (const auto& [altitude_km, zenith] : {std::pair{0.0, 50.0}, {4.0, 88.0}}) {
            const SunZenith sun = {cosine_of_degrees(zenith), sine_of_degrees(zenith)};
            const PathTracedRadiance traced =
                trace_irradiance(path_medium, altitude_km, sun, paths(1000000), 2);
            const Spectrum exact =
                sky_irradiances(single, altitude_km, {sun.cosine}, {28, 32, 12}).front();
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(traced.orders[0][c], exact[c], 4 * traced.standard_error[c]) << zenith;
                // By day an error of 1 % is seen, and one of 2 % under any sun.
                EXPECT_LT(traced.standard_error[c], 4e-3 * traced.radiance[c]);
            }
        }
    }
}

}  // namespace
}  // namespace skybake::test
