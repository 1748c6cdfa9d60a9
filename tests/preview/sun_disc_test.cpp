#include "bakers/render/sun_disc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bakers/render/sky_rays.h"
#include "tests/preview/skies.h"
#include "tests/support/loops.h"

namespace skybake {
namespace {

using test::earth;

constexpr double kRadians = std::numbers::pi / 180;

// A picture of the sun alone, around azimuth 0.
Image2<float> picture_of(const SkyView& view, Glare glare) {
    Image2<float> picture(view.width, view.height, earth().tables.transmittance.channels);
    add_sun(earth().medium, earth().tables, view, glare, picture);
    return picture;
}

SkyView panorama(int width, int height, double lowest, double highest, double sun) {
    SkyView view = test::panorama(1, 0.2, sun);
    view.width = width;
    view.height = height;
    view.lowest_degrees = lowest;
    view.highest_degrees = highest;
    return view;
}

// The irradiance, on a surface that faces the sun, of all light in a panorama.
double light_of(const Image2<float>& picture, const SkyView& view) {
    const double across = 2 * std::numbers::pi / view.width;
    const double up = (view.highest_degrees - view.lowest_degrees) * kRadians / view.height;
    double light = 0;
    testing::for_each_texel(view.width, view.height, [&](int x, int y) {
        const double mu = direction_at(view, x, y)->mu;
        light += across * up * std::sqrt(1 - mu * mu) * double{*picture.texel(x, y)};
    });
    return light;
}

double sunlight(double sun_degrees) {
    const Shell shell = shell_of(earth().medium.air);
    const double r = shell.ground_radius_km + 0.2;
    return look_up_sunlight(earth().tables, shell, 0.2, r * std::sin(sun_degrees * kRadians))[0];
}

// Cox 2000 (Allen's Astrophysical Quantities) has a polynomial for 550 nm.
TEST(LimbDarkening, IsThatOfAllensQuantities) {
    const double middle = limb_darkening(0, 550);
    for (double mu = 0.3; mu <= 1; mu += 0.1) {
        const double published = 0.3 + 0.93 * mu - 0.23 * mu * mu;
        const double found = limb_darkening(std::sqrt(1 - mu * mu), 550) / middle;
        EXPECT_NEAR(found, published, 0.02) << mu;
    }
}

TEST(LimbDarkening, KeepsTheDiscsLightAndReddensItsLimb) {
    for (const double nm : {440.0, 550.0, 680.0}) {
        double light = 0;
        for (int i = 0; i < 20000; ++i) light += limb_darkening(std::sqrt((i + 0.5) / 20000), nm);
        EXPECT_NEAR(light / 20000, 1, 1e-3) << nm;
    }
    EXPECT_GT(limb_darkening(0.95, 680) / limb_darkening(0.95, 440), 1.15);
    EXPECT_LT(limb_darkening(0, 680), limb_darkening(0, 440));
}

// The general disability glare equation of CIE 146:2002 is a simpler fit, for 0.1 to 100 degrees. It
// has 10 / theta^3 where the narrow terms of CIE 135/1 have 14.
TEST(GlareVeil, IsThatOfTheDisabilityGlareEquation) {
    const double of_age = 1 + std::pow(25 / 62.5, 4);
    for (double degrees = 1; degrees < 60; degrees *= 1.5) {
        const double published = 10 / std::pow(degrees, 3) +
                                 (5 / (degrees * degrees) + 0.1 * 0.5 / degrees) * of_age +
                                 0.0025 * 0.5;
        EXPECT_NEAR(glare_veil(degrees) / published, 1, degrees < 3 ? 0.25 : 0.15) << degrees;
    }
}

// A lens scatters a hundredth, which is over the half sphere of directions from which light falls on a
// picture, and by the inverse square of the angle's sine (KenKnight 1984).
TEST(LensVeil, ScattersAHundredthByTheInverseSquare) {
    double light = 0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        const double degrees = 90 * u * u * u;
        light += std::numbers::pi * std::sin(2 * degrees * kRadians) * lens_veil(degrees) * 90 * 3 *
                 u * u / kSteps * kRadians;
    }
    EXPECT_NEAR(light, 0.01, 1e-6);
    EXPECT_NEAR(lens_veil(4) / lens_veil(8),
                std::pow(std::sin(8 * kRadians) / std::sin(4 * kRadians), 2), 0.02);
}

// All glare is before the sun, by the cosine of the angle from it: from 90 degrees on, pictures with it and
// without it are the same. The panorama is at all azimuths around a sun of 30 degrees, so it has texels at 150 degrees from the sun.
TEST(Glare, IsNoneFromARightAngleOn) {
    const SkyView view = panorama(90, 45, -90, 90, 30);
    const Image2<float> plain = picture_of(view, Glare::none);
    for (const Glare glare : {Glare::camera, Glare::eye}) {
        const Image2<float> veiled = picture_of(view, glare);
        int behind = 0;
        testing::for_each_texel(view.width, view.height, [&](int x, int y) {
            const double cosine = direction_at(view, x, y)->cosine_to_sun;
            const float added = *veiled.texel(x, y) - *plain.texel(x, y);
            if (cosine <= 0) {
                EXPECT_EQ(added, 0) << x << ", " << y;
                behind += cosine < -0.86 ? 1 : 0;
            } else if (cosine < 0.97) {  // nearer ones are means over pixels
                const double degrees = std::acos(cosine) / kRadians;
                const double veil = glare == Glare::eye ? glare_veil(degrees) : lens_veil(degrees);
                EXPECT_NEAR(added / (sunlight(30) * cosine * veil), 1, 0.01) << degrees;
            }
        });
        EXPECT_GT(behind, 50);
    }
}

// Next to the disc, an eye's veil is the mean of those of all points of the disc, which a square lattice shows.
TEST(GlareVeil, OfTheDiscIsTheMeanOfItsPoints) {
    constexpr double kDisc = 0.2665;
    constexpr int kLattice = 80;
    const auto mean_veil = [&](double degrees) {
        double sum = 0;
        int count = 0;
        for (int j = 0; j < kLattice; ++j) {
            for (int i = 0; i < kLattice; ++i) {
                const double x = kDisc * (2 * (i + 0.5) / kLattice - 1);
                const double y = kDisc * (2 * (j + 0.5) / kLattice - 1);
                if (std::hypot(x, y) > kDisc) continue;
                sum += glare_veil(std::hypot(degrees - x, y));
                ++count;
            }
        }
        return sum / count;
    };
    const SkyView view = panorama(18000, 1, 29.99, 30.01, 30);
    const Image2<float> picture = picture_of(view, Glare::eye);
    int seen = 0;
    for (int x = 0; x < view.width; ++x) {
        const double degrees = std::acos(direction_at(view, x, 0)->cosine_to_sun) / kRadians;
        if (degrees < 1.3 * kDisc || degrees > 4 * kDisc) continue;
        EXPECT_NEAR(*picture.texel(x, 0) / (sunlight(30) * mean_veil(degrees)), 1, 0.02) << degrees;
        ++seen;
    }
    EXPECT_GT(seen, 50);
}

// All of the light is somewhere: the function of CIE 135/1 with its narrowest term integrates to 1.
TEST(GlareVeil, AndTheNarrowestTermAreAllOfTheLight) {
    const double of_age = 1 - 0.08 * std::pow(25 / 70.0, 4);
    double light = 0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        const double degrees = 90 * u * u * u * u;
        const double width = 90 * 4 * u * u * u / kSteps * kRadians;
        const double narrow = of_age * 9.2e6 / std::pow(1 + std::pow(degrees / 0.0046, 2), 1.5);
        light += 2 * std::numbers::pi * std::sin(degrees * kRadians) * width *
                 (narrow + glare_veil(degrees));
    }
    EXPECT_NEAR(light, 1, 0.05);
}

TEST(SunDisc, HoldsTheSunsLight) {
    for (const int scale : {1, 4, 30}) {
        const SkyView view = panorama(3600 / scale, 240 / scale, 18, 42, 30);
        EXPECT_NEAR(light_of(picture_of(view, Glare::none), view) / sunlight(30), 1, 0.01) << scale;
    }
}

// The veil moves light from the disc to the whole sphere, and loses none of it.
TEST(SunDisc, HoldsTheSunsLightWithItsGlare) {
    const SkyView view = panorama(1800, 900, -90, 90, 30);
    const double disc = light_of(picture_of(view, Glare::none), view);
    for (const Glare glare : {Glare::camera, Glare::eye}) {
        EXPECT_NEAR(light_of(picture_of(view, glare), view) / disc, 1, 0.02);
    }
}

TEST(SunDisc, IsCutByTheHorizon) {
    // From 0.2 km the horizon is 0.454 degrees below the horizontal.
    const SkyView view = panorama(7200, 60, -1.5, 0.5, -0.454);
    const Image2<float> picture = picture_of(view, Glare::none);
    double above = 0;
    for (int y = 0; y < view.height; ++y) {
        const float light = *picture.texel(view.width / 2, y);
        const double degrees = 0.5 - (y + 0.5) / 30;
        const double from_horizon = degrees + 0.454;
        if (from_horizon < -1.0 / 30) {
            EXPECT_EQ(light, 0) << degrees;
        } else if (from_horizon > 1.0 / 30 && from_horizon < 0.2) {
            EXPECT_GT(light, 0) << degrees;
        }
        above += light;
    }
    EXPECT_GT(above, 0);
}

TEST(SunDisc, IsAbsentWhereThePlanetHidesIt) {
    const SkyView view = panorama(360, 90, -10, 35, -4);
    for (const Glare glare : {Glare::none, Glare::eye}) {
        for (const float texel : picture_of(view, glare).texels) ASSERT_EQ(texel, 0);
    }
}

}  // namespace
}  // namespace skybake
