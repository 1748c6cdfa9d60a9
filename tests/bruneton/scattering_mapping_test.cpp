#include "bakers/assets/bruneton/scattering_mapping.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bakers/field/image.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using test::log_uniform;
using test::uniform;

constexpr Shell kEarth = {6360, 60};
constexpr auto kCentres = TexelConvention::end_points_on_texel_centres;

double largest_difference(const ScatteringMapping& mapping, int u, int v, int w) {
    const ScatteringCoordinates x = mapping.coordinates(
        mapping.view_of_texel(v, w), mapping.sun_of_texel(u), mapping.nu_of_texel(u));
    const bool meets_ground = v < mapping.half_size();
    const int half = meets_ground ? mapping.half_size() - 1 - v : v - mapping.half_size();
    // On the ground no ray of the lower half has a length: all are the first of its axis.
    const bool is_told = !(meets_ground && w == 0);
    EXPECT_EQ(x.meets_ground, meets_ground);
    return std::max(
        {std::fabs(x.x_nu - texel_coordinate(kCentres, u / mapping.sun_size(), mapping.nu_size())),
         std::fabs(x.x_mu_s -
                   texel_coordinate(kCentres, u % mapping.sun_size(), mapping.sun_size())),
         is_told ? std::fabs(x.x_mu - texel_coordinate(kCentres, half, mapping.half_size()))
                 : x.x_mu,
         std::fabs(x.x_r - texel_coordinate(kCentres, w, mapping.size()[2]))});
}

TEST(ScatteringMapping, ReturnsToEachTexelOfTheDefaultSize) {
    const ScatteringMapping mapping(kEarth, {256, 128, 32}, 8, -0.2);
    double worst = 0;
    for (int w = 0; w < 32; ++w) {
        for (int v = 0; v < 128; ++v) {
            worst = std::max(worst, largest_difference(mapping, (37 * v + 11 * w) % 256, v, w));
        }
    }
    for (int u = 0; u < 256; ++u) {
        worst = std::max(worst, largest_difference(mapping, u, u % 128, 7));
    }
    EXPECT_LE(worst, 1e-12);
}

RC_GTEST_PROP(ScatteringMapping, ReturnsToTexelsOfAnyPlanet, ()) {
    const double radius = log_uniform(50, 1e5);
    const Shell shell = {radius, radius * log_uniform(1e-3, 0.3)};
    const int nu = *rc::gen::inRange(2, 9);
    const std::array<int, 3> size = {nu * *rc::gen::inRange(2, 33), 2 * *rc::gen::inRange(2, 65),
                                     *rc::gen::inRange(2, 33)};
    const ScatteringMapping mapping(shell, size, nu, uniform(-1, -0.01));
    const int u = *rc::gen::inRange(0, size[0]);
    const int v = *rc::gen::inRange(0, size[1]);
    const int w = *rc::gen::inRange(0, size[2]);
    RC_ASSERT(largest_difference(mapping, u, v, w) <= 1e-12);
}

TEST(ScatteringMapping, HasBrunetonsTexels) {
    // x_mu_s = 0 where mu_s = mu_s_min, 1 at the zenith; u = 31 + 32 * 7 is the last.
    const ScatteringMapping mapping(kEarth, {256, 128, 32}, 8, -0.2);
    EXPECT_EQ(mapping.sun_of_texel(0), -0.2);
    EXPECT_EQ(mapping.sun_of_texel(31), 1);
    EXPECT_EQ(mapping.sun_of_texel(32), -0.2);
    EXPECT_EQ(mapping.nu_of_texel(31), -1);
    EXPECT_EQ(mapping.nu_of_texel(255), 1);
    // The horizon is at both ends of v, straight down and straight up are in its middle.
    EXPECT_EQ(mapping.view_of_texel(0, 31).altitude_km, 60);
    const double rho = horizon_distance_km(kEarth, 60);
    EXPECT_NEAR(mapping.view_of_texel(0, 31).length_km, rho, 1e-9);
    EXPECT_NEAR(mapping.view_of_texel(127, 31).length_km, 2 * rho, 1e-9);
    EXPECT_NEAR(mapping.view_of_texel(63, 31).length_km, 60, 1e-12);
    EXPECT_EQ(mapping.view_of_texel(64, 31).length_km, 0);
    EXPECT_NEAR(mapping.view_of_texel(64, 0).length_km, 60, 1e-9);
}

TEST(ScatteringMapping, AgreesWithTheFormulasOf2017) {
    // Written down as published: r, mu, mu_s in doubles, differences of squares and all.
    const double bottom = 6360;
    const double top = 6420;
    const double mu_s_min = -0.2;
    const ScatteringMapping mapping({bottom, top - bottom}, {256, 128, 32}, 8, mu_s_min);
    const double big_h = std::sqrt(top * top - bottom * bottom);
    const auto to_top = [&](double r, double mu) {
        return -r * mu + std::sqrt(r * r * (mu * mu - 1) + top * top);
    };
    for (const double h : {0.3, 4.0, 31.0}) {
        for (const double mu : {-0.9, -0.3, -0.01, 0.02, 0.7}) {
            for (const double sun : {-0.15, 0.0, 0.4, 1.0}) {
                const double r = bottom + h;
                const double rho = std::sqrt(r * r - bottom * bottom);
                const double inside = r * r * (mu * mu - 1) + bottom * bottom;
                ScatteringView view;
                view.altitude_km = h;
                view.s_km = r * mu;
                view.meets_ground = mu < 0 && inside >= 0;
                view.length_km = view.meets_ground ? -r * mu - std::sqrt(inside) : to_top(r, mu);
                const ScatteringCoordinates x = mapping.coordinates(view, sun, 0.25);
                const double low = view.meets_ground ? r - bottom : top - r;
                const double high = view.meets_ground ? rho : rho + big_h;
                const auto a_of = [&](double cosine) {
                    return (to_top(bottom, cosine) - (top - bottom)) / (big_h - (top - bottom));
                };
                const double a = a_of(sun);
                EXPECT_NEAR(x.x_mu, (view.length_km - low) / (high - low), 1e-9);
                EXPECT_NEAR(x.x_mu_s, std::max(1 - a / a_of(mu_s_min), 0.0) / (1 + a), 1e-9);
                EXPECT_NEAR(x.x_r, rho / big_h, 1e-9);
                EXPECT_EQ(x.x_nu, 0.625);
            }
        }
    }
}

TEST(ScatteringMapping, TakesDarkerSunsForTheLast) {
    const ScatteringMapping mapping(kEarth, {256, 128, 32}, 8, -0.2);
    EXPECT_EQ(mapping.coordinates(mapping.view_of_texel(90, 3), -0.21, 0).x_mu_s, 0);
    EXPECT_EQ(mapping.coordinates(mapping.view_of_texel(90, 3), -1, 0).x_mu_s, 0);
}

}  // namespace
}  // namespace skybake
