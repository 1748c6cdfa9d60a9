#include "bakers/light/path_tracer/air_shells.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "bakers/air/optical_depth.h"
#include "bakers/light/path_tracer/air_shells-inl.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"
#include "tests/path_tracer/path_media.h"

namespace skybake {
namespace {

// An altitude and r mu >= 0, with a preference for the ground and the horizontal.
AirShells::Point point_of(const AirShells& air, int index) {
    const auto u = low_discrepancy_point(index);
    const double x = index % 2 ? u[0] * u[0] * u[0] : u[0];
    const double mu = index % 3 ? u[1] * u[1] : u[1];
    AirShells::Point point;
    point.altitude_km = air.planet().thickness_km * x;
    point.s_km = (air.planet().ground_radius_km + point.altitude_km) * mu;
    point.shell = air.shell_at(point.altitude_km);
    return point;
}

// The largest error of depths against the exact ones, relative to them, or to a millionth of the
// depth of all air.
double worst_depth(const SkyMedium& medium, int points) {
    const AirShells air(medium);
    const Spectrum whole = optical_depth_to_top(medium.air, 0, medium.air.ground_radius_km);
    double worst = 0;
    for (int i = 0; i < points; ++i) {
        const AirShells::Point point = point_of(air, i);
        const Spectrum exact = optical_depth_to_top(medium.air, point.altitude_km, point.s_km);
        const Spectrum value = air.depth_to_top(point);
        for (std::size_t c = 0; c < 3; ++c) {
            const double scale = std::max(exact[c], 1e-6 * whole[c]);
            if (scale > 0) worst = std::max(worst, std::fabs(value[c] - exact[c]) / scale);
        }
    }
    return worst;
}

TEST(AirShells, DepthsAreExact) {
    for (const std::string& preset : test::preset_list()) {
        EXPECT_LT(worst_depth(test::preset_sky(preset), 20000), 2e-7) << preset;
    }
}

TEST(AirShells, DepthsAreExactWhereLayersAreSharp) {
    const SkyMedium fog =
        test::preset_sky("earth_hillaire",
                         {"atmosphere.layers.fog={profile=\"slab\", bottom_altitude=\"0 m\", "
                          "top_altitude=\"1 m\", scattering=\"0.2 /m\"}",
                          "atmosphere.layers.veil={profile=\"slab\", bottom_altitude=\"10 km\", "
                          "top_altitude=\"10.1 km\", scattering=\"1e-2 /m\"}",
                          "atmosphere.layers.table={profile=\"tabulated\", table=[[\"3 km\", 0.5], "
                          "[\"3.001 km\", 1.0], [\"30 km\", 0.0]], scattering=\"1e-4 /m\"}"});
    EXPECT_LT(worst_depth(fog, 50000), 3e-7);
}

// Any exponential layers, a slab and a tent about planets of any size.
RC_GTEST_PROP(AirShellsOfRandomAir, DepthsAreExact, ()) {
    const auto power_of_ten = [](int low, int high) {
        return std::pow(10, *rc::gen::inRange(100 * low, 100 * high) / 100.0);
    };
    const double radius = power_of_ten(2, 5);
    const double thickness = radius * power_of_ten(-3, -1);
    const auto km = [](double x) { return "\"" + std::to_string(x) + " km\""; };
    std::vector<std::string> settings = {"atmosphere.ground_radius=" + km(radius),
                                         "atmosphere.top_radius=" + km(radius + thickness)};
    for (const std::string name : {"first", "second"}) {
        settings.push_back("atmosphere.layers." + name +
                           "={profile=\"exponential\", scattering=\"1e-5 /m\", scale_height=" +
                           km(thickness * power_of_ten(-2, 0)) + "}");
    }
    const double center = thickness * *rc::gen::inRange(1, 1000) / 1000.0;
    settings.push_back(
        "atmosphere.layers.tent={profile=\"tent\", scattering=\"1e-5 /m\", "
        "center_altitude=" +
        km(center) + ", half_width=" + km(thickness * power_of_ten(-2, 0)) + "}");
    const SkyMedium medium = test::preset_sky("vacuum", settings);
    RC_ASSERT(worst_depth(medium, 300) < 1e-6);
}

TEST(AirShells, PointsAreFoundByTheirDepth) {
    for (const char* preset : {"earth_hillaire", "tiny_planet", "dense_earth"}) {
        const SkyMedium medium = test::preset_sky(preset);
        const AirShells air(medium);
        for (int i = 0; i < 5000; ++i) {
            const AirShells::Point start = point_of(air, i);
            const std::size_t channel = static_cast<std::size_t>(i % 3);
            const double share = low_discrepancy_point(i)[2];
            const double depth = share * air.depth_to_top(start)[channel];
            const auto shell = static_cast<double>(start.shell);
            const auto found = HWY_NAMESPACE::point_at_depth<double>(
                air.tables(), {start.altitude_km, start.s_km, shell},
                air.depth_to_top(start)[channel], static_cast<double>(channel), depth, shell,
                static_cast<double>(air.count() - 1));
            EXPECT_GE(found.altitude_km, start.altitude_km - 1e-9);
            EXPECT_NEAR(air.depth_to_top({found.altitude_km, found.s_km,
                                          static_cast<std::size_t>(found.shell)})[channel],
                        depth, 1e-6 * depth + 1e-15);
            // On the same line: r^2 - s^2 is that of the start.
            const double r = medium.air.ground_radius_km;
            const double gain = found.altitude_km - start.altitude_km;
            const double square = gain * (2 * (r + start.altitude_km) + gain);
            EXPECT_NEAR(found.s_km * found.s_km, start.s_km * start.s_km + square, 1e-9 * r * r);
        }
    }
}

TEST(AirShells, SunlightEndsAtTheShadowOfThePlanet) {
    const SkyMedium medium = test::preset_sky("earth_hillaire");
    const AirShells air(medium);
    for (const double altitude : {0.0, 0.001, 1.0, 25.0, 99.9}) {
        const double horizon = horizon_distance_km(air.planet(), altitude);
        const std::size_t shell = air.shell_at(altitude);
        EXPECT_EQ(air.sunlight(altitude, -horizon - 1e-9, shell)[0], 0);
        EXPECT_GT(air.sunlight(altitude, -horizon, shell)[0], 1e-3);
        const double s = -0.7 * horizon;
        const Spectrum exact = optical_depth_to_top(medium.air, altitude, s);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(air.sunlight(altitude, s, shell)[c], exponential(-exact[c]), 1e-7);
        }
    }
}

}  // namespace
}  // namespace skybake
