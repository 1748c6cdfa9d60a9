#include "bakers/air/particles/particle_scattering.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "bakers/air/particles/size_distribution.h"
#include "bakers/air/particles/water_refractive_index.h"
#include "tests/phase/lorenz_mie_reference.h"
#include "tests/phase/phase_values.h"

namespace skybake {
namespace {

using config::Length;
using config::Particles;
using config::SizeDistribution;

constexpr Length kGreen{550e-9};

Particles gamma_drops(double effective_radius_um, double variance) {
    Particles result;
    result.sizes = SizeDistribution::gamma;
    result.effective_radius = {effective_radius_um * 1e-6};
    result.effective_variance = variance;
    return result;
}

Particles log_normal_dust(double median_um, double deviation) {
    Particles result;
    result.material = config::ParticleMaterial::constant;
    result.refractive_index = 1.53;
    result.absorption_index = 0.006;
    result.sizes = SizeDistribution::log_normal;
    result.radius = {median_um * 1e-6};
    result.geometric_deviation = deviation;
    return result;
}

Particles modified_gamma_drops(double scale_um, double alpha, double gamma) {
    Particles result;
    result.sizes = SizeDistribution::modified_gamma;
    result.radius = {scale_um * 1e-6};
    result.alpha = alpha;
    result.gamma = gamma;
    return result;
}

// The degrees in [from, to] at which the phase function is largest.
double brightest(const TabulatedPhase& phase, double from, double to) {
    double best = from;
    for (double at = from; at <= to; at += 0.05) {
        if (value_at(phase, at) > value_at(phase, best)) best = at;
    }
    return best;
}

// Sum of n(r) r^power over the radii.
double moment(const RadiusDistribution& distribution, double power) {
    double sum = 0;
    constexpr double kStep = 1e-3;
    for (double u = -60; u < 5; u += kStep) {
        sum += kStep * distribution.per_log_radius(u) * std::exp(power * u);
    }
    return sum;
}

TEST(SizeDistribution, IsNormalised) {
    for (const Particles& particles :
         {gamma_drops(10, 0.1), gamma_drops(1, 0.4), gamma_drops(300, 0.001),
          log_normal_dust(0.02, 2.24), modified_gamma_drops(171, 0, 1),
          modified_gamma_drops(5, 4, 1.77), modified_gamma_drops(5, -0.5, 3)}) {
        EXPECT_NEAR(moment(RadiusDistribution(particles), 0), 1, 1e-9)
            << particles.radius.meters << particles.effective_radius.meters;
    }
}

TEST(SizeDistribution, GammaHasItsEffectiveRadiusAndVariance) {
    for (const double variance : {0.01, 0.1, 0.35}) {
        const RadiusDistribution distribution(gamma_drops(10, variance));
        const double area = moment(distribution, 2);
        const double radius = moment(distribution, 3) / area;
        EXPECT_NEAR(radius, 1e-5, 1e-13);
        EXPECT_NEAR(moment(distribution, 4) / area / (radius * radius) - 1, variance, 1e-8);
    }
}

TEST(SizeDistribution, OthersAreAsTheyAreDefined) {
    // The mean of ln^2(r / median) is ln^2(deviation).
    const RadiusDistribution dust(log_normal_dust(0.02, 2.24));
    EXPECT_NEAR(moment(dust, 2), 4e-16 * std::exp(2 * std::log(2.24) * std::log(2.24)), 1e-22);
    // Rain: the mean of an exponential distribution is its scale.
    EXPECT_NEAR(moment(RadiusDistribution(modified_gamma_drops(171, 0, 1)), 1), 171e-6, 1e-12);
    // Deirmendjian's cloud C1: alpha 6, gamma 1, mode radius 4 um.
    const RadiusDistribution c1(modified_gamma_drops(4.0 / 6, 6, 1));
    const auto per_radius = [&](double r) { return c1.per_log_radius(std::log(r)) / r; };
    EXPECT_GT(per_radius(4e-6), per_radius(3.99e-6));
    EXPECT_GT(per_radius(4e-6), per_radius(4.01e-6));
}

TEST(SizeDistribution, LittleIsLeftOut) {
    for (const Particles& particles :
         {gamma_drops(10, 0.1), log_normal_dust(0.02, 2.24), modified_gamma_drops(171, 0, 1)}) {
        const RadiusDistribution distribution(particles);
        const auto [first, last, center, width] = distribution.scattering_range(kGreen);
        EXPECT_TRUE(first < center - width && center + width < last);
        double inside = 0;
        double below = 0;
        double above = 0;
        for (double u = -60; u < 5; u += 1e-3) {
            const double x = 2 * std::numbers::pi * std::exp(u) / kGreen.meters;
            const double area = distribution.per_log_radius(u) * x * x;
            const double scattering = area * std::min(1.0, x * x * x * x);
            if (u < first) below += area;
            if (u > last) above += scattering;
            inside += scattering;
        }
        EXPECT_LT(above, 1e-9 * inside);
        EXPECT_LT(below, 1e-9 * moment(distribution, 2) *
                             std::pow(2 * std::numbers::pi / kGreen.meters, 2) / 1e-3);
        // Nor is much more summed than must be.
        EXPECT_GT(above, 1e-13 * inside);
    }
}

TEST(WaterRefractiveIndex, OfItsSources) {
    // Hale & Querry have three decimals, at 25 C and other wavelengths for other samples.
    const auto n = [](double um) { return water_refractive_index({um * 1e-6}).real; };
    const auto k = [](double um) { return water_refractive_index({um * 1e-6}).imaginary; };
    EXPECT_NEAR(n(0.5), 1.335, 2.5e-3);
    EXPECT_NEAR(n(0.7), 1.331, 1e-3);
    EXPECT_NEAR(n(1.0), 1.327, 2e-3);
    EXPECT_NEAR(n(2.0), 1.306, 1e-12);
    EXPECT_NEAR(n(2.3), 0.5 * (1.296 + 1.279), 1e-12);
    EXPECT_NEAR(n(4.0), 1.351, 1e-12);
    EXPECT_NEAR(k(0.5), 1e-9, 1e-20);
    EXPECT_NEAR(k(0.2), 1.1e-7, 1e-18);
    EXPECT_NEAR(k(4.0), 0.0046, 1e-14);
    EXPECT_NEAR(k(1.1), std::sqrt(2.89e-6 * 9.89e-6), 1e-15);
    // Formula and table join; dispersion is normal in the visible.
    EXPECT_NEAR(n(1.1), n(1.1000001), 1e-6);
    for (double um = 0.2; um < 1.0; um += 0.01) EXPECT_GT(n(um), n(um + 0.01));
}

// Sums over radii and angles one by one, with the reference's own series.
TEST(ParticleScattering, IsTheSumOverItsParticles) {
    const Particles dust = log_normal_dust(0.1, 1.6);
    const std::vector<double> degrees = {0, 10, 60, 90, 130, 175, 180};
    std::vector<double> cosines;
    for (const double at : degrees) cosines.push_back(std::cos(at * std::numbers::pi / 180));
    const RadiusDistribution distribution(dust);
    double extinction = 0;
    double scattering = 0;
    double cosine = 0;
    std::vector<double> phase(degrees.size(), 0.0);
    constexpr double kStep = 0.004;
    for (double u = std::log(1e-9); u < std::log(3e-6); u += kStep) {
        const double r = std::exp(u);
        const double share = kStep * distribution.per_log_radius(u);
        const double k = 2 * std::numbers::pi / kGreen.meters;
        const auto at = test::reference_sphere(k * r, {1.53, 0.006}, cosines);
        const double area = share * std::numbers::pi * r * r;
        extinction += area * at.extinction;
        scattering += area * at.scattering;
        cosine += area * at.scattering * at.mean_cosine;
        for (std::size_t i = 0; i < phase.size(); ++i) {
            phase[i] += share * (at.perpendicular[i] + at.parallel[i]) / (2 * k * k);
        }
    }
    const ParticleScattering made = particle_scattering(dust, kGreen, 1e-4, 1);
    EXPECT_LE(made.error, 1e-4);
    EXPECT_NEAR(made.extinction_cross_section_m2 / extinction, 1, 1e-4);
    EXPECT_NEAR(made.scattering_cross_section_m2 / scattering, 1, 1e-4);
    EXPECT_NEAR(made.mean_cosine, cosine / scattering, 1e-4);
    EXPECT_NEAR(tabulated_moments(made.phase, 1).back(), made.mean_cosine, 1e-4);
    for (std::size_t i = 0; i < phase.size(); ++i) {
        EXPECT_NEAR(value_at(made.phase, degrees[i]) * scattering / phase[i], 1, 2e-4)
            << degrees[i];
    }
}

TEST(ParticleScattering, TinySpheresHaveRayleighsPhaseFunction) {
    Particles tiny;
    tiny.sizes = SizeDistribution::monodisperse;
    tiny.radius = {1e-10};
    const ParticleScattering made = particle_scattering(tiny, kGreen, 1e-5, 1);
    EXPECT_LE(made.error, 1e-5);
    for (double at = 0; at <= 180; at += 7.5) {
        const double nu = std::cos(at * std::numbers::pi / 180);
        EXPECT_NEAR(value_at(made.phase, at), 3 / (16 * std::numbers::pi) * (1 + nu * nu), 2e-6);
    }
}

TEST(ParticleScattering, CloudsHaveFogBowAndGlory) {
    const ParticleScattering made = particle_scattering(gamma_drops(10, 0.1), kGreen, 0.03, 0);
    EXPECT_LE(made.error, 0.03);
    EXPECT_NEAR(brightest(made.phase, 125, 155), 141, 3);
    // The glory is a ring: darker than its centre between them.
    EXPECT_GT(value_at(made.phase, 180), 1.1 * value_at(made.phase, 178.5));
    EXPECT_GT(brightest(made.phase, 176, 179.5), 176.2);
    EXPECT_NEAR(made.mean_cosine, 0.86, 0.01);
    EXPECT_LE(made.scattering_cross_section_m2, made.extinction_cross_section_m2);
    // Q_ext is about 2 (1 + x_eff^(-2/3)); n times pi r^2 is pi a^2 (1 - b) (1 - 2 b).
    const double area = std::numbers::pi * 1e-10 * 0.9 * 0.8;
    EXPECT_NEAR(made.extinction_cross_section_m2 / area, 2.09, 0.02);
}

TEST(ParticleScattering, LargeDropsHaveTheRainbow) {
    // Descartes' angle for n = 1.3347 is 138.1 degrees; Airy's brightest place lies 1.02
    // (lambda^2 h / r^2)^(1/3) ... towards larger angles: a degree at 100 um.
    const ParticleScattering made = particle_scattering(gamma_drops(100, 0.02), kGreen, 0.1, 0);
    EXPECT_NEAR(brightest(made.phase, 132, 150), 138.8, 0.7);
    // Alexander's dark band on the other side.
    EXPECT_LT(value_at(made.phase, 133), 0.35 * value_at(made.phase, 138.8));
}

// Groups of radii, and angles found beforehand, held against so many radii that none of it matters.
TEST(ParticleScattering, LargeDropsAreTheSumOverManyRadii) {
    const Particles drops = gamma_drops(100, 0.1);
    const RadiusDistribution distribution(drops);
    const auto range = distribution.scattering_range(kGreen);
    const double k = 2 * std::numbers::pi / kGreen.meters;
    WeightedSpheres spheres(water_refractive_index(kGreen), 0);
    constexpr int kRadii = 20000;
    const double step = (range.last - range.first) / kRadii;
    for (int i = 1; i < kRadii; ++i) {
        const double u = range.first + i * step;
        spheres.add(k * std::exp(u), step * distribution.per_log_radius(u));
    }
    std::vector<double> one_minus;
    for (int i = 0; i <= 16; ++i) one_minus.push_back(std::pow(i / 16.0, 4));
    MieIntensities sums = no_intensities(one_minus.size());
    spheres.add_intensities(0, one_minus, sums);
    const CrossSectionSums wanted = spheres.cross_sections();
    const ParticleScattering made = particle_scattering(drops, kGreen, 0.02, 0);
    EXPECT_LE(made.error, 0.02);
    EXPECT_NEAR(made.scattering_cross_section_m2 * k * k / std::numbers::pi / wanted.scattering, 1,
                1e-3);
    double squares = 0;
    for (std::size_t i = 0; i < one_minus.size(); ++i) {
        const double scale = 2 * std::numbers::pi * wanted.scattering;
        const double forward = (sums.perpendicular[i] + sums.parallel[i]) / scale;
        const double backward = (sums.back_perpendicular[i] + sums.back_parallel[i]) / scale;
        const double d = one_minus[i];
        const double there = tabulated_phase_value(made.phase, d, 2 - d) / forward - 1;
        const double back = tabulated_phase_value(made.phase, 2 - d, d) / backward - 1;
        // The estimate is held to half of the error at least.
        EXPECT_LE(std::fabs(there), 2 * made.error) << d;
        EXPECT_LE(std::fabs(back), 2 * made.error) << d;
        squares += there * there + back * back;
    }
    EXPECT_LE(std::sqrt(squares / 2 / static_cast<double>(one_minus.size())), made.error / 2);
}

TEST(ParticleScattering, SameBitsForAnyNumberOfThreads) {
    const Particles dust = log_normal_dust(0.2, 1.5);
    const ParticleScattering one = particle_scattering(dust, kGreen, 1e-3, 1);
    const ParticleScattering three = particle_scattering(dust, kGreen, 1e-3, 3);
    EXPECT_EQ(one.extinction_cross_section_m2, three.extinction_cross_section_m2);
    EXPECT_EQ(one.scattering_cross_section_m2, three.scattering_cross_section_m2);
    EXPECT_EQ(one.mean_cosine, three.mean_cosine);
    EXPECT_EQ(one.phase.forward, three.phase.forward);
    EXPECT_EQ(one.phase.backward, three.phase.backward);
}

TEST(ParticleScattering, IsRemembered) {
    Particles dust = log_normal_dust(0.2, 1.5);
    const auto first = remembered_particle_scattering(dust, kGreen, 1e-3, 1);
    dust.name = "other";
    EXPECT_EQ(remembered_particle_scattering(dust, kGreen, 1e-3, 2), first);
    EXPECT_NE(remembered_particle_scattering(dust, kGreen, 1e-2, 1), first);
    dust.geometric_deviation = 1.6;
    EXPECT_NE(remembered_particle_scattering(dust, kGreen, 1e-3, 1), first);
}

TEST(ParticleScattering, SaysHowLargeItsSpheresAre) {
    Particles one;
    one.sizes = SizeDistribution::monodisperse;
    one.radius = kGreen;
    EXPECT_NEAR(largest_size_parameter(one, kGreen), 2 * std::numbers::pi, 1e-14);
    EXPECT_LT(largest_size_parameter(modified_gamma_drops(171, 0, 1), {440e-9}),
              kLargestSizeParameter);
}

RC_GTEST_PROP(ParticleScattering, AreWholeForAnyParticles, ()) {
    Particles any =
        log_normal_dust(*rc::gen::inRange(1, 300) / 1000.0, 1 + *rc::gen::inRange(1, 100) / 100.0);
    if (*rc::gen::arbitrary<bool>()) {
        any = gamma_drops(*rc::gen::inRange(1, 300) / 100.0, *rc::gen::inRange(1, 490) / 1000.0);
    }
    any.material = config::ParticleMaterial::constant;
    any.refractive_index = *rc::gen::element(0.5, 0.9, 0.9999, 1.0001, 1.1, 1.5, 2.9);
    any.absorption_index = *rc::gen::element(0.0, 1e-6, 0.01, 3.0);
    const ParticleScattering made = particle_scattering(any, kGreen, 0.05, 1);
    RC_ASSERT(made.scattering_cross_section_m2 > 0);
    RC_ASSERT(made.scattering_cross_section_m2 <= made.extinction_cross_section_m2);
    RC_ASSERT(std::fabs(tabulated_moments(made.phase, 0)[0] - 1) < 1e-12);
    RC_ASSERT(std::fabs(tabulated_moments(made.phase, 1).back() - made.mean_cosine) < 0.02);
    for (const double p : made.phase.forward) RC_ASSERT(p > 0 && std::isfinite(p));
    for (const double p : made.phase.backward) RC_ASSERT(p > 0 && std::isfinite(p));
}

}  // namespace
}  // namespace skybake
