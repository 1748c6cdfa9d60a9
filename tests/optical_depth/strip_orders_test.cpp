#include "bakers/light/strip_orders.h"

#include <gtest/gtest.h>

#include <numbers>

#include "bakers/light/sky_radiance.h"
#include "tests/support/atmospheres.h"

namespace skybake::test {
namespace {

constexpr double kPi = std::numbers::pi;

config::Atmosphere thin_air(const std::string& phase) {
    return recipe_of(
               "wavelengths = ['550 nm']\n[atmosphere]\nground_radius = '6360 km'\n"
               "top_radius = '6420 km'\nground_albedo = 0\n[atmosphere.layers.air]\n"
               "profile = 'exponential'\nscale_height = '8 km'\nscattering = '1e-5 /m'\n" +
               phase)
        .parameters.atmosphere;
}

// Eight strips summed with a fine midpoint rule over each and radiances straight from the
// integrator: sun at 60 degrees from the zenith, at the ground, where the grid has its row.
double summed(const SkyMedium& medium, double view_mu, double view_azimuth, double sun_mu) {
    const SkyIntegrator single(medium, nullptr);
    const SunZenith sun{sun_mu, std::sqrt(1 - sun_mu * sun_mu)};
    const double view_sine = std::sqrt(1 - view_mu * view_mu);
    constexpr int kSteps = 48;
    double sum = 0;
    for (int strip = 0; strip < 8; ++strip) {
        const double middle = (strip + 0.5) * kPi / 4;
        const SkyDirection direction = sky_direction(sun, 0.5, std::sqrt(0.75), std::cos(middle));
        const double light =
            single.radiance(sky_ray(shell_of(medium.air), 0, sun, direction)).single[0];
        for (int i = 0; i < kSteps; ++i) {
            const double mu = (i + 0.5) / kSteps;
            const double sine = std::sqrt(1 - mu * mu);
            for (int j = 0; j < kSteps; ++j) {
                const double azimuth = (strip + (j + 0.5) / kSteps) * kPi / 4;
                const double cosine =
                    mu * view_mu + sine * view_sine * std::cos(azimuth - view_azimuth);
                sum += light * (kPi / 4) / (kSteps * kSteps) *
                       phase_values(medium.layers[0].phase, 1 - cosine, 1 + cosine)[0];
            }
        }
    }
    return sum;
}

TEST(StripOrders, AreTheSumOverEightStrips) {
    for (const char* phase :
         {"phase = 'isotropic'", "phase = 'rayleigh'", "phase = 'henyey_greenstein'\ng = 0.5"}) {
        const SkyMedium medium = make_sky_medium(thin_air(phase));
        const StripOrders strips(medium, {});
        for (const double azimuth : {0.3, 1.8}) {
            const double found =
                strips.scattered({0, 0.5, 0.2, std::cos(azimuth)}, {Spectrum{0.01, 0, 0, 0}})[0];
            const double wanted = 0.01 * summed(medium, 0.2, azimuth, 0.5);
            // Between suns of the grid its light is linear, within 0.5 % of itself.
            EXPECT_NEAR(found / wanted, 1, 1e-2) << phase;
        }
    }
}

// Isotropic scattering knows no direction; half the sphere is strips.
TEST(StripOrders, OfIsotropicScatteringAreHalfTheMeanRadiance) {
    const SkyMedium medium = make_sky_medium(thin_air("phase = 'isotropic'"));
    const StripOrders strips(medium, {});
    double mean = 0;
    for (const Spectrum& radiance : strips.radiances(1, 0.5)) mean += radiance[0] / 4;
    for (const double mu : {-1.0, -0.3, 0.0, 1.0}) {
        EXPECT_NEAR(strips.scattered({1, 0.5, mu, 0.1}, {Spectrum{0.01, 0, 0, 0}})[0], 0.005 * mean,
                    1e-12 * mean);
    }
    double ground = 0;
    for (const Spectrum& radiance : strips.radiances(0, 0.5)) ground += radiance[0] / 4;
    EXPECT_NEAR(strips.sky_irradiance(0.5)[0], kPi * ground, 1e-12);
}

TEST(StripOrders, AreTheSameOnAnyThreads) {
    const SkyMedium medium = make_sky_medium(thin_air("phase = 'rayleigh'"));
    const StripOrders one(medium, {.threads = 1});
    const StripOrders two(medium, {.threads = 2});
    for (const double mu : {-0.2, 0.0, 0.9}) {
        EXPECT_EQ(one.radiances(3, mu)[1], two.radiances(3, mu)[1]);
    }
}

}  // namespace
}  // namespace skybake::test
