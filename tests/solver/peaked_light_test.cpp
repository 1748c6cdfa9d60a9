// Skies of haze and fog, whose phase functions have forward peaks, against light that was traced
// path by path (tests/data/truth_sky_*.csv, made by sky_truths).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/solver/needed_degrees.h"
#include "bakers/light/solver/solve_light.h"
#include "tests/light/sky_media.h"
#include "tests/path_tracer/path_media.h"

namespace skybake {
namespace {

const std::string kMie = "atmosphere.layers.mie.";

config::Atmosphere haze(double g, const std::string& scattering, const std::string& extinction) {
    return test::preset_atmosphere("earth_hillaire", {kMie + "scattering=\"" + scattering + "\"",
                                                      kMie + "extinction=\"" + extinction + "\"",
                                                      kMie + "g=" + std::to_string(g)});
}

config::Atmosphere ground_fog(const std::string& extinction = "\"3 /km\"") {
    return test::preset_atmosphere(
        "earth_hillaire",
        {kMie + "scattering=" + extinction, kMie + "extinction=" + extinction,
         kMie + "phase=\"henyey_greenstein\"", kMie + "scale_height=\"0.1 km\"", kMie + "g=0.85"});
}

// Errors of the sky as assets show it, of suns from `from` to `to` degrees.
test::SkyErrors sky_errors(const SkyLight& light, const std::string& truth, double from,
                           double to) {
    return {light.integrator(),
            test::sky_truth_of(SKYBAKE_TEST_DATA "/truth_sky_" + truth + ".csv"), from, to};
}

// The paths' own standard error is 0.3 % in the median and at most 0.8 %.
TEST(PeakedLight, SkyOfHaze) {
    const SkyLight light(haze(0.9, "0.1 /km", "0.104 /km"), config::SkyOrders::all, {}, {});
    EXPECT_LT(sky_errors(light, "haze_g09", 0, 90).median(), 5e-3);
    EXPECT_LT(sky_errors(light, "haze_g09", 0, 80).largest(), 3.5e-2);
    EXPECT_LT(sky_errors(light, "haze_g09", 89, 89).largest(), 7e-2);
}

TEST(PeakedLight, SkyOfGroundFog) {
    const SkyLight light(ground_fog(), config::SkyOrders::all, {}, {});
    const test::SkyErrors errors = sky_errors(light, "ground_fog", 0, 90);
    EXPECT_LT(errors.median(), 5e-3);
    EXPECT_LT(errors.largest(), 4e-2);
}

// A peak as narrow as this is taken out of the scattering (delta_scaled). Next to a sun that stands
// a degree above the horizon, where half of the peak lies below it, the sky is up to 80 % too
// bright; elsewhere it is right.
TEST(SlowPeakedLight, SkyOfHazeWithANarrowPeak) {
    const SkyLight light(haze(0.97, "0.048 /km", "0.05 /km"), config::SkyOrders::all, {}, {});
    EXPECT_TRUE(light.has_peaks());
    EXPECT_FALSE(light.problem("sky"));
    EXPECT_LT(sky_errors(light, "haze_g097", 0, 90).median(), 1e-2);
    EXPECT_LT(sky_errors(light, "haze_g097", 0, 80).ninth_decile(), 3.5e-2);
}

TEST(PeakedLight, DegreeIsChosenByTheMedium) {
    const auto degree = [](const config::Atmosphere& atmosphere) {
        return sky_degree(make_sky_medium(atmosphere));
    };
    EXPECT_EQ(degree(test::preset_atmosphere("earth_hillaire")), 8);
    EXPECT_EQ(degree(test::preset_atmosphere("vacuum")), 8);
    EXPECT_EQ(degree(haze(0.8, "0.03 /km", "0.033 /km")), 16);
    EXPECT_EQ(degree(haze(-0.9, "0.1 /km", "0.104 /km")), 32);
    EXPECT_EQ(degree(haze(0.97, "0.1 /km", "0.104 /km")), kLargestDegree);
}

// Fog of depth 0.3 and g = 0.85 scatters 0.3 g^9 = 7 % of the light beyond degree 8 at the ground, and
// kNegligibleLight where it is 35 times thinner. An altitude needs what its neighbours need.
TEST(PeakedLight, DegreeEndsWhereNothingScattersMore) {
    const SkyMedium fog = make_sky_medium(ground_fog());
    EXPECT_EQ(needed_degrees(fog, {0, 0.2, 0.6, 1, 2}, 24), (std::vector<int>{24, 24, 24, 3, 3}));
    EXPECT_EQ(needed_degrees(fog, {0, 0.2, 0.6, 1, 2}, 8), (std::vector<int>{8, 8, 8, 3, 3}));
    const SkyMedium air = test::preset_sky("earth_hillaire", {kMie + "enabled=false"});
    EXPECT_EQ(needed_degrees(air, {0, 10, 100}, 16), (std::vector<int>{3, 3, 3}));
}

// Where all but exp(-20) of the light came from all sides.
TEST(PeakedLight, DegreeFallsDeepWithinFog) {
    const SkyMedium thick = make_sky_medium(ground_fog("\"300 /km\""));
    EXPECT_EQ(needed_degrees(thick, {0, 0.02, 0.04, 0.34}, 24), (std::vector<int>{8, 8, 24, 24}));
}

// Scaling keeps what a layer absorbs, and the moments up to the degree of what it scatters.
TEST(PeakedLight, ScalingKeepsMomentsAndAbsorption) {
    const SkyMedium whole = make_sky_medium(haze(0.9, "0.1 /km", "0.104 /km"));
    const SkyMedium scaled = delta_scaled(whole, 8);
    ASSERT_EQ(whole.layers.size(), scaled.layers.size());
    for (const double altitude : {0.0, 1.0, 30.0}) {
        for (std::size_t k = 0; k < whole.layers.size(); ++k) {
            const Coefficients before = coefficients_at(whole.layers[k].alone, altitude);
            const Coefficients after = coefficients_at(scaled.layers[k].alone, altitude);
            const auto chi = legendre_moments(whole.layers[k].phase, 9);
            const auto rest = scattered_moments(scaled.layers[k], 9);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(before.extinction_per_km[c] - before.scattering_per_km[c],
                            after.extinction_per_km[c] - after.scattering_per_km[c], 1e-15);
                EXPECT_NEAR(after.scattering_per_km[c] * rest[9][c], 0, 1e-15);
                for (std::size_t l = 0; l < 9; ++l) {
                    // Light that goes on counts as forward scattering in both.
                    EXPECT_NEAR(
                        before.extinction_per_km[c] - before.scattering_per_km[c] * chi[l][c],
                        after.extinction_per_km[c] - after.scattering_per_km[c] * rest[l][c],
                        1e-14);
                }
            }
        }
        const Coefficients sum = coefficients_at(scaled.air, altitude);
        Spectrum parts{};
        for (const SkyLayer& layer : scaled.layers) parts += extinction_at(layer.alone, altitude);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum.extinction_per_km[c], parts[c], 1e-15);
        }
    }
}

// Light between the columns of an axis is that of another axis, whose columns lie elsewhere. Orders as
// high as these are next to nothing in columns near the zenith, but for what the quadrature over
// azimuths leaves of a phase function with a kink; between columns it must not grow. Cubics through
// 48 columns are themselves off by 2 % of the mean light at these degrees.
TEST(PeakedLight, HighOrdersDoNotDependOnColumns) {
    const SkyMedium medium = without_forward_peaks(
        make_sky_medium(test::earth_with_drops("", "10 /cm3").parameters.atmosphere));
    SolverSettings settings;
    settings.degree = 32;
    settings.orders = 1;
    settings.level_scale = 0.2;
    settings.first_zenith_nodes = 24;
    const SolvedLight one = solve_light(medium, settings, 0);
    settings.suns = 56;
    const SolvedLight other = solve_light(medium, settings, 0);
    std::vector<Spectrum> found(static_cast<std::size_t>(moment_count(settings.degree)));
    std::vector<Spectrum> wanted(found.size());
    for (double elevation = 40; elevation < 90; elevation += 2.5) {
        const double mu = std::sin(elevation * test::kDegree);
        one.moments_at(0.5, mu, found.data());
        other.moments_at(0.5, mu, wanted.data());
        for (int l = 9; l <= settings.degree; ++l) {
            for (int m = 9; m <= l; ++m) {
                const auto lm = static_cast<std::size_t>(moment_index(l, m));
                EXPECT_NEAR(found[lm].y, wanted[lm].y, 4e-2 * wanted[0].y)
                    << elevation << " degrees, l " << l << ", m " << m;
            }
        }
    }
}

// Moments of a low degree are those of a solution to a high degree, and so are the mean radiance and
// the sky's irradiance.
TEST(SlowPeakedLight, LowMomentsAreThoseOfAFineSolution) {
    const SkyMedium medium = make_sky_medium(haze(0.8, "0.03 /km", "0.033 /km"));
    SolverSettings settings;
    const SolvedLight scaled = solve_light(medium, settings, 0);
    EXPECT_EQ(scaled.degree(), 4);
    settings.degree = 16;
    const SolvedLight fine = solve_light(medium, settings, 0);
    for (const double altitude : {0.0, 0.7, 5.0}) {
        for (const double mu : {1.0, 0.5, 0.1}) {
            const Spectrum a = scaled.mean_radiance_at(altitude, mu);
            const Spectrum b = fine.mean_radiance_at(altitude, mu);
            for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 1.5e-2) << altitude;
        }
    }
    for (const double mu : {1.0, 0.5, 0.1}) {
        const Spectrum a = scaled.sky_irradiance_at(mu);
        const Spectrum b = fine.sky_irradiance_at(mu);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 1.5e-2) << mu;
    }
}

}  // namespace
}  // namespace skybake
