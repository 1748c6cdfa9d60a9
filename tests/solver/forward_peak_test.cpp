#include "bakers/light/solver/first_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bakers/light/sky_light.h"
#include "tests/light/sky_media.h"
#include "tests/path_tracer/path_media.h"

namespace skybake {
namespace {

config::Atmosphere foggy_atmosphere() { return test::earth_with_drops().parameters.atmosphere; }

TEST(ForwardPeak, PeakAndRestAreTheWhole) {
    constexpr int kDegree = 8;
    const SkyMedium medium = make_sky_medium(foggy_atmosphere());
    const std::vector<SplitPhase> phases = split_phases(medium, kDegree);
    ASSERT_EQ(phases.size(), medium.layers.size());
    int peaks = 0;
    for (std::size_t k = 0; k < phases.size(); ++k) {
        const SplitPhase& split = phases[k];
        if (split.peak.empty()) {
            EXPECT_FALSE(medium.layers[k].phase.functions.front().table);
            EXPECT_EQ(split.wide.share, (Spectrum(1.0)));
            continue;
        }
        ++peaks;
        const auto whole = legendre_moments(medium.layers[k].phase, kDegree);
        const auto wide = legendre_moments(split.wide.phase, kDegree);
        for (std::size_t c = 0; c < 3; ++c) {
            // Fog sends about half of its light into the peak, as diffraction has it.
            EXPECT_NEAR(split.peak[0][c], 0.5, 0.1);
            EXPECT_NEAR(split.peak[0][c] + split.wide.share[c], 1, 1e-12);
            for (std::size_t l = 0; l <= kDegree; ++l) {
                EXPECT_NEAR(split.peak[l][c] + split.wide.share[c] * wide[l][c], whole[l][c],
                            1e-12);
                // All of it is within 10 degrees.
                EXPECT_GT(split.peak[l][c], 0.6 * split.peak[0][c]);
            }
            // Beyond the peak nothing has changed.
            for (const double one_minus : {0.02, 0.5, 1.7}) {
                EXPECT_NEAR(split.wide.share[c] *
                                phase_value(split.wide.phase.of(c), one_minus, 2 - one_minus),
                            phase_value(medium.layers[k].phase.of(c), one_minus, 2 - one_minus),
                            1e-12);
            }
        }
    }
    EXPECT_EQ(peaks, 1);
}

// Henyey and Greenstein's moments are the powers of g: what moments up to a degree cannot hold is the
// next power, however often the medium was scaled before.
TEST(ForwardPeak, ScalingTwiceIsScalingToTheLowerDegree) {
    constexpr double kG = 0.9;
    const SkyMedium whole =
        test::haze_alone("g = 0.9\nscattering = '0.2 /km'\nextinction = '0.25 /km'\n");
    for (const std::vector<int>& degrees : {std::vector<int>{8}, {20, 8}, {32, 20, 8}}) {
        SkyMedium scaled = whole;
        for (const int degree : degrees) scaled = delta_scaled(scaled, degree);
        const double share = std::pow(kG, 9);
        const SkyLayer& layer = scaled.layers[0];
        EXPECT_NEAR(layer.forward_share[0], share, 1e-12);
        EXPECT_NEAR(scattering_at(scaled.air, 0)[0], 0.2 * (1 - share), 1e-12);
        EXPECT_NEAR(extinction_at(scaled.air, 0)[0], 0.25 - 0.2 * share, 1e-12);
        const std::vector<Spectrum> moments = scattered_moments(layer, 8);
        for (int l = 0; l <= 8; ++l) {
            EXPECT_NEAR(moments[static_cast<std::size_t>(l)][0],
                        (std::pow(kG, l) - share) / (1 - share), 1e-12);
        }
        // Light that is scattered for the first time is what it was.
        for (const double one_minus : {1e-4, 0.3, 1.9}) {
            const double before =
                0.2 * first_phase_values(whole.layers[0], one_minus, 2 - one_minus)[0];
            const double after = scattering_at(scaled.air, 0)[0] *
                                 first_phase_values(layer, one_minus, 2 - one_minus)[0];
            EXPECT_NEAR(after / before, 1, 1e-12) << one_minus;
        }
    }
}

// Skies of drops, of three phase functions at three wavelengths, against traced paths: with the
// peak taken out of the scattering, as assets of the sky have it.
TEST(ForwardPeak, SkiesOfDropsAreThoseOfPaths) {
    const config::Atmosphere atmosphere = foggy_atmosphere();
    const SkyLight light(atmosphere, config::SkyOrders::all, {}, {});
    ASSERT_TRUE(light.has_peaks());
    const SkyMedium medium = make_sky_medium(atmosphere);
    const PathMedium path_medium(medium);
    for (const double sun_zenith : {30.0, 75.0}) {
        for (const double azimuth : {60.0, 150.0}) {
            for (const double zenith : {20.0, 60.0}) {
                const test::View view = test::view_at(0.2, sun_zenith, zenith, azimuth);
                const Spectrum solved =
                    light.wanted(light.integrator().radiance(0.2, view.sun, view.direction));
                PathTracerSettings paths;
                paths.paths = 30000;
                const PathTracedRadiance traced = test::trace(path_medium, view, paths, 0);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double sigma =
                        std::hypot(traced.standard_error[c], 0.02 * traced.radiance[c]);
                    EXPECT_LT(std::fabs(solved[c] - traced.radiance[c]), 4 * sigma)
                        << sun_zenith << ' ' << azimuth << ' ' << zenith << ' ' << c << ": "
                        << solved[c] << ' ' << traced.radiance[c];
                }
            }
        }
    }
}

// The light that the layers scatter apart adds up to all that is scattered once.
TEST(ForwardPeak, LayersAddUp) {
    const config::Atmosphere atmosphere = foggy_atmosphere();
    const SunZenith sun{0.5, std::sqrt(0.75)};
    const SkyDirection towards = sky_direction(sun, 0.7, std::sqrt(0.51), 0.3);
    const auto single = [&](const std::vector<std::string>& layers) {
        const SkyLight light(atmosphere, config::SkyOrders::single, layers, {});
        return light.integrator().radiance(0.2, sun, towards).single;
    };
    const Spectrum all = single({});
    const Spectrum fog = single({"fog"});
    const Spectrum air = single({"rayleigh", "mie"});
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR((fog[c] + air[c]) / all[c], 1, 1e-12);
}

}  // namespace
}  // namespace skybake
