#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "bakers/light/solver/solution_levels.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/transport.h"
#include "bakers/math/quadrature.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

constexpr int kDegree = 10;
constexpr double kPi = std::numbers::pi;

std::vector<double> harmonics_at(double mu) {
    std::vector<double> values(static_cast<std::size_t>(moment_count(kDegree)));
    zenith_harmonics(kDegree, mu, values.data());
    return values;
}

TEST(LightMoments, HarmonicsAreOrthonormal) {
    const QuadratureRule rule = gauss_legendre(24);
    for (int m = 0; m <= kDegree; ++m) {
        for (int l = m; l <= kDegree; ++l) {
            for (int k = m; k <= kDegree; ++k) {
                double sum = 0;
                for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                    const auto y = harmonics_at(2 * rule.nodes[i] - 1);
                    sum += 2 * rule.weights[i] * y[static_cast<std::size_t>(moment_index(l, m))] *
                           y[static_cast<std::size_t>(moment_index(k, m))];
                }
                // The mean square of cos(m phi) over 2 pi.
                sum *= m == 0 ? 2 * kPi : kPi;
                EXPECT_NEAR(sum, l == k ? 1 : 0, 1e-12) << l << ' ' << k << ' ' << m;
            }
        }
    }
}

RC_GTEST_PROP(LightMoments, AddUpToTheCosineBetween, ()) {
    const auto uniform = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    const double a = uniform();
    const double b = uniform();
    const double azimuth = kPi * uniform();
    const double cosine = a * b + std::sqrt((1 - a * a) * (1 - b * b)) * std::cos(azimuth);
    const auto at_a = harmonics_at(a);
    const auto at_b = harmonics_at(b);
    for (int l = 0; l <= kDegree; ++l) {
        double sum = 0;
        for (int m = 0; m <= l; ++m) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            sum += at_a[lm] * at_b[lm] * std::cos(m * azimuth);
        }
        const double expected =
            (2 * l + 1) / (4 * kPi) *
            std::legendre(static_cast<unsigned>(l), std::fmax(-1, std::fmin(1, cosine)));
        RC_ASSERT(std::fabs(sum - expected) < 1e-12);
    }
}

TEST(LightMoments, NormsArePlainLegendreFunctions) {
    for (const double mu : {-0.9, -0.2, 0.0, 0.5, 0.99}) {
        const auto y = harmonics_at(mu);
        const double sine = std::sqrt(1 - mu * mu);
        const auto plain = [&](int l, int m) {
            return y[static_cast<std::size_t>(moment_index(l, m))] / harmonic_norm(l, m);
        };
        EXPECT_NEAR(plain(0, 0), 1, 1e-14);
        EXPECT_NEAR(plain(1, 0), mu, 1e-14);
        EXPECT_NEAR(plain(1, 1), sine, 1e-14);
        EXPECT_NEAR(plain(2, 0), 1.5 * mu * mu - 0.5, 1e-14);
        EXPECT_NEAR(plain(2, 1), 3 * mu * sine, 1e-14);
        EXPECT_NEAR(plain(2, 2), 3 * sine * sine, 1e-14);
    }
}

RC_GTEST_PROP(RayFan, LosesNothing, ()) {
    config::Atmosphere atmosphere = test::random_atmosphere();
    for (config::Layer& layer : atmosphere.layers) layer.scattering = layer.extinction;
    const SkyMedium medium = make_sky_medium(atmosphere);
    const std::vector<double> levels = solution_levels_km(medium.air, 0.5);
    const int level = *rc::gen::inRange<int>(0, static_cast<int>(levels.size()));
    const RayFan fan = make_ray_fan(medium, levels, level, 5, 0.1);
    double directions = 0;
    double cosines = 0;
    for (const FanRay& ray : fan.rays) {
        directions += ray.weight;
        if (ray.mu > 0) cosines += ray.weight * ray.mu;
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = ray.end_transmittance[c];
            for (std::size_t i = 0; i < ray.near.size(); ++i) sum += ray.near[i][c] + ray.far[i][c];
            RC_ASSERT(std::fabs(sum - 1) < 1e-12);
        }
        for (const FanPoint& point : ray.points) {
            RC_ASSERT(point.fraction >= 0 && point.fraction <= 1);
            const auto i = static_cast<std::size_t>(point.level);
            const double altitude = levels[i] + point.fraction * (levels[i + 1] - levels[i]);
            RC_ASSERT(std::fabs(altitude - point.altitude_km) < 1e-9 * medium.air.thickness_km);
        }
    }
    RC_ASSERT(std::fabs(directions - 1) < 1e-13);
    RC_ASSERT(std::fabs(4 * cosines - 1) < 1e-13);  // the irradiance of a sky of radiance 1 is pi
}

}  // namespace
}  // namespace skybake
