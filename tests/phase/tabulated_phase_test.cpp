#include "bakers/air/particles/tabulated_phase.h"
#include "config/sections/layer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bakers/air/particles/phase_function.h"
#include "bakers/math/quadrature.h"

namespace skybake {
namespace {

MeasuredPhase henyey_greenstein(double g, double bound) {
    const PhaseFunction exact = make_phase_function(config::Phase::henyey_greenstein, g);
    const auto values = [&](const std::vector<ScatteringAngle>& angles) {
        std::vector<double> result;
        // The scale does not count.
        for (const auto& at : angles) {
            result.push_back(7 * phase_value(exact, at.one_minus, at.one_plus));
        }
        return result;
    };
    return make_tabulated_phase(values, bound);
}

// Rugged, of any shape: what is tested of it must not need smoothness.
TabulatedPhase any_phase() {
    const int cells = 1 << *rc::gen::inRange(0, 8);
    const auto count = static_cast<std::size_t>(cells) + 1;
    const auto decades =
        *rc::gen::container<std::vector<int>>(2 * count, rc::gen::inRange(0, 4000));
    std::vector<double> forward, backward;
    for (std::size_t i = 0; i < count; ++i) {
        forward.push_back(std::pow(10.0, decades[i] / 1000.0));
        backward.push_back(std::pow(10.0, decades[count + i] / 1000.0));
    }
    backward.back() = forward.back();
    return normalised_phase(forward, backward);
}

double node(int i, int cells) { return std::pow(static_cast<double>(i) / cells, 4); }

// 2 pi times the integral of p over 1 - nu (or 1 + nu) from 0 to `offset`, by lookups: Simpson's
// rule is exact for lines times P_2 too.
template <class Weight>
double integral(const TabulatedPhase& phase, bool backward, double offset, const Weight& weight) {
    double sum = 0;
    for (int i = 0; i < phase.cells && node(i, phase.cells) < offset; ++i) {
        const double from = node(i, phase.cells);
        const double to = std::min(node(i + 1, phase.cells), offset);
        const auto f = [&](double at) {
            const double nu = backward ? at - 1 : 1 - at;
            return weight(nu) * (backward ? tabulated_phase_value(phase, 2 - at, at)
                                          : tabulated_phase_value(phase, at, 2 - at));
        };
        sum += (to - from) / 6 * (f(from) + 4 * f(0.5 * (from + to)) + f(to));
    }
    return 2 * std::numbers::pi * sum;
}

double one(double) { return 1; }

RC_GTEST_PROP(TabulatedPhase, IntegratesToOne, ()) {
    const TabulatedPhase phase = any_phase();
    RC_ASSERT(std::fabs(integral(phase, false, 1, one) + integral(phase, true, 1, one) - 1) <
              1e-12);
    RC_ASSERT(std::fabs(phase.forward_share.back() + phase.backward_share.back() - 1) < 1e-13);
}

RC_GTEST_PROP(TabulatedPhase, LookupsPassThroughTheNodes, ()) {
    const TabulatedPhase phase = any_phase();
    const int i = *rc::gen::inRange(0, phase.cells + 1);
    const double offset = node(i, phase.cells);
    const auto at = static_cast<std::size_t>(i);
    const auto near = [](double value, double expected) {
        return std::fabs(value - expected) <= 1e-10 * expected;
    };
    RC_ASSERT(near(tabulated_phase_value(phase, offset, 2 - offset), phase.forward[at]));
    RC_ASSERT(near(tabulated_phase_value(phase, 2 - offset, offset), phase.backward[at]));
}

// The light closer to forward than the sampled angle is the share that was asked for.
RC_GTEST_PROP(TabulatedPhase, SamplesInvertTheCumulativeDistribution, ()) {
    const TabulatedPhase phase = any_phase();
    const double share = *rc::gen::inRange(0, 1000000) / 1000000.0;
    const ScatteringAngle at = sample_tabulated_phase(phase, share);
    RC_ASSERT(at.one_minus >= 0 && at.one_plus >= 0);
    RC_ASSERT(std::fabs(at.one_minus + at.one_plus - 2) < 1e-15);
    const double within = at.one_minus <= at.one_plus ? integral(phase, false, at.one_minus, one)
                                                      : 1 - integral(phase, true, at.one_plus, one);
    RC_ASSERT(std::fabs(within - share) < 1e-11);
}

RC_GTEST_PROP(TabulatedPhase, MomentsAreThoseOfTheDefinition, ()) {
    const TabulatedPhase phase = any_phase();
    const std::vector<double> moments = tabulated_moments(phase, 2);
    const auto expect = [&](std::size_t l, auto&& polynomial) {
        const double expected =
            integral(phase, false, 1, polynomial) + integral(phase, true, 1, polynomial);
        RC_ASSERT(std::fabs(moments[l] - expected) < 1e-11);
    };
    expect(0, one);
    expect(1, [](double nu) { return nu; });
    expect(2, [](double nu) { return 1.5 * nu * nu - 0.5; });
    RC_ASSERT(tabulated_moments(phase, 1).back() == moments[1]);
}

// Sums by a quadrature of lookups that knows nothing of cells but where they end.
double moment_by_lookups(const TabulatedPhase& phase, unsigned degree) {
    using One = std::array<double, 1>;
    const auto integrand = [&](double w) {
        const double v = w * w * w * w;
        const double ahead = tabulated_phase_value(phase, v, 2 - v);
        const double back = tabulated_phase_value(phase, 2 - v, v);
        const double sign = degree % 2 == 0 ? 1 : -1;
        return One{2 * std::numbers::pi * std::legendre(degree, 1 - v) * (ahead + sign * back) * 4 *
                   w * w * w};
    };
    double sum = 0;
    const double cells = phase.cells;
    for (int i = 0; i < phase.cells; ++i) {
        sum += adaptive_integral<One>(integrand, i / cells, (i + 1) / cells, 1e-11, 1e-15)[0];
    }
    return sum;
}

TEST(TabulatedPhase, MomentsOfHighDegree) {
    // Cells so wide that the exact rule is the cheaper one, others, and so narrow that P_l bends
    // little in them.
    for (const int cells : {2, 8, 32, 128}) {
        std::vector<double> forward, backward;
        for (int i = 0; i <= cells; ++i) {
            forward.push_back(2 + std::cos(9.0 * i / cells));
            backward.push_back(2 + std::cos(18 - 9.0 * i / cells));
        }
        const TabulatedPhase phase = normalised_phase(forward, backward);
        const std::vector<double> moments = tabulated_moments(phase, 60);
        for (const unsigned l : {3U, 20U, 59U, 60U}) {
            EXPECT_NEAR(moments[l], moment_by_lookups(phase, l), 1e-12) << cells << ' ' << l;
        }
        EXPECT_NEAR(moments[60], tabulated_moments(phase, 600)[60], 1e-13);
    }
}

TEST(TabulatedPhase, HenyeyGreensteinsMomentsArePowers) {
    const std::vector<double> moments = tabulated_moments(henyey_greenstein(0.9, 1e-3).phase, 60);
    for (std::size_t l = 0; l < moments.size(); ++l) {
        EXPECT_NEAR(moments[l], std::pow(0.9, static_cast<double>(l)), 1e-3) << l;
    }
}

TEST(TabulatedPhase, IsWithinItsBound) {
    for (const double g : {0.0, 0.8, -0.95, 0.999}) {
        const PhaseFunction exact = make_phase_function(config::Phase::henyey_greenstein, g);
        for (const double bound : {1e-2, 1e-4}) {
            const auto& [phase, error] = henyey_greenstein(g, bound);
            EXPECT_LE(error, bound) << g;
            double worst = 0;
            for (int i = 0; i <= 5000; ++i) {
                const double v = node(i, 5000);
                for (const auto& [minus, plus] : {std::pair{v, 2 - v}, {2 - v, v}}) {
                    const double wanted = phase_value(exact, minus, plus);
                    worst = std::max(
                        worst, std::fabs(tabulated_phase_value(phase, minus, plus) / wanted - 1));
                }
            }
            // Scaling to 1 and the cells' worst places, beside their middles, add to it.
            EXPECT_LT(worst, 2.5 * bound + 1e-13) << g << ' ' << phase.cells;
        }
    }
}

// Six nodes: halving their distance makes the error 2^6 times less, at the poles and at 90 degrees
// too.
TEST(PhaseInterpolation, IsOfSixthOrder) {
    const PhaseFunction exact = make_phase_function(config::Phase::henyey_greenstein, 0.9);
    const auto error = [&](int cells, double from, double to) {
        PhaseHalves nodes;
        for (int i = 0; i <= cells; ++i) {
            const double v = node(i, cells);
            nodes.forward.push_back(phase_value(exact, v, 2 - v));
            nodes.backward.push_back(phase_value(exact, 2 - v, v));
        }
        const PhaseInterpolation interpolation(nodes);
        double worst = 0;
        for (int i = 0; i <= 500; ++i) {
            const double v = std::pow(from + (to - from) * i / 500, 4);
            for (const ScatteringAngle& at : {ScatteringAngle{v, 2 - v}, {2 - v, v}}) {
                const double wanted = phase_value(exact, at.one_minus, at.one_plus);
                worst = std::max(worst, std::fabs(interpolation.values({at})[0] / wanted - 1));
            }
        }
        return worst;
    };
    for (const auto& [from, to] : {std::pair{0.0, 0.05}, {0.3, 0.6}, {0.95, 1.0}}) {
        EXPECT_LT(error(128, from, to), error(64, from, to) / 40 + 1e-13) << from;
        EXPECT_LT(error(128, from, to), 1e-5) << from;
    }
}

TEST(TabulatedPhase, KeepsItsDigitsAtThePoles) {
    const TabulatedPhase phase = henyey_greenstein(0.999, 1e-4).phase;
    EXPECT_EQ(sample_tabulated_phase(phase, 0).one_minus, 0);
    EXPECT_EQ(sample_tabulated_phase(phase, 0).one_plus, 2);
    // The share within 1 - nu = v is 2 pi p(0) v for small v.
    const double tiny = 1e-30;
    EXPECT_NEAR(sample_tabulated_phase(phase, tiny).one_minus,
                tiny / (2 * std::numbers::pi * phase.forward[0]), 1e-12 * tiny);
    EXPECT_EQ(tabulated_phase_value(phase, 0, 2), phase.forward[0]);
    EXPECT_EQ(tabulated_phase_value(phase, 2, 0), phase.backward[0]);
    const double last = std::nextafter(1.0, 0.0);
    const double after = sample_tabulated_phase(phase, last).one_plus;
    EXPECT_NEAR(after, (1 - last) / (2 * std::numbers::pi * phase.backward[0]), 1e-6 * after);
}

TEST(TabulatedPhase, StratifiedSamplesHaveTheMeanCosine) {
    const TabulatedPhase phase = henyey_greenstein(0.85, 1e-3).phase;
    constexpr int kCount = 20000;
    double sum = 0;
    for (int i = 0; i < kCount; ++i) {
        sum += 1 - sample_tabulated_phase(phase, (i + 0.5) / kCount).one_minus;
    }
    EXPECT_NEAR(sum / kCount, tabulated_moments(phase, 1).back(), 1e-7);
}

}  // namespace
}  // namespace skybake
