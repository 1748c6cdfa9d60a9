// Homogeneous layers of cloud against closed forms: Beer's law, two streams, octaves of scattering.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "bakers/render/cloud_camera.h"
#include "tests/preview/cloud_views.h"
#include "tests/support/loops.h"

namespace skybake {
namespace {

using namespace test;

// A homogeneous layer, seen from below.
struct Slab {
    CloudMedium medium;
    MarchSettings settings;
    double height = 600;
    double sigma = 0;

    Slab(double tau, const SunDirection& sun, config::CloudParticles particles = {})
        : sigma(tau / height) {
        config::Cloud cloud = cloud_of({1000, 1000, height}, 500);
        cloud.particles = particles;
        cloud.extinction_scale.per_meter = sigma;
        const std::array<int, 3> size = {8, 8, 6};
        medium = medium_of(cloud, size, std::vector<float>(8 * 8 * 6, 1.0F));
        settings = small_view(medium, sun);
        settings.camera.elevation_degrees = 50;
        settings.step_m = 0.5;
        settings.light_step_m = 0.5;
    }
};

// The octaves' integral over a slab of optical depth tau, the light leaving it at its base:
//   b^n p_n / mu  integral over depth t from 0 to tau of exp(-(tau - t) / mu - a^n t / mu_s).
double slab_radiance(const CloudPhase& phase, double tau, double mu, double mu_sun, double offset) {
    double sum = 0;
    double a = 1;
    for (const OctavePhase& octave : octave_phases(phase)) {
        const double rate = 1 / mu - a / mu_sun;
        const double integral = std::exp(-tau / mu) * (std::exp(tau * rate) - 1) / rate;
        sum += octave.brightness * phase_value(octave.phase, offset) * integral / mu;
        a *= kOctaveHalving;
    }
    return sum;
}

TEST(CloudView, ScattersSunlightAsTheClosedFormSays) {
    for (const int i : {0, 1, 2, 3, 4, 5}) {
        const double tau = std::array{0.02, 1.0, 6.0}[static_cast<std::size_t>(i / 2)];
        const auto particles = static_cast<config::CloudParticles>(i % 2);
        const CloudPhase phase = i % 2 == 1 ? ice_phase() : droplet_phase(12);
        const Slab slab(tau, {65, 170}, particles);
        const glm::dvec3 sun = direction_of(65, 170);
        const Image2<float> view = march_view(slab.medium, slab.settings, 1).results;
        const CameraRays rays(slab.settings.camera, view.width, view.height);
        testing::for_each_texel(view.width, view.height, [&](int x, int y) {
            const glm::dvec3 ray = rays.through(x, y);
            const double wanted =
                slab_radiance(phase, tau, ray[2], sun[2], one_minus_cosine(ray, sun));
            const double made =
                double{view.texel(x, y)[kSunAtBase]} + double{view.texel(x, y)[kSunAtTop]};
            EXPECT_NEAR(made, wanted, 0.01 * wanted) << tau;
        });
    }
}

// Returns the share of the sun's light that a slab sends back, by Gauss-like sums over directions.
double plane_albedo(double tau, double mu_sun) {
    const auto octaves = octave_phases(droplet_phase(kDropletDiameter_um));
    const double sun_level = std::sqrt(1 - mu_sun * mu_sun);
    constexpr int kMus = 64;
    constexpr int kAzimuths = 128;
    double sum = 0;
    for (int i = 0; i < kMus; ++i) {
        const double mu = (i + 0.5) / kMus;
        for (int j = 0; j < kAzimuths; ++j) {
            const double azimuth = M_PI * (j + 0.5) / kAzimuths;
            // From the way of the light, down, to that of the eye's light, up.
            const double cosine =
                -mu * mu_sun + std::sqrt(1 - mu * mu) * sun_level * std::cos(azimuth);
            double radiance = 0;
            double a = 1;
            for (const OctavePhase& octave : octaves) {
                const double rate = 1 / mu + a / mu_sun;
                radiance += octave.brightness * phase_value(octave.phase, 1 - cosine) *
                            (1 - std::exp(-tau * rate)) / (rate * mu);
                a *= kOctaveHalving;
            }
            sum += radiance * mu * (1.0 / kMus) * (2 * M_PI / kAzimuths);
        }
    }
    return sum / mu_sun;
}

TEST(CloudLight, OctavesSendBackLessThanComesInFromTwentyDegreesUp) {
    for (const double elevation : {20.0, 35.0, 90.0}) {
        for (const double tau : {0.1, 1.0, 10.0, 1000.0}) {
            EXPECT_LT(plane_albedo(tau, sine_of_degrees(elevation)), 1.0)
                << elevation << ' ' << tau;
        }
    }
    EXPECT_NEAR(plane_albedo(20, 1), 0.37, 0.01);
}

TEST(CloudPhase, IntegratesToOneWithItsMeanCosine) {
    for (const double eccentricity : {1.0, 0.5, 0.0}) {
        for (const CloudPhase& whole :
             {droplet_phase(5), droplet_phase(12), droplet_phase(50), ice_phase()}) {
            const CloudPhase phase = widened(whole, eccentricity);
            // offset = 2 x^6: dense where the forward peak is.
            constexpr int kSteps = 200000;
            double sum = 0;
            double moment = 0;
            for (int i = 0; i < kSteps; ++i) {
                const double x = (i + 0.5) / kSteps;
                const double offset = 2 * std::pow(x, 6);
                const double weight = 2 * M_PI * 12 * std::pow(x, 5) / kSteps;
                sum += weight * phase_value(phase, offset);
                moment += weight * phase_value(phase, offset) * (1 - offset);
            }
            EXPECT_NEAR(sum, 1, 1e-4);
            EXPECT_NEAR(moment, mean_cosine(phase), 1e-4);
        }
    }
}

// Key et al. 2002, rough aggregates at 500 to 600 nm: g = 0.7655 at 50 um, and the backward function. Crystals with
// rough faces have 0.75 to 0.78 (van Diedenhoven et al. 2014), and neither halo nor bow: light falls up to 130 degrees,
// and less than twice as much comes back as goes to the side.
TEST(CloudPhase, OfIceIsThatOfRoughAggregates) {
    EXPECT_NEAR(mean_cosine(ice_phase()), 0.7655, 1e-4);
    EXPECT_LT(phase_value(ice_phase(), 2), 2 * phase_value(ice_phase(), 1));
    double before = phase_value(ice_phase(), 0);
    for (double offset = 0.01; offset < 1.64; offset += 0.01) {
        const double value = phase_value(ice_phase(), offset);
        EXPECT_LT(value, before) << offset;
        before = value;
    }
    EXPECT_EQ(cloud_phase(config::CloudParticles::ice).hg_g, ice_phase().hg_g);
    EXPECT_EQ(cloud_phase(config::CloudParticles::droplets).hg_g, droplet_phase(12).hg_g);
}

// Bohren's 2 / (2 + (1 - g) tau).
TEST(CloudLight, DiffuseShareOfASlabIsTwoStreamTheorys) {
    for (const double tau : {0.0, 1.0, 30.0}) {
        const Slab slab(tau, {40, 70});
        const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
        const DiffuseShare share = diffuse_share(slab.medium, 1, 1);
        EXPECT_NEAR(share.through, 2 / (2 + (1 - g) * tau), 1e-9);
        const float lowest = share.from_sky.values[static_cast<std::size_t>(
            share.from_sky.plane() + share.from_sky.row() + 1)];
        EXPECT_NEAR(double{lowest}, 2 / (2 + (1 - g) * tau * (1 - 0.5 / 6)), 1e-6);
    }
}

}  // namespace
}  // namespace skybake
