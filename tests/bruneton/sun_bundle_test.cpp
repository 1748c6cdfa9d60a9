// Solved light under a fan of suns against the same light moment by moment, by cubics and by falls.
#include "bakers/assets/bruneton/bundle_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/certificates/random_cases.h"
#include "tests/noise/every_target.h"

namespace skybake {
namespace {

using Phases = std::vector<std::vector<Spectrum>>;  // [layer][degree]

const Shell kEarth = {6360, 100};

Spectrum any_spectrum(test::RandomCase& dice) {
    return {dice.uniform(0, 1), dice.uniform(0, 1), dice.uniform(0, 1), 0};
}

// Light without any order, so that no column stands for its neighbour.
SolvedLight light_of(int degree, test::RandomCase& dice) {
    SolvedLight light;
    light.channels = 3;
    light.altitudes_km = {0, 1, 10, 100};
    light.suns = make_sun_axis(kEarth, 24);
    light.steep.assign(24, 0.0);
    light.light = LightField(4, 24, degree);
    for (double& value : light.light.moments) value = dice.uniform(0.1, 2);
    return light;
}

// Five nodes between `from_km` and `to_km`, three of which scatter solved light.
BundlePiece piece_of(const ScatteringView& view, double from_km, double to_km,
                     test::RandomCase& dice) {
    BundlePiece piece = {from_km, to_km, {}};
    for (std::size_t i = 0; i < piece.nodes.size(); ++i) {
        BundleNode& node = piece.nodes[i];
        node.distance_km =
            from_km + (to_km - from_km) * (static_cast<double>(i) + 0.5) / kBundleNodes;
        node.altitude_km = altitude_along_km(kEarth, view.altitude_km, view.s_km, node.distance_km);
        if (i % 2 == 0) node.coarse_weights = {any_spectrum(dice), any_spectrum(dice)};
    }
    return piece;
}

// The light that is sent for one sun, moment by moment.
Spectrum sun_by_sun(const SolvedLight& light, const Phases& phases, const ScatteringView& view,
                    const BundlePiece& piece, double sun, double nu) {
    std::vector<Spectrum> moments(static_cast<std::size_t>(moment_count(light.degree())));
    std::vector<double> harmonics(moments.size());
    Spectrum sent{};
    for (const BundleNode& node : piece.nodes) {
        if (node.coarse_weights.empty()) continue;
        const double r = kEarth.ground_radius_km + node.altitude_km;
        const double mu = (view.s_km + node.distance_km) / r;
        const double there =
            ((kEarth.ground_radius_km + view.altitude_km) * sun + node.distance_km * nu) / r;
        const double azimuth = (nu - mu * there) / std::sqrt((1 - mu * mu) * (1 - there * there));
        light.moments_at(node.altitude_km, there, moments.data());
        zenith_harmonics(light.degree(), mu, harmonics.data());
        const std::vector<Spectrum>& weights = node.coarse_weights;
        for (std::size_t l = 0, lm = 0; lm < moments.size(); ++l) {
            const Spectrum chi = weights[0] * phases[0][l] + weights[1] * phases[1][l];
            for (int m = 0; m <= static_cast<int>(l); ++m, ++lm) {
                sent += std::cos(m * std::acos(azimuth)) * harmonics[lm] * chi * moments[lm];
            }
        }
    }
    return sent;
}

// Suns from the zenith to midnight, most of them where the axis has its columns.
SunBundle suns_of(const ScatteringView& view, test::RandomCase& dice) {
    const double mu = view.s_km / (kEarth.ground_radius_km + view.altitude_km);
    std::vector<double> suns = {0.9999, 0.99, 0.97, 0.9, -0.1, -0.3, -0.44, -0.5, -0.99};
    while (suns.size() < 37) suns.push_back(dice.uniform(-0.45, 1));
    std::vector<double> nu;
    for (const double sun : suns) {
        const double spread = std::sqrt((1 - mu * mu) * (1 - sun * sun));
        nu.push_back(mu * sun + dice.uniform(-0.99, 0.99) * spread);
    }
    return SunBundle(suns, nu);
}

// Stencils that are steep for no sun, for some and for all of them, and high orders.
TEST(SunBundle, IsAsSunBySun) {
    for (const auto& any : {std::pair{0.0, 4}, {0.0, 13}, {1.0, 4}, {0.4, 4}}) {
        const double share_of_steep = any.first;
        const int degree = any.second;
        test::RandomCase dice(1);
        SolvedLight light = light_of(degree, dice);
        for (double& steep : light.steep) steep = dice.uniform(0, 1) < share_of_steep ? 1 : 0;
        Phases phases(2);
        for (auto& moments : phases) {
            for (int l = 0; l <= degree; ++l) moments.push_back(any_spectrum(dice));
        }
        for (const double altitude_km : {0.0, 30.0}) {
            const double r = kEarth.ground_radius_km + altitude_km;
            const ScatteringView view = {.altitude_km = altitude_km, .s_km = 0.6 * r};
            const BundlePiece piece = piece_of(view, 0.5, 80, dice);
            const SunBundle suns = suns_of(view, dice);
            test::on_every_target([&](const char* target) {
                std::vector<double> made(static_cast<std::size_t>(suns.count) * kChannelSlots);
                add_solved_light(light, phases, kEarth, view, piece, suns, made.data());
                for (std::size_t i = 0; i < static_cast<std::size_t>(suns.wanted); ++i) {
                    const Spectrum wanted =
                        sun_by_sun(light, phases, view, piece, suns.sun_cosines[i], suns.nu[i]);
                    for (std::size_t c = 0; c < kMaxChannels; ++c) {
                        EXPECT_NEAR(made[i * kChannelSlots + c], wanted[c], 1e-9)
                            << target << i << ' ' << share_of_steep << ' ' << degree;
                    }
                }
            });
        }
    }
}

TEST(SunBundle, FillsUpVectorsWithCopies) {
    const SunBundle suns({0.5, 0.25, -0.1}, {0.1, 0.2, 0.3});
    EXPECT_EQ(suns.wanted, 3);
    ASSERT_EQ(suns.count, SunBundle::kBundleStep);
    EXPECT_EQ(suns.sun_cosines.back(), -0.1);
    EXPECT_EQ(suns.nu.back(), 0.3);
}

}  // namespace
}  // namespace skybake
