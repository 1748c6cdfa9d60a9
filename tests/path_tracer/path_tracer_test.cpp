#include "bakers/light/path_tracer/path_tracer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "bakers/air/optical_depth.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/transcendental.h"
#include "tests/path_tracer/path_media.h"
#include "tests/support/number_rows.h"
#include "tests/support/sky_truth.h"

namespace skybake {
namespace {

using namespace test;

// Where nothing absorbs, the sunlight that a planet meets leaves it again. Over the top's sphere,
// mean over points and outward directions (weighed by their cosine) of L = (1 - mean of T over the
// disc) / 4 pi, T of light that passes straight through.
TEST(PathTracer, SunlightThatComesInGoesOut) {
    const SkyMedium medium = test::white_furnace(8, "0.8", "tiny_planet");
    const double top = medium.air.top_radius_km();
    const double covered = medium.air.ground_radius_km / top;
    const double uncovered = (1 - covered) * (1 + covered);
    Spectrum passed{};
    constexpr int kRings = 4000;
    for (int i = 0; i < kRings; ++i) {
        // 1 - b^2 / top^2, b the distance of the line from the centre.
        const double square = uncovered * (i + 0.5) / kRings;
        const Spectrum depth =
            optical_depth_to_top(medium.air, medium.air.thickness_km, -top * std::sqrt(square));
        for (std::size_t c = 0; c < 3; ++c) {
            passed[c] += uncovered * exponential(-depth[c]) / kRings;
        }
    }
    // Middles of equal parts of the sun's cosine, of the direction's squared cosine, of azimuth.
    const PathMedium path_medium(medium);
    constexpr int kParts = 22;
    constexpr int kAzimuths = 10;
    constexpr int kPoints = kParts * kParts * kAzimuths;
    Spectrum sum{};
    Spectrum variance{};
    for (int i = 0; i < kPoints; ++i) {
        const double u = (i % kParts + 0.5) / kParts;
        const double v = (i / kParts % kParts + 0.5) / kParts;
        const double w = (i / kParts / kParts + 0.5) / kAzimuths;
        const SunZenith sun = {2 * u - 1, 2 * std::sqrt(u * (1 - u))};
        const SkyDirection inwards =
            sky_direction(sun, -std::sqrt(v), std::sqrt(1 - v), cosine_of_pi(w));
        const PathTracedRadiance radiance =
            trace_paths(path_medium, medium.air.thickness_km, sun, inwards,
                        paths(64, static_cast<std::uint32_t>(i)), 1);
        sum += radiance.radiance / double{kPoints};
        variance += radiance.standard_error * radiance.standard_error;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        const double expected = (1 - passed[c]) / (4 * std::numbers::pi);
        // 0.5 % for these points in place of all.
        EXPECT_NEAR(sum[c], expected, 5e-3 * expected + 4 * std::sqrt(variance[c]) / kPoints) << c;
    }
}

// Matter that absorbs is darker than the furnace, and darker the more it absorbs.
TEST(PathTracer, AbsorptionDarkensTheFurnace) {
    double before = 1;
    for (const char* albedo : {"0.9", "0.5", "0"}) {
        const SkyMedium medium =
            preset_sky("earth_hillaire", {std::string("atmosphere.ground_albedo=") + albedo});
        const PathTracedRadiance radiance =
            trace_ambient_paths(PathMedium(medium), 0.5, -1, paths(20000), 1);
        EXPECT_LT(radiance.radiance[1] + 4 * radiance.standard_error[1], before) << albedo;
        before = radiance.radiance[1];
    }
}

// Random walks' first order is what quadrature finds, ground in sunlight and all.
TEST(PathTracer, FirstOrderIsSingleScattering) {
    test::Agreement agreement;
    std::uint32_t ray = 0;
    for (const char* preset : {"earth_hillaire", "mars_rgb", "tiny_planet", "dense_earth"}) {
        const SkyMedium medium = preset_sky(preset);
        const PathMedium path_medium(medium);
        const SkyIntegrator integrator(medium, nullptr);
        for (const auto& [altitude, sun, zenith, azimuth] : {std::array{0.0, 40.0, 30.0, 50.0},
                                                             {0.5, 60.0, 85.0, 0.0},
                                                             {2.0, 92.0, 85.0, 10.0},
                                                             {10.0, 20.0, 120.0, 80.0},
                                                             {12.0, 85.0, 92.0, 170.0},
                                                             {1.0, 0.0, 0.0, 0.0}}) {
            const test::View view = view_at(altitude, sun, zenith, azimuth);
            PathTracerSettings settings = paths(6000, ++ray);
            settings.deterministic_first_order = false;
            const SkyRadiance exact = integrator.radiance(altitude, view.sun, view.direction);
            const PathTracedRadiance walked = trace(path_medium, view, settings);
            settings.deterministic_first_order = true;
            const PathTracedRadiance mixed = trace(path_medium, view, settings);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_EQ(mixed.orders[0][c], exact.single[c] + exact.ground[c]);
                // Whole radiances, whose errors are known, by either way.
                agreement.add(walked.radiance[c], walked.standard_error[c], mixed.radiance[c],
                              mixed.standard_error[c]);
                // The walked first order varies by less than all orders do.
                EXPECT_NEAR(walked.orders[0][c], mixed.orders[0][c],
                            4.5 * walked.standard_error[c] + 1e-12);
            }
        }
    }
    EXPECT_LT(agreement.mean(), 1.4);
    EXPECT_LT(agreement.largest, 4.5);
}

TEST(PathTracer, OrdersAddUp) {
    const SkyMedium medium = preset_sky("earth_hillaire");
    const PathTracedRadiance radiance =
        trace(PathMedium(medium), view_at(0.5, 60, 75, 90), paths(5000));
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (const Spectrum& order : radiance.orders) {
            EXPECT_GT(order[c], 0);
            sum += order[c];
        }
        EXPECT_NEAR(sum, radiance.radiance[c], 1e-12 * sum);
        EXPECT_GT(radiance.orders[1][c], radiance.orders[2][c]);
    }
}

// Each channel alone is what it is beside others: paths are shared without bias.
TEST(PathTracer, ChannelsDoNotDisturbEachOther) {
    const char* scattering[] = {"2.901e-4 /m", "6.779e-4 /m", "1.655e-3 /m"};
    const char* absorption[] = {"0.65e-6 /m", "1.881e-6 /m", "0.085e-6 /m"};
    const char* albedo[] = {"0.05", "0.9", "0.4"};
    const SkyMedium all = preset_sky("dense_earth", {"atmosphere.ground_albedo=[0.05, 0.9, 0.4]"});
    test::Agreement agreement;
    for (const auto& [sun, zenith] : {std::pair{30.0, 60.0}, {85.0, 20.0}, {60.0, 120.0}}) {
        const test::View view = view_at(5, sun, zenith, 70);
        const PathTracedRadiance shared = trace(PathMedium(all), view, paths(5000, 1));
        for (std::size_t c = 0; c < 3; ++c) {
            const SkyMedium single = preset_sky(
                "dense_earth",
                {"wavelengths=[\"550 nm\"]", std::string("atmosphere.ground_albedo=") + albedo[c],
                 std::string("atmosphere.layers.rayleigh.scattering=\"") + scattering[c] + "\"",
                 std::string("atmosphere.layers.ozone.absorption=\"") + absorption[c] + "\""});
            ASSERT_EQ(single.air.channels, 1);
            const PathTracedRadiance alone = trace(PathMedium(single), view, paths(5000, 2));
            agreement.add(shared.radiance[c], shared.standard_error[c], alone.radiance[0],
                          alone.standard_error[0]);
            EXPECT_EQ(alone.radiance[1], 0);
        }
    }
    EXPECT_EQ(agreement.count, 9);
    EXPECT_LT(agreement.largest, 4);
}

TEST(PathTracer, SameBitsForAnyNumberOfThreads) {
    const SkyMedium medium = preset_sky("earth_hillaire");
    const PathMedium path_medium(medium);
    const test::View view = view_at(0, 80, 60, 20);
    const PathTracerSettings settings = paths(5000);
    const PathTracedRadiance one = trace(path_medium, view, settings, 1);
    const PathTracedRadiance three = trace(path_medium, view, settings, 3);
    EXPECT_EQ(std::memcmp(&one, &three, sizeof one), 0);
    PathTracerSettings other = settings;
    other.ray = 1;
    EXPECT_NE(trace(path_medium, view, other, 1).radiance[0], one.radiance[0]);
    other = settings;
    other.seed = 21;
    EXPECT_NE(trace(path_medium, view, other, 1).radiance[0], one.radiance[0]);
}

// The standard error says how far runs scatter: 64 of them, of which chi-square has 63 degrees of
// freedom.
TEST(PathTracer, StandardErrorIsTheScatterOfRuns) {
    const SkyMedium medium = preset_sky("earth_hillaire");
    const PathMedium path_medium(medium);
    const test::View view = view_at(0.5, 30, 30, 90);
    const PathTracedRadiance best = trace(path_medium, view, paths(64000, 1000));
    double chi_square = 0;
    for (std::uint32_t run = 0; run < 64; ++run) {
        const PathTracedRadiance radiance = trace(path_medium, view, paths(1000, run));
        const double z = (radiance.radiance[2] - best.radiance[2]) / radiance.standard_error[2];
        chi_square += z * z;
    }
    EXPECT_GT(chi_square, 33);  // 0.1 % on either side, 1/64 more for `best`
    EXPECT_LT(chi_square, 108);
}

TEST(PathTracer, SmallDiscIsAPointAndSpreadsOnlyItsLight) {
    const SkyMedium medium = preset_sky("earth_hillaire");
    const PathMedium path_medium(medium);
    const test::View view = view_at(0.5, 60, 30, 0);
    PathTracerSettings settings = paths(40000);
    settings.deterministic_first_order = false;
    const PathTracedRadiance point = trace(path_medium, view, settings);
    settings.ray = 1;
    settings.sun_radius = 0.00467;
    const PathTracedRadiance disc = trace(path_medium, view, settings);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(disc.radiance[c], point.radiance[c],
                    4 * std::hypot(disc.standard_error[c], point.standard_error[c]));
    }
    // Half of a disc on the horizon is above it: less light than from its centre where air is
    // thin, and some when the centre is below.
    const SkyMedium vacuum = preset_sky("vacuum", {"atmosphere.ground_albedo=1"});
    settings.sun_radius = 0.1;
    const PathTracedRadiance half = trace(PathMedium(vacuum), view_at(0, 90, 180, 0), settings);
    // Mean of max(cosine, 0) over a disc of radius a on the horizon: 2 a / 3 pi up to a^2.
    EXPECT_NEAR(half.radiance[0], 0.1 * 2 / (3 * 3.14159265) / 3.14159265,
                4 * half.standard_error[0] + 1e-5);
}

// Every row against an independent program; rows of a direction share their paths.
test::Agreement agreement_with(const std::string& name, const SkyMedium& medium,
                               std::int64_t count) {
    const auto truth = test::sky_truth_of(SKYBAKE_TEST_DATA "/" + name);
    std::vector<SkyTruthDirection> directions;
    for (const SkyTruth& row : truth) {
        if (row.channel == 0) directions.push_back(row.direction);
    }
    test::Agreement agreement;
    for (const SkyTruth& traced : trace_sky_truth(medium, directions, {20, count}, 1)) {
        for (const SkyTruth& row : truth) {
            if (row.direction != traced.direction || row.channel != traced.channel) continue;
            agreement.add(traced.radiance, traced.standard_error, row.radiance, row.standard_error);
        }
    }
    return agreement;
}

TEST(PathTracer, AgreesWithTheTruthOfEarth) {
    const test::Agreement agreement =
        agreement_with("truth_sky_setH0_h0.5.csv",
                       preset_sky("earth_hillaire", {"atmosphere.ground_albedo=0"}), 10000);
    EXPECT_EQ(agreement.count, 534);
    // 178 directions of three correlated rows: the mean has a standard deviation below 0.11.
    EXPECT_LT(agreement.mean(), 1.3);
    EXPECT_GT(agreement.mean(), 0.7);
    EXPECT_LT(agreement.largest, 4.5);
}

// Ten times Earth's Mie layer alone, without absorption, Cornette-Shanks with g = 0.
TEST(PathTracer, AgreesWithTheTruthOfConservativeHaze) {
    const SkyMedium haze = preset_sky(
        "earth_hillaire", {"atmosphere.ground_albedo=0", "atmosphere.layers.ozone.enabled=false",
                           "atmosphere.layers.rayleigh.enabled=false", "atmosphere.layers.mie.g=0",
                           "atmosphere.layers.mie.scattering=\"3.996e-5 /m\"",
                           "atmosphere.layers.mie.extinction=\"3.996e-5 /m\""});
    const test::Agreement agreement = agreement_with("truth_sky_Mie0_h0.5.csv", haze, 20000);
    EXPECT_GT(agreement.count, 70);
    EXPECT_LT(agreement.mean(), 1.5);
    EXPECT_GT(agreement.mean(), 0.5);
    EXPECT_LT(agreement.largest, 4.5);
}

// The standard error of colours is that of their replicates, whatever the tracer's unit is.
TEST(PathTracer, ReplicatesHaveTheWalkedLightForTheirMean) {
    const SkyMedium medium = preset_sky("earth_hillaire");
    const PathMedium path_medium(medium);
    const SunZenith sun = sun_at_elevation(0.5);
    const SkyDirection up = sky_direction(sun, 0.6, 0.8, 0.3);
    const PathTracerSettings settings = paths(1024, 1);
    for (const PathTracedRadiance& light :
         {trace_paths(path_medium, 1, sun, up, settings, 1),
          trace_irradiance(path_medium, 1, sun, settings, 1),
          trace_mean_radiance(path_medium, 1, sun, settings, 1),
          trace_ambient_paths(path_medium, 1, 0.6, settings, 1)}) {
        Spectrum mean{};
        for (const Spectrum& replicate : light.replicates) mean += replicate;
        const Spectrum error = standard_error_of(light.replicates, light.walked);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c] / kPathReplicates / light.walked[c], 1, 1e-12);
            EXPECT_NEAR(error[c] / light.standard_error[c], 1, 1e-9);
        }
    }
}

// Psi of all orders. Deeper in twilight too few paths reach the light for a standard error.
TEST(PathTracer, MeanRadianceAgreesWithTheTruth) {
    const SkyMedium medium = preset_sky("earth_hillaire", {"atmosphere.ground_albedo=0"});
    const PathMedium path_medium(medium);
    test::Agreement agreement;
    std::uint32_t ray = 0;
    for (const auto& v : test::number_rows(SKYBAKE_TEST_DATA "/truth_mslut_setH0.csv")) {
        if (v[1] > 92) continue;
        const auto c = static_cast<std::size_t>(v[2]);
        const SunZenith sun = {test::cosine_of_degrees(v[1]), test::sine_of_degrees(v[1])};
        const PathTracedRadiance mean =
            trace_mean_radiance(path_medium, v[0], sun, paths(10000, ++ray), 1);
        agreement.add(mean.radiance[c], mean.standard_error[c], v[4], v[5]);
    }
    EXPECT_GT(agreement.count, 100);
    EXPECT_LT(agreement.mean(), 1.35);
    EXPECT_GT(agreement.mean(), 0.65);
    EXPECT_LT(agreement.largest, 4.5);
}

}  // namespace
}  // namespace skybake
