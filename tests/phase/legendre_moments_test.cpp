#include "bakers/air/particles/phase_function.h"
#include "config/sections/layer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bakers/math/quadrature.h"

namespace skybake {
namespace {

constexpr int kDegree = 12;
using Moments = std::array<double, kDegree + 1>;

Moments integrated(const PhaseFunction& phase) {
    const auto integrand = [&](double nu) {
        Moments value{};
        const double p = 2 * std::numbers::pi * phase_value(phase, 1 - nu, 1 + nu);
        for (unsigned l = 0; l <= kDegree; ++l) value[l] = p * std::legendre(l, nu);
        return value;
    };
    return adaptive_integral<Moments>(integrand, -1, 1, 1e-11, 1e-14, 40);
}

RC_GTEST_PROP(LegendreMoments, AreThoseOfTheDefinition, ()) {
    const double g = *rc::gen::inRange(-990, 991) / 1000.0;
    const auto kind = static_cast<config::Phase>(*rc::gen::inRange(0, 4));
    const bool has_g =
        kind == config::Phase::henyey_greenstein || kind == config::Phase::cornette_shanks;
    const PhaseFunction phase = make_phase_function(kind, has_g ? g : 0);
    const std::vector<double> moments = legendre_moments(phase, kDegree);
    const Moments expected = integrated(phase);
    for (std::size_t l = 0; l < moments.size(); ++l) {
        RC_ASSERT(std::fabs(moments[l] - expected[l]) < 1e-9);
    }
    const bool is_henyey = kind == config::Phase::henyey_greenstein;
    const double mean = is_henyey ? g : has_g ? 3 * g * (4 + g * g) / (5 * (2 + g * g)) : 0;
    RC_ASSERT(std::fabs(expected[0] - 1) < 1e-9);
    RC_ASSERT(std::fabs(expected[1] - mean) < 1e-9);
}

TEST(LegendreMoments, KnownOnes) {
    const PhaseFunction air = make_phase_function(config::Phase::rayleigh, 0);
    EXPECT_NEAR(phase_value(air, 0, 2), 3 / (8 * std::numbers::pi), 1e-15);
    EXPECT_NEAR(phase_value(air, 1, 1), 3 / (16 * std::numbers::pi), 1e-15);
    const auto rayleigh = legendre_moments(air, 4);
    EXPECT_NEAR(rayleigh[0], 1, 1e-15);
    EXPECT_NEAR(rayleigh[1], 0, 1e-15);
    EXPECT_NEAR(rayleigh[2], 0.1, 1e-15);
    EXPECT_NEAR(rayleigh[4], 0, 1e-15);
    // The mean cosine of Cornette-Shanks is not its g.
    const auto mie = legendre_moments(make_phase_function(config::Phase::cornette_shanks, 0.8), 1);
    EXPECT_NEAR(mie[1], 0.8436363636, 1e-9);
}

}  // namespace
}  // namespace skybake
