// Layers of several kinds of spheres, against OPAC's published output and plain sums.
#include "bakers/air/particles/sphere_mixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bakers/air/particles/particle_scattering.h"
#include "config/sections/spectral_air.h"
#include "tests/phase/lorenz_mie_reference.h"
#include "tests/phase/phase_values.h"

namespace skybake {
namespace {

using config::LayerParticles;
using config::Length;

constexpr double kAccuracy = 3e-3;
constexpr Length nanometers(double nm) { return {nm * 1e-9}; }

LayerParticles mixture(config::AerosolMixture mixture, double humidity) {
    LayerParticles layer;
    layer.kinds = config::kinds_of(mixture, humidity);
    return layer;
}

std::shared_ptr<const SphereScattering> at(const LayerParticles& layer, double nm) {
    return sphere_scattering(layer, nanometers(nm), kAccuracy, 2);
}

// OPAC 3.1's output for continental polluted air at 80 % and 550 nm.
TEST(SphereMixture, HasThePublishedOpticsOfContinentalPollutedAir) {
    const auto found = at(mixture(config::AerosolMixture::continental_polluted, 0.8), 550);
    EXPECT_NEAR(found->extinction_per_m * 1000, 0.1746, 0.01 * 0.1746);
    EXPECT_NEAR(found->scattering_per_m * 1000, 0.1558, 0.01 * 0.1558);
    EXPECT_NEAR(found->scattering_per_m / found->extinction_per_m, 0.8925, 0.01 * 0.8925);
    EXPECT_NEAR(tabulated_moments(*found->phase, 1).back(), 0.6977, 0.01 * 0.6977);
}

// A plain sum over OPAC's dry soil, whose largest spheres are cut off where they still have one per
// cent of all area.
TEST(SphereMixture, EndsWhereItsRadiiEnd) {
    const config::Particles soil = config::spheres_of(config::AerosolComponent::insoluble, 0);
    ASSERT_DOUBLE_EQ(soil.largest_radius.meters, 20e-6);
    const Length green = nanometers(550);
    double extinction = 0, scattering = 0;
    const double first = std::log(soil.smallest_radius.meters);
    const double last = std::log(soil.largest_radius.meters);
    const double width = std::log(soil.geometric_deviation);
    constexpr int kSteps = 1500;
    for (int i = 0; i < kSteps; ++i) {
        const double u = first + (i + 0.5) * (last - first) / kSteps;
        const double r = std::exp(u);
        const double place = (u - std::log(soil.radius.meters)) / width;
        const double number = std::exp(-0.5 * place * place) /
                              (std::sqrt(2 * std::numbers::pi) * width) * (last - first) / kSteps;
        const test::ReferenceSphere sphere =
            test::reference_sphere(2 * std::numbers::pi * r / green.meters, {1.53, 8e-3}, {});
        extinction += number * std::numbers::pi * r * r * sphere.extinction;
        scattering += number * std::numbers::pi * r * r * sphere.scattering;
    }
    const ParticleScattering found = particle_scattering(soil, green, 1e-3, 2);
    EXPECT_NEAR(found.extinction_cross_section_m2 / extinction, 1, 1e-3);
    EXPECT_NEAR(found.scattering_cross_section_m2 / scattering, 1, 1e-3);
    config::Particles uncut = soil;
    uncut.smallest_radius = uncut.largest_radius = {0};
    EXPECT_GT(particle_scattering(uncut, green, 1e-3, 2).extinction_cross_section_m2,
              1.005 * extinction);
}

TEST(SphereMixture, IsTheSumOfItsKinds) {
    const LayerParticles dust = mixture(config::AerosolMixture::desert, 0.5);
    const auto all = at(dust, 446);
    double extinction = 0, scattering = 0;
    for (const config::SphereKind& kind : dust.kinds) {
        const ParticleScattering one =
            particle_scattering(kind.particles, nanometers(446), kAccuracy, 2);
        extinction += kind.number_density.per_cubic_meter * one.extinction_cross_section_m2;
        scattering += kind.number_density.per_cubic_meter * one.scattering_cross_section_m2;
    }
    EXPECT_NEAR(all->extinction_per_m, extinction, 1e-12 * extinction);
    EXPECT_NEAR(all->scattering_per_m, scattering, 1e-12 * scattering);
    for (const double degrees : {0.0, 0.37, 2.0, 17.3, 60.0, 90.0, 123.4, 179.9, 180.0}) {
        double sum = 0;
        for (const config::SphereKind& kind : dust.kinds) {
            const ParticleScattering one =
                particle_scattering(kind.particles, nanometers(446), kAccuracy, 2);
            sum += kind.number_density.per_cubic_meter * one.scattering_cross_section_m2 *
                   value_at(one.phase, degrees) / scattering;
        }
        EXPECT_NEAR(value_at(*all->phase, degrees) / sum, 1, 1e-9) << degrees;
    }
}

TEST(SphereMixture, HasTheExtinctionThatIsAskedFor) {
    LayerParticles haze = mixture(config::AerosolMixture::urban, 0.8);
    const auto own = at(haze, 680);
    const auto own_green = at(haze, 550);
    haze.extinction = config::InverseLength{1e-5};
    EXPECT_NEAR(at(haze, 550)->extinction_per_m, 1e-5, 1e-17);
    const auto scaled = at(haze, 680);
    EXPECT_NEAR(scaled->extinction_per_m,
                1e-5 * own->extinction_per_m / own_green->extinction_per_m, 1e-14);
    EXPECT_NEAR(scaled->scattering_per_m / scaled->extinction_per_m,
                own->scattering_per_m / own->extinction_per_m, 1e-12);
    EXPECT_EQ(scaled->phase, own->phase);
    for (config::SphereKind& kind : haze.kinds) kind.number_density.per_cubic_meter *= 2;
    EXPECT_NEAR(at(haze, 680)->extinction_per_m, scaled->extinction_per_m, 1e-16);
    EXPECT_EQ(at(haze, 680), at(haze, 680)) << "is remembered";
}

// Series at every fiftieth nm tell those between.
TEST(SphereMixture, IsInterpolatedBetweenWavelengths) {
    for (const auto kind :
         {config::AerosolMixture::maritime_clean, config::AerosolMixture::desert}) {
        const LayerParticles layer = mixture(kind, 0.8);
        LayerParticles few = layer;
        few.step = nanometers(50);
        for (const double nm : {400.0, 425.0}) {
            const auto exact = at(layer, nm);
            const auto found = at(few, nm);
            EXPECT_NEAR(found->extinction_per_m / exact->extinction_per_m, 1, 3e-3) << nm;
            EXPECT_NEAR(found->scattering_per_m / exact->scattering_per_m, 1, 4e-3) << nm;
            EXPECT_NEAR(tabulated_moments(*found->phase, 1).back(),
                        tabulated_moments(*exact->phase, 1).back(), 3e-3)
                << nm;
            for (const double degrees : {1.0, 10.0, 60.0, 120.0})
                EXPECT_NEAR(value_at(*found->phase, degrees) / value_at(*exact->phase, degrees), 1,
                            0.03)
                    << nm << " " << degrees;
        }
        // Beyond the ends of its tables it stays as it is.
        const auto end = at(layer, 350);
        const auto beyond = at(few, 340);
        EXPECT_NEAR(beyond->extinction_per_m / end->extinction_per_m, 1, 1e-12);
        EXPECT_NEAR(value_at(*beyond->phase, 10) / value_at(*end->phase, 10), 1, 1e-9);
    }
}

TEST(RefractiveIndices, AreLinesBetweenTheirEntries) {
    config::Particles dust;
    dust.material = config::ParticleMaterial::tabulated;
    dust.indices = {{nanometers(400), 1.5, 0.01}, {nanometers(600), 1.6, 0.002}};
    const auto index = [&](double nm) { return refractive_index(dust, nanometers(nm)); };
    EXPECT_NEAR(index(450).real, 1.525, 1e-12);
    EXPECT_NEAR(index(450).imaginary, 0.008, 1e-12);
    EXPECT_EQ(index(400).imaginary, 0.01);
    EXPECT_EQ(index(300).imaginary, 0.01);
    EXPECT_EQ(index(900).real, 1.6);
}

}  // namespace
}  // namespace skybake
