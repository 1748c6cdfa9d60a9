// Layers under the clear sky of a recipe: against the rays of the sky, each integrated by itself, and paths of
// light.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bakers/assets/cloud_light/layer_sky.h"
#include "bakers/assets/cloud_light/radiance_sweep.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/assets/sky_view/sky_view_table.h"
#include "bakers/field/baked.h"
#include "bakers/light/sky_light.h"
#include "config/recipe/recipe.h"
#include "tests/cloud_light/layers.h"
#include "tests/support/outcomes.h"
#include "tests/support/refused.h"

namespace skybake::cloud_light {
namespace {

constexpr double kPi = std::numbers::pi;

BakeOptions on(int threads) { return {.threads = threads}; }

// The recipe has this air, and a cloud of 3 km x 3 km x 1.5 km above 1 km.
std::string recipe_text(const std::string& air, const std::string& elevation,
                        const std::string& more = "") {
    return air +
           "[noise.n]\nsize = [16, 16, 8]\n[noise.n.channels.Y]\ntype = 'perlin'\n"
           "frequency = [2, 2, 1]\nremap = [-1, 1, 0, 1]\n"
           "[clouds.c]\nnoise = 'n'\nextent = ['3 km', '3 km', '1.5 km']\n"
           "base_altitude = '1 km'\nextinction_scale = '2 /km'\n"
           "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 8]\n"
           "[bake.l]\nasset = 'cloud_light'\nof = 'v'\ncontents = 'clear_sky_radiance'\n"
           "sun_elevations = '" +
           elevation + "'\n" + more;
}

config::Recipe recipe_of(const std::string& text) {
    return test::without_errors(config::parse_recipe(text, "clear_sky"));
}

const std::string kEarth = "preset = 'earth_hillaire'\n";
// Air and haze at one wavelength.
const std::string kHaze =
    "preset = 'vacuum'\nwavelengths = '550 nm'\n"
    "[atmosphere.layers.air]\nprofile = 'exponential'\nscale_height = '8 km'\n"
    "scattering = '1.2e-5 /m'\nphase = 'rayleigh'\n"
    "[atmosphere.layers.haze]\nprofile = 'exponential'\nscale_height = '1.2 km'\n"
    "scattering = '4e-5 /m'\nphase = 'henyey_greenstein'\ng = 0.8\n";

CloudLayer layer_under_sky(const config::Recipe& recipe) {
    CloudLayer layer = test::layer_of({2, 2, 2}, 0);
    const auto& bake = recipe.parameters.bakes[1].as<config::CloudLightBake>();
    EXPECT_FALSE(add_sky(recipe.parameters, bake, recipe.parameters.clouds[0], "l", on(2), layer));
    return layer;
}

// The sky of one wavelength is that of rays, each integrated by itself, over their mean.
TEST(ClearSky, OfARecipeIsThatOfItsRays) {
    for (const int degrees : {10, 60}) {
        const config::Recipe recipe = recipe_of(
            recipe_text(kHaze, std::to_string(degrees) + " deg", "sun_azimuths = '70 deg'\n"));
        const CloudLayer layer = layer_under_sky(recipe);
        const SkyLight light(recipe.parameters.atmosphere, config::SkyOrders::all, {}, on(2));
        const SkyViewCamera camera(light.shell(), 2.5);
        const SunZenith sun = sun_at_elevation(degrees * kPi / 180);
        const TableModel rays = sky_view_model(light, camera, sun);
        const auto radiance = [&](double elevation, double azimuth) {
            double value = 0;
            const double turn = std::fabs(std::remainder(azimuth - 70 * kPi / 180, 2 * kPi)) / kPi;
            rays.reference(camera.coordinate(elevation + camera.dip()), {turn}, &value);
            return value;
        };
        double mean = 0;
        constexpr int kRings = 24;
        constexpr int kAround = 48;
        const QuadratureRule rule = gauss_legendre(kRings);
        for (std::size_t i = 0; i < kRings; ++i) {
            for (int k = 0; k < kAround; ++k) {
                mean += rule.weights[i] / kAround *
                        radiance(std::asin(rule.nodes[i]), 2 * kPi * k / kAround);
            }
        }
        for (const double elevation : {0.02, 0.15, 0.5, 1.0, 1.5}) {
            for (const double azimuth : {0.1, 1.0, 2.7, -1.4, -3.0}) {
                const glm::dvec3 look = towards(elevation, azimuth);
                const double wanted = radiance(elevation, azimuth) / mean;
                EXPECT_NEAR(layer.sky.shape(look), wanted, 0.005 * wanted) << elevation;
                EXPECT_NEAR(layer.sky.reference(look), wanted, 0.01 * wanted) << elevation;
            }
        }
        EXPECT_NEAR(mean_radiance(layer.sky.shape), 1, 1e-12);
        EXPECT_NEAR(mean_radiance(layer.sky.reference), 1, 1e-3);
    }
}

// Coefficients of the sky's light, by the direction in which it is seen.
Harmonics coefficients(const std::vector<double>& radiances,
                       const std::vector<SkyDirection>& directions) {
    Harmonics sums{};
    for (std::size_t n = 0; n < directions.size(); ++n) {
        const Harmonics values = harmonics(directions[n].direction);
        for (std::size_t c = 0; c < sums.size(); ++c) {
            sums[c] += radiances[n] * directions[n].solid_angle * values[c];
        }
    }
    return sums;
}

// Compares the light of a sky by the solver's 32 directions up to degree 3, as shares of coefficient 0.
TEST(ClearSky, OfOrdinatesHasNearlyItsCoefficients) {
    const LayerCells cells{CellFields({1, 1, 1}, 1), {1, 1, 1}};
    const std::vector<SkyDirection> ordinates = RadianceSweep(cells, 3, {}).sky_ordinates();
    const std::vector<SkyDirection> fine = sky_directions(64, 256);
    for (const int degrees : {10, 30, 60}) {
        const SkyByDirection sky =
            layer_under_sky(recipe_of(recipe_text(kEarth, std::to_string(degrees) + " deg")))
                .sky.shape;
        std::vector<double> radiances;
        for (const SkyDirection& one : fine) radiances.push_back(sky(one.direction));
        const Harmonics wanted = coefficients(radiances, fine);
        const Harmonics found = coefficients(ordinate_radiances(sky, ordinates), ordinates);
        EXPECT_NEAR(found[0], wanted[0], 1e-3 * wanted[0]) << degrees;
        EXPECT_NEAR(found[2], wanted[2], 1e-3 * wanted[2]) << degrees;  // along the zenith
        double squares = 0;
        for (std::size_t c = 1; c < found.size(); ++c) {
            squares += std::pow((found[c] - wanted[c]) / wanted[0], 2) / 15;
        }
        RecordProperty("rms_" + std::to_string(degrees), std::to_string(std::sqrt(squares)));
        EXPECT_LT(std::sqrt(squares), 0.01) << degrees;
    }
}

double brightest_azimuth(const SkyByDirection& sky, double elevation) {
    double best = 0;
    double most = 0;
    for (int i = 0; i < 360; ++i) {
        const double azimuth = i * kPi / 180;
        const double value = sky(towards(elevation, azimuth));
        if (value <= most) continue;
        most = value;
        best = i;
    }
    return best;
}

TEST(ClearSky, IsBrightestNextToTheSun) {
    for (const int azimuth : {70, 340}) {
        const CloudLayer layer = layer_under_sky(recipe_of(recipe_text(
            kHaze, "30 deg", "sun_azimuths = '" + std::to_string(azimuth) + " deg'\n")));
        EXPECT_NEAR(brightest_azimuth(layer.sky.shape, 0.5), azimuth, 1) << azimuth;
        EXPECT_NEAR(brightest_azimuth(layer.sky.reference, 0.5), azimuth, 1) << azimuth;
    }
}

Baked baked(const std::string& text, int threads) {
    const config::Recipe recipe = recipe_of(text);
    return test::without_errors(
        bake_asset(recipe, recipe.parameters.bakes[1], {threads, Certification::quick}));
}

// Bakes all wavelengths, and colours; certificates measure against paths under the same sky.
TEST(ClearSky, IsBakedAndCertified) {
    for (const char* elevation : {"10 deg", "60 deg"}) {
        const Baked light = baked(recipe_text(kEarth, elevation, "cell = 1\n"), 2);
        EXPECT_GT(light.certificate.lookup.rms, 0);
        EXPECT_LT(light.certificate.lookup.rms, 0.03) << elevation;
        EXPECT_LT(light.certificate.lookup.max, 0.15) << elevation;
    }
    EXPECT_EQ(baked(recipe_text(kEarth, "10 deg"), 1).levels.front().content_hash,
              baked(recipe_text(kEarth, "10 deg"), 3).levels.front().content_hash);
}

// The light along x, from which the sun shines, has the other sign if the sky is turned by half a turn.
TEST(ClearSky, IsToldFromItsFlip) {
    CloudLayer layer = test::layer_of({4, 4, 16}, 1, 0.01);
    layer.sky = layer_under_sky(recipe_of(recipe_text(kEarth, "10 deg"))).sky;
    config::CloudLightBake bake;
    bake.contents = config::CloudLightContents::clear_sky_radiance;
    bake.sun_elevations = {{10 * kPi / 180}};
    const PlaceGrid places = place_grid(layer.size, 1, false);
    const VolumeReference reference = radiance_reference(layer, bake, 2);
    Facts details;
    const auto right = radiance_values(layer, places, bake, on(2), details);
    layer.sky.shape = [sky = layer.sky.shape](const glm::dvec3& d) {
        return sky({-d.x, -d.y, d.z});
    };
    const auto flipped = radiance_values(layer, places, bake, on(2), details);
    constexpr std::size_t kAlongX = 3;
    constexpr int kPlaces = 40;  // differ in the noise of their paths alone
    double wanted = 0;
    for (int i = 0; i < kPlaces; ++i) {
        wanted += reference({(i + 0.5) / kPlaces, 0.6, 14.5 / 16})[kAlongX] / kPlaces;
    }
    const std::size_t at = occupancy::index_of(layer.size, 1, 2, 14);
    EXPECT_LT(wanted, 0);
    EXPECT_NEAR(right[kAlongX][at], wanted, -0.4 * wanted);
    EXPECT_NEAR(flipped[kAlongX][at], -wanted, -0.4 * wanted);
}

TEST(ClearSky, ThatIsBlackIsRefused) {
    const config::Recipe recipe = recipe_of(recipe_text("preset = 'vacuum'\n", "30 deg"));
    test::expect_refused(bake_asset(recipe, recipe.parameters.bakes[1], {1, Certification::off}),
                         "E0189");
}

}  // namespace
}  // namespace skybake::cloud_light
