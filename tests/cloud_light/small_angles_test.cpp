// Light that goes on by small angles: its laws, and walks of light that is scattered at random.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "bakers/assets/forward_scattering/forward_table.h"
#include "bakers/assets/forward_scattering/small_angles.h"
#include "bakers/light/path_tracer/phase_sampling.h"
#include "bakers/math/quadrature.h"
#include "config/sections/layer.h"

namespace skybake::forward_scattering {
namespace {

using cloud_light::CloudScattering;
using cloud_light::scattering_of;

constexpr double kPi = std::numbers::pi;

CloudScattering henyey_greenstein(double g, double albedo) {
    return {{{1, make_phase_function(config::Phase::henyey_greenstein, g)}}, albedo};
}

// The integral over directions of F of small_angles.h times use(cosine), over the x of the table.
template <class Use>
double integral(const SmallAngles& light, double depth, double from, double to, const Use& use) {
    const QuadratureRule rule = gauss_legendre(200);  // on [0, 1]
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double x = from + (to - from) * rule.nodes[i];
        const ScatteringAngle angle = angle_at(x);
        // one_minus = 2 x^4 and the solid angle is 2 pi times its change.
        sum += rule.weights[i] * (to - from) * 2 * kPi * 8 * x * x * x *
               light.reference(depth, angle) * light.scattered_once(angle) *
               std::exp(-light.extinction_share() * depth) * use(1 - angle.one_minus);
    }
    return sum;
}

TEST(SmallAngles, AreThoseOfSingleScatteringWhereTheSunIsNotHidden) {
    for (const double diameter : {5.0, 12.0, 50.0}) {
        for (const int degree : {0, 1, 3}) {
            const SmallAngles light(scattering_of(droplet_phase(diameter), 0.9), degree);
            for (const double x : {0.0, 0.05, 0.3, 0.7, 1.0}) {
                EXPECT_NEAR(light.reference(0, angle_at(x)), 1, 1e-7) << diameter << ' ' << x;
            }
        }
    }
}

// The moments of what is left when light that was not scattered is taken away.
TEST(SmallAngles, HaveTheMomentsOfTheirSeries) {
    for (const double albedo : {1.0, 0.8}) {
        const SmallAngles light(henyey_greenstein(0.7, albedo), 2);
        const double f = albedo * 0.343;
        for (const double depth : {0.3, 2.0, 9.0}) {
            for (int l = 0; l <= 6; ++l) {
                const double chi = albedo * std::pow(0.7, l);
                const double passed =
                    l <= 2 ? std::exp(-(1 - f) * depth) : std::exp(-(1 - chi) * depth);
                const double wanted = (chi - f) * passed + f * std::exp(-depth);
                const auto polynomial = [l](double nu) {
                    return std::legendre(static_cast<unsigned>(l), nu);
                };
                EXPECT_NEAR(integral(light, depth, 0, 1, polynomial), wanted, 1e-10)
                    << albedo << ' ' << depth << ' ' << l;
            }
        }
    }
}

TEST(SmallAngles, OfIsotropicScatteringAreThatOfOneScattering) {
    const SmallAngles light(henyey_greenstein(0, 0.5), 1);
    EXPECT_EQ(light.extinction_share(), 1);
    for (const double depth : {0.0, 1.0, kDeepest}) {
        EXPECT_DOUBLE_EQ(light.reference(depth, angle_at(0.4)), 1);
    }
}

// Light that is scattered n times on the way to a depth, n with Poisson's distribution, and again there.
// Only the terms up to `degree`, whose light the harmonics hold, are written as a series.
TEST(SmallAngles, AreThoseOfLightThatWalksAtRandom) {
    constexpr int kWalks = 400000;
    constexpr double kG = 0.8;
    constexpr double kDepth = 1.5;
    constexpr int kDegree = 3;
    const CloudScattering scattering = henyey_greenstein(kG, 1);
    const SmallAngles light(scattering, kDegree);
    const double f = std::pow(kG, kDegree + 1);
    const std::array<double, 5> edges = {0, 0.2, 0.35, 0.5, 0.7};
    // The second of each pair has not been scattered again.
    std::array<std::array<double, 2>, 4> shares{};
    for (int walk = 0; walk < kWalks; ++walk) {
        RandomStream random(11, 1, static_cast<std::uint64_t>(walk));
        glm::dvec3 direction = {0, 0, 1};
        const auto scatter_once = [&] {
            const ScatteringAngle angle =
                sample_phase(scattering.lobes[0].phase, random.next(), random);
            direction = scatter(direction, angle, random.next());
        };
        const auto count = [&](std::size_t which) {
            const double x = std::sqrt(std::sqrt((1 - direction.z) / 2));
            for (std::size_t bin = 0; bin < shares.size(); ++bin) {
                if (x >= edges[bin] && x < edges[bin + 1]) shares[bin][which] += 1.0 / kWalks;
            }
        };
        double passed = -std::log1p(-random.next());
        const bool is_scattered = passed < kDepth;
        for (; passed < kDepth; passed -= std::log1p(-random.next())) scatter_once();
        if (is_scattered) count(1);
        scatter_once();
        count(0);
    }
    for (std::size_t bin = 0; bin < shares.size(); ++bin) {
        double held = 0;
        const double from = 1 - 2 * std::pow(edges[bin], 4);
        const double to = 1 - 2 * std::pow(edges[bin + 1], 4);
        for (int l = 0; l <= kDegree; ++l) {
            const double chi = std::pow(kG, l);
            const auto n = static_cast<unsigned>(l);
            // The integral of (2 l + 1) P_l is P_(l+1) - P_(l-1).
            const auto whole = [n](double nu) {
                return std::legendre(n + 1, nu) - (n == 0 ? 1 : std::legendre(n - 1, nu));
            };
            held += (whole(from) - whole(to)) / 2 * (chi - f) *
                    (std::exp(-(1 - f) * kDepth) - std::exp(-(1 - chi) * kDepth));
        }
        const double wanted = shares[bin][0] - f * shares[bin][1] + held;
        const double found =
            integral(light, kDepth, edges[bin], edges[bin + 1], [](double) { return 1.0; });
        EXPECT_NEAR(found, wanted, 4 * std::sqrt(0.25 / kWalks)) << bin;
    }
}

TEST(SmallAngles, OfTheKernelAreThoseOfTheReference) {
    for (const double diameter : {5.0, 50.0}) {
        for (const int degree : {0, 3}) {
            const SmallAngles light(scattering_of(droplet_phase(diameter), 1), degree);
            std::vector<ScatteringAngle> angles;
            for (const double x : {0.0, 0.01, 0.1, 0.3, 0.6, 0.8, 0.95, 1.0}) {
                angles.push_back(angle_at(x));
            }
            std::vector<double> found(angles.size());
            for (const double depth : {0.0, 0.4, 5.0, kDeepest}) {
                light.factors(depth, angles, found.data());
                for (std::size_t i = 0; i < angles.size(); ++i) {
                    EXPECT_TRUE(std::isfinite(found[i]));
                    EXPECT_NEAR(found[i], light.reference(depth, angles[i]), 1e-8)
                        << diameter << ' ' << degree << ' ' << depth << ' ' << i;
                }
            }
        }
    }
}

TEST(ForwardScatteringTable, CoordinatesAreThoseOfAnglesAndDepths) {
    EXPECT_EQ(depth_at(0), 0);
    EXPECT_NEAR(depth_at(1), kDeepest, 1e-10);
    EXPECT_EQ(depth_coordinate(0), 0);
    EXPECT_DOUBLE_EQ(depth_coordinate(1e6), 1);
    EXPECT_NEAR(depth_coordinate(depth_at(0.3)), 0.3, 1e-15);
    EXPECT_EQ(angle_coordinate(0), 0);
    EXPECT_DOUBLE_EQ(angle_coordinate(180), 1);
    EXPECT_NEAR(angle_at(angle_coordinate(60)).one_minus, 0.5, 1e-15);
}

}  // namespace
}  // namespace skybake::forward_scattering
