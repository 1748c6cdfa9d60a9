#include "bakers/light/path_tracer/phase_sampling.h"
#include "config/sections/layer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <ostream>
#include <string>

#include "bakers/air/particles/phase_function.h"

namespace skybake {
namespace {

constexpr std::size_t kDegree = 8;

struct NamedPhase {
    config::Phase phase;
    double g;
    const char* name;
};

void PrintTo(const NamedPhase& phase, std::ostream* out) { *out << phase.name; }

class PhaseSampling : public testing::TestWithParam<NamedPhase> {};

// Means of Legendre polynomials over samples are the phase function's moments.
TEST_P(PhaseSampling, HasTheMoments) {
    const PhaseFunction phase = make_phase_function(GetParam().phase, GetParam().g);
    const std::vector<double> moments = legendre_moments(phase, kDegree);
    constexpr int kSamples = 200000;
    std::array<double, kDegree + 1> sum{};
    std::array<double, kDegree + 1> squares{};
    RandomStream random(5, 1, 2);
    for (int i = 0; i < kSamples; ++i) {
        const ScatteringAngle cosine = sample_phase(phase, random.next(), random);
        ASSERT_GE(cosine.one_minus, 0);
        ASSERT_GE(cosine.one_plus, 0);
        ASSERT_NEAR(cosine.one_minus + cosine.one_plus, 2, 1e-13);
        for (unsigned l = 1; l <= kDegree; ++l) {
            const double p = std::legendre(l, 0.5 * (cosine.one_plus - cosine.one_minus));
            sum[l] += p;
            squares[l] += p * p;
        }
    }
    for (std::size_t l = 1; l <= kDegree; ++l) {
        const double mean = sum[l] / kSamples;
        const double error = std::sqrt((squares[l] / kSamples - mean * mean) / kSamples);
        EXPECT_LE(std::fabs(mean - moments[l]), 4 * error) << "l = " << l;
    }
}

// Rayleigh's share of the light below an angle is (4 - 3 nu - nu^3) / 8; shares are of the light
// above it, from the backward end to the forward end.
TEST(PhaseSamplingOfRayleigh, InvertsTheCubic) {
    const PhaseFunction phase = make_phase_function(config::Phase::rayleigh, 0);
    RandomStream random(5, 3, 2);
    double before = -1;
    for (int i = 0; i <= 1000; ++i) {
        const double share = i / 1000.0;
        const ScatteringAngle angle = sample_phase(phase, share, random);
        const double nu = 0.5 * (angle.one_plus - angle.one_minus);
        EXPECT_NEAR((4 + 3 * nu + nu * nu * nu) / 8, share, 1e-15) << share;
        EXPECT_GE(nu, before);
        before = nu;
    }
    EXPECT_EQ(sample_phase(phase, 0, random).one_plus, 0);
    EXPECT_EQ(sample_phase(phase, 1, random).one_minus, 0);
}

// Near the forward peak the angle itself: the share of light within half the peak's width, where a
// formula by cosines has no digits left. For Henyey-Greenstein 1 - nu = (1 - g)^2 (1 - s) (2 + g (1
// + s)) / (2 (1 + g s)^2), s uniform.
TEST(PhaseSamplingAtThePeak, KeepsItsDigits) {
    const double g = 0.999999;
    const PhaseFunction phase = make_phase_function(config::Phase::henyey_greenstein, g);
    const double s = 0.9;
    const double bound =
        (1 - g) * (1 - g) * (1 - s) * (2 + g * (1 + s)) / (2 * (1 + g * s) * (1 + g * s));
    constexpr int kSamples = 100000;
    int within = 0;
    RandomStream random(5, 2, 2);
    for (int i = 0; i < kSamples; ++i)
        within += sample_phase(phase, random.next(), random).one_minus < bound;
    EXPECT_NEAR(within, 0.05 * kSamples, 4 * std::sqrt(0.05 * 0.95 * kSamples));
}

INSTANTIATE_TEST_SUITE_P(
    Phases, PhaseSampling,
    testing::Values(NamedPhase{config::Phase::isotropic, 0, "Isotropic"},
                    NamedPhase{config::Phase::rayleigh, 0, "Rayleigh"},
                    NamedPhase{config::Phase::henyey_greenstein, 0, "HenyeyGreensteinZero"},
                    NamedPhase{config::Phase::henyey_greenstein, -0.9, "HenyeyGreensteinBackward"},
                    NamedPhase{config::Phase::henyey_greenstein, 1e-9, "HenyeyGreensteinTiny"},
                    NamedPhase{config::Phase::henyey_greenstein, 0.5, "HenyeyGreensteinForward"},
                    NamedPhase{config::Phase::henyey_greenstein, 0.999, "HenyeyGreensteinPeaked"},
                    NamedPhase{config::Phase::cornette_shanks, 0, "CornetteShanksZero"},
                    NamedPhase{config::Phase::cornette_shanks, -0.5, "CornetteShanksBackward"},
                    NamedPhase{config::Phase::cornette_shanks, 0.8, "CornetteShanksForward"},
                    NamedPhase{config::Phase::cornette_shanks, 0.999, "CornetteShanksPeaked"}),
    [](const auto& of) { return std::string(of.param.name); });

// Scattered directions are unit vectors at the angle asked for, about any axis, along z too.
RC_GTEST_PROP(Scatter, KeepsTheAngle, ()) {
    const auto uniform = [](double low, double high) {
        return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
    };
    const double nu = uniform(-1, 1);
    const double z = uniform(-1, 1);
    const double sine = std::sqrt((1 - z) * (1 + z));
    const double azimuth = uniform(0, 6.3);
    const glm::dvec3 axis = {sine * std::cos(azimuth), sine * std::sin(azimuth), z};
    const glm::dvec3 scattered = scatter(axis, {1 - nu, 1 + nu}, uniform(0, 1));
    RC_ASSERT(std::fabs(dot(scattered, scattered) - 1) < 1e-14);
    RC_ASSERT(std::fabs(dot(scattered, axis) - nu) < 1e-14);
}

// All azimuths are alike: a mean direction lies on the axis.
TEST(Scatter, HasNoPreferredAzimuth) {
    for (const glm::dvec3& axis : {glm::dvec3{0, 0, 1}, glm::dvec3{0, 0, -1},
                                   glm::dvec3{0.6, 0, 0.8}, glm::dvec3{0, 0.6, -0.8}}) {
        RandomStream random(9, 0, 0);
        glm::dvec3 sum{};
        constexpr int kSamples = 100000;
        for (int i = 0; i < kSamples; ++i) {
            sum = sum + scatter(axis, {0.5, 1.5}, random.next());
        }
        const glm::dvec3 across = (1.0 / kSamples) * sum - 0.5 * axis;
        // Each component across has a variance of (1 - 1/4) / 2.
        EXPECT_LT(std::sqrt(dot(across, across)), 4 * std::sqrt(0.75 / kSamples));
    }
}

}  // namespace
}  // namespace skybake
