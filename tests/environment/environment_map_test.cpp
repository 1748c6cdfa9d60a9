#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "bakers/assets/environment/environment_sun.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/assets/environment/prefilter.h"
#include "bakers/assets/environment/sphere_harmonics.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/light/sky_irradiance.h"
#include "tests/environment/maps.h"
#include "tests/light/sky_media.h"
#include "tests/support/air_ray.h"
#include "tests/support/loops.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

using config::EnvironmentBake;
using config::EnvironmentMapping;
using namespace test;

EnvironmentBake bake_of(EnvironmentMapping mapping, std::array<int, 2> size, double sun) {
    EnvironmentBake bake = test::map_bake(size, sun);
    bake.mapping = mapping;
    return bake;
}

Baked baked(const SkyLight& light, const EnvironmentBake& bake,
            Certification certification = Certification::off) {
    return test::baked(bake, {}, certification, 1, light);
}

const std::vector<EnvironmentBake>& maps_of_one_sky() {
    static const std::vector<EnvironmentBake> bakes = {
        bake_of(EnvironmentMapping::longitude_latitude, {256, 128}, 25),
        bake_of(EnvironmentMapping::cube, {64, 384}, 25),
        bake_of(EnvironmentMapping::octahedral, {160, 160}, 25)};
    return bakes;
}

// The irradiance of the asset of that name, whose quadrature knows nothing of maps.
TEST(EnvironmentMap, LightsALevelSurfaceAsTheAssetIrradianceSays) {
    for (const double sun : {60.0, 25.0, 3.0, -3.0}) {
        const Spectrum wanted =
            sky_irradiances(earth().light(), 0, {std::sin(sun * kDegree)}, {28, 32, 12}).front();
        const EnvironmentBake bake =
            bake_of(EnvironmentMapping::longitude_latitude, {1024, 512}, sun);
        const Baked map = baked(earth().light(), bake);
        const auto found = level_irradiance(map.image(), {bake.mapping, bake.size});
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / wanted[c], 1, 1e-3) << sun;
    }
}

// Each texel is the integral along its own ray, whose direction stands here in plain trigonometry.
TEST(EnvironmentMap, HoldsWhatTheIntegratorSees) {
    EnvironmentBake bake = test::map_bake({64, 32}, 10);
    bake.altitude = {500};
    const Image2<float> map = baked(earth().light(), bake).image();
    const Shell shell = earth().light().shell();
    for (const auto& [x, y] : {std::pair{0, 3}, {31, 14}, {40, 10}, {63, 12}, {20, 25}, {7, 31}}) {
        const double azimuth = 2 * kPi * ((x + 0.5) / 64 - 0.5);
        const double elevation = kPi * (0.5 - (y + 0.5) / 32);
        const double sun = 10 * kDegree;
        const double cosine = std::sin(elevation) * std::sin(sun) +
                              std::cos(elevation) * std::cos(sun) * std::cos(azimuth);
        const SkyRay ray = test::air_ray(shell, 0.5, std::sin(elevation), std::sin(sun), cosine);
        const Spectrum wanted = earth().light().wanted(earth().light().integrator().radiance(ray));
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(map.texel(x, y)[c], wanted[c], 2e-3 * wanted[c]) << x << " " << y;
        }
    }
}

TEST(EnvironmentMap, IsTheGroundBelowAndNothingAboveWithoutAir) {
    const SkyLight light(test::preset_sky("vacuum", {"atmosphere.ground_albedo=0.5"}),
                         config::SkyOrders::all, nullptr);
    const Image2<float> map = baked(light, test::map_bake({4, 4}, 30)).image();
    EXPECT_EQ(map.texel(1, 0)[0], 0);
    EXPECT_EQ(map.texel(1, 1)[0], 0);
    EXPECT_NEAR(map.texel(1, 2)[0], 0.5 / kPi * 0.5, 1e-7);
    EXPECT_NEAR(map.texel(2, 3)[0], 0.5 / kPi * 0.5, 1e-7);
}

TEST(EnvironmentMap, AllMappingsShowTheSameSky) {
    const SkyViewCamera camera(earth().light().shell(), 0);
    for (const EnvironmentBake& bake : maps_of_one_sky()) {
        const Baked map = baked(earth().light(), bake);
        const EnvironmentLayout layout(bake.mapping, bake.size);
        double squares = 0;
        int count = 0;
        test::for_texels(
            map.image(), layout, [&](const glm::dvec3& direction, double, const float* texel) {
                const MapAngles angles = angles_of(direction);
                if (++count % 97 != 0) return;
                const SunZenith sun = sun_at_elevation(bake.sun_elevation.radians);
                const SkyRay ray = camera.ray(camera.coordinate(angles.elevation + camera.dip()),
                                              sun, std::cos(angles.azimuth));
                const Spectrum wanted =
                    earth().light().wanted(earth().light().integrator().radiance(ray));
                for (std::size_t c = 0; c < 3; ++c) {
                    const double error = wanted[c] > 0 ? texel[c] / wanted[c] - 1 : texel[c];
                    EXPECT_NEAR(error, 0, 1e-2);
                    squares += error * error;
                }
            });
        EXPECT_LT(std::sqrt(squares / (count / 97 * 3)), 1e-3);
        const auto found = level_irradiance(map.image(), layout);
        const Spectrum wanted =
            sky_irradiances(earth().light(), 0, {std::sin(25 * kDegree)}, {28, 32, 12}).front();
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / wanted[c], 1, 3e-3);
    }
}

TEST(EnvironmentMap, TurnsWithTheSun) {
    const EnvironmentBake ahead = bake_of(EnvironmentMapping::longitude_latitude, {64, 32}, 15);
    EnvironmentBake right = ahead;
    right.sun_azimuth = {90 * kDegree};
    const Image2<float> before = baked(earth().light(), ahead).image();
    const Image2<float> after = baked(earth().light(), right).image();
    const auto brightest = [](const Image2<float>& map) {
        int best = 0;
        for (int x = 0; x < map.width; ++x) {
            if (map.texel(x, 13)[0] > map.texel(best, 13)[0]) best = x;
        }
        return best;
    };
    EXPECT_NEAR(brightest(after), 48, 1) << "the sun is to the right";
    testing::for_each_texel(64, 32, [&](int x, int y) {
        EXPECT_NEAR(after.texel((x + 16) % 64, y)[1], before.texel(x, y)[1],
                    1e-6 * before.texel(x, y)[1] + 1e-12);
    });
    // A turn by a right angle takes ahead to right: Y_1,-1 (ahead) becomes Y_1,1 (right).
    const EnvironmentLayout layout(ahead.mapping, ahead.size);
    const auto from = harmonics_of(before, layout)[0];
    const auto to = harmonics_of(after, layout)[0];
    EXPECT_NEAR(to[3], from[1], 1e-6 * from[0]);
    EXPECT_NEAR(to[1], -from[3], 1e-6 * from[0]);
    EXPECT_NEAR(to[8], -from[8], 1e-6 * from[0]);
    for (const std::size_t zonal : {0U, 2U, 6U, 12U, 20U}) {
        EXPECT_NEAR(to[zonal], from[zonal], 1e-6 * from[0]);
    }
}

// All the disc's light is in the texels, however large they are.
TEST(EnvironmentMap, HoldsTheWholeLightOfTheDisc) {
    for (EnvironmentBake bake : maps_of_one_sky()) {
        for (const int share : {1, 8, 16}) {
            EnvironmentBake small = bake;
            small.size = {bake.size[0] / share, bake.size[1] / share};
            small.sun_azimuth = {40 * kDegree};
            const EnvironmentLayout layout(small.mapping, small.size);
            const Image2<float> without = baked(earth().light(), small).image();
            small.sun = config::SunInMap::disc;
            const Image2<float> with = baked(earth().light(), small).image();
            std::array<double, 3> light{};
            glm::dvec3 middle{};
            std::size_t i = 0;
            test::for_texels(
                with, layout, [&](const glm::dvec3& direction, double solid_angle, const float* t) {
                    const double more = double{t[0]} - double{without.texels[i]};
                    middle += more * solid_angle * direction;
                    for (std::size_t c = 0; c < 3; ++c) {
                        light[c] += solid_angle * (double{t[c]} - double{without.texels[i++]});
                    }
                });
            const double r = earth().light().shell().ground_radius_km;
            const Spectrum wanted =
                earth().light().sun_transmittance(0, r * std::sin(25 * kDegree));
            for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(light[c] / wanted[c], 1, 2e-4);
            const glm::dvec3 sun = direction_of_angles({40 * kDegree, 25 * kDegree});
            EXPECT_GT(glm::dot(glm::normalize(middle), sun), 1 - 0.02 * share * share);
        }
    }
}

TEST(EnvironmentMap, TheHorizonCutsTheDisc) {
    const auto facing = [](double sun, double altitude_km) {
        EnvironmentBake bake = bake_of(EnvironmentMapping::longitude_latitude, {4, 2}, sun);
        bake.altitude = {1000 * altitude_km};
        const auto points = sun_points(earth().light(), bake, nullptr);
        return irradiance_of(points, LitSurface::facing_sun, 3)[0];
    };
    EXPECT_EQ(facing(-0.3, 0), 0);
    const double above = facing(0.3, 0);
    EXPECT_GT(above, 0);
    EXPECT_GT(facing(0, 0), 0.2 * above);
    EXPECT_LT(facing(0, 0), 0.7 * above);
    EXPECT_NEAR(facing(30, 1e6), 1, 1e-12) << "no air from space";
    EXPECT_EQ(facing(-90, 1000), 0) << "the planet is before it";
    EXPECT_NEAR(facing(-10, 20000), 1, 1e-12) << "neither planet nor air is before it";
    // From a level surface the sun at the horizon is seen edge on.
    const EnvironmentBake bake = bake_of(EnvironmentMapping::longitude_latitude, {4, 2}, 0);
    const auto points = sun_points(earth().light(), bake, nullptr);
    EXPECT_LT(irradiance_of(points, LitSurface::level, 3)[0], 0.005 * above);
    // From a height the sun is seen below the horizontal, where it lights no level surface.
    EnvironmentBake high = bake_of(EnvironmentMapping::longitude_latitude, {4, 2}, -1);
    high.altitude = {10000};
    const auto below = sun_points(earth().light(), high, nullptr);
    EXPECT_GT(irradiance_of(below, LitSurface::facing_sun, 3)[0], 0.01);
    EXPECT_EQ(irradiance_of(below, LitSurface::level, 3)[0], 0);
}

TEST(EnvironmentMap, SaysItsLights) {
    EnvironmentBake bake = bake_of(EnvironmentMapping::octahedral, {64, 64}, 25);
    bake.lights = true;
    bake.sun_azimuth = {-90 * kDegree};
    const Baked map = baked(earth().light(), bake);
    ASSERT_TRUE(map.companion.has_value());
    EXPECT_EQ(map.companion->format, "json");
    for (const char* word :
         {"\"direction\": [-0.906307787, 0.422618262, ", "\"disc_in_map\": false",
          "\"azimuth_deg\": -90", "\"irradiance_of_level_surface\"", "\"degree\": 4"}) {
        EXPECT_NE(map.companion->text.find(word), std::string::npos) << word << map.companion->text;
    }
    EXPECT_EQ(map.companion->text.find("lux"), std::string::npos) << "channels are no colours";
    EXPECT_NE(fact_named(map.details, "spherical_harmonics_B"), "");
}

// 1 in all channels outside the air is the solar illuminance; half of it is half.
TEST(EnvironmentMap, SaysLuxOfColoursOfTheMeasuredSun) {
    ColorConvention color{"linear_srgb", "sun", "measured", "cie_1931", true};
    EXPECT_NEAR(*lux_of(color, {1, 1, 1}), 133.1e3, 100);
    EXPECT_NEAR(*lux_of(color, {0.5, 0.5, 0.5}), 66.55e3, 50);
    // Green is most of it.
    EXPECT_NEAR(*lux_of(color, {0, 1, 0}) / *lux_of(color, {1, 1, 1}), 0.715, 0.02);
    color.sun = "flat";
    EXPECT_FALSE(lux_of(color, {1, 1, 1}));
    color.sun = "measured";
    color.is_applied = false;
    EXPECT_FALSE(lux_of(color, {1, 1, 1}));
}

TEST(EnvironmentMap, RoughLevelsGoOnFromTheMap) {
    EnvironmentBake bake = bake_of(EnvironmentMapping::cube, {32, 192}, 25);
    bake.mips = 4;
    bake.level_content = config::LevelContent::ggx;
    const Baked map = baked(earth().light(), bake);
    ASSERT_EQ(map.levels.size(), 4U);
    EXPECT_EQ(map.levels[3].size, (std::array<int, 3>{4, 24, 1}));
    EXPECT_EQ(fact_named(map.details, "roughness_of_levels"), "0, 0.333333333, 0.666666667, 1");
    // Roughness takes the brightest texel down, level by level.
    double before = 1e9;
    for (const Level& level : map.levels) {
        const auto& image = static_cast<const DenseTexels&>(*level.voxels).image();
        const double most = *std::max_element(image.texels.begin(), image.texels.end());
        EXPECT_LT(most, before);
        before = most;
    }
}

// A moon or a star in the place of the sun: texels, disc, levels and lights in proportion.
TEST(EnvironmentMap, TakesAnotherSun) {
    config::Recipe recipe = test::recipe_of(
        "preset = 'earth_hillaire'\n[bake.environment]\nsun_elevation = '30 deg'\n"
        "size = [32, 16]\nsun = 'disc'\nlights = true\nmips = 3\nlevel_content = 'ggx'\n"
        "pixel_type = 'float'\n");
    const auto baked_by = [&](std::vector<double> sun) {
        config::Bake& bake = recipe.parameters.bakes.at(0);
        bake.as<EnvironmentBake>().solar_irradiance = std::move(sun);
        auto outcome = bake_asset(recipe, bake, {.threads = 1});
        EXPECT_TRUE(outcome.value) << outcome.diagnostics.front().message;
        return std::move(outcome.value).value();
    };
    const std::vector<double> factors = {0.3, 2, 133100};
    const Baked one = baked_by({});
    const Baked other = baked_by(factors);
    for (std::size_t level = 0; level < 3; ++level) {
        const auto& from = static_cast<const DenseTexels&>(*one.levels[level].voxels).image();
        const auto& to = static_cast<const DenseTexels&>(*other.levels[level].voxels).image();
        for (std::size_t i = 0; i < from.texels.size(); ++i) {
            const double wanted = factors[i % 3] * double{from.texels[i]};
            EXPECT_NEAR(to.texels[i], wanted, 1e-6 * wanted) << level << " " << i;
        }
    }
    EXPECT_EQ(other.conventions.solar_irradiance, factors);
    EXPECT_EQ(other.conventions.radiance_unit, "solar_irradiance/sr");
    EXPECT_NE(one.content.find("for a solar irradiance of 1"), std::string::npos);
    EXPECT_EQ(other.content.find("for a solar irradiance of 1"), std::string::npos);
    EXPECT_NEAR(other.certificate.lookup.rms, one.certificate.lookup.rms,
                1e-3 * one.certificate.lookup.rms);
}

// The paths of light are of a sun of 1, and tell the same error.
TEST(EnvironmentMap, PathsTellTheErrorUnderAnotherSun) {
    const auto sky = [](const std::string& keys) {
        const config::Recipe recipe = test::recipe_of(
            "preset = 'earth_hillaire'\n[bake.environment]\nsun_elevation = '30 deg'\n"
            "size = [64, 32]\n" +
            keys);
        return bake_asset(recipe, recipe.parameters.bakes.at(0), {.threads = 2})
            .value.value()
            .certificate.sky.value();
    };
    const SkyError one = sky("");
    const SkyError moon = sky("solar_irradiance = [0.31, 0.2, 0.1]\n");
    EXPECT_NEAR(moon.median, one.median, 0.1 * one.median);
    EXPECT_NEAR(moon.max, one.max, 0.1 * one.max);
}

// At roughness 1 the sun's part of a texel is E / pi max(n.l, 0). Left and right are equal, and each
// level holds the same light.
TEST(EnvironmentMap, RoughLevelsHoldTheSun) {
    EnvironmentBake bake = bake_of(EnvironmentMapping::longitude_latitude, {256, 128}, 30);
    bake.altitude = {500};
    bake.mips = 6;
    bake.level_content = config::LevelContent::ggx;
    const Baked without = baked(earth().light(), bake);
    bake.sun = config::SunInMap::disc;
    const Baked with = baked(earth().light(), bake);
    const auto irradiance =
        irradiance_of(sun_points(earth().light(), bake, nullptr), LitSurface::facing_sun, 3);
    EXPECT_NEAR(irradiance[0], 0.893, 5e-4);
    const glm::dvec3 to_sun = direction_of_angles({0, 30 * kDegree});
    for (std::size_t level = 0; level < 6; ++level) {
        const auto& image = static_cast<const DenseTexels&>(*with.levels[level].voxels).image();
        const auto& sky = static_cast<const DenseTexels&>(*without.levels[level].voxels).image();
        const EnvironmentLayout layout(bake.mapping, {image.width, image.height});
        const ReflectedLobe lobe(static_cast<double>(std::max<std::size_t>(level, 1)) / 5);
        std::array<double, 3> light{};
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const float* texel = image.texel(x, y);
                const int across = image.width - 1 - x;
                const glm::dvec3 normal =
                    layout.direction(0, (x + 0.5) / image.width, (y + 0.5) / image.height);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double sun = double{texel[c]} - double{sky.texel(x, y)[c]};
                    light[c] += layout.solid_angle(0, x, y) * sun;
                    const double mirrored =
                        double{image.texel(across, y)[c]} - double{sky.texel(across, y)[c]};
                    EXPECT_NEAR(sun, mirrored, 1e-6 * double{texel[c]}) << level;
                    if (level < 2) continue;
                    const double share = lobe.density(glm::dot(normal, to_sun));
                    // A part of the disc may be below a texel's horizon.
                    const bool is_low = std::fabs(glm::dot(normal, to_sun)) < 0.01;
                    EXPECT_NEAR(sun, irradiance[c] * share,
                                0.004 * irradiance[c] * share + (is_low ? 1e-3 : 1e-6))
                        << level << " " << x << " " << y;
                }
            }
        }
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(light[c] / irradiance[c], 1, level < 5 ? 0.005 : 0.02) << level;
        }
    }
}

// The sun stands between the two columns in the middle.
TEST(EnvironmentMap, TheDiscIsSymmetric) {
    for (const double sun : {30.0, 0.1, 75.0}) {
        EnvironmentBake bake = bake_of(EnvironmentMapping::longitude_latitude, {512, 256}, sun);
        bake.sun = config::SunInMap::disc;
        const Image2<float> map = baked(earth().light(), bake).image();
        testing::for_each_texel(256, 256, [&](int x, int y) {
            const float right = map.texel(511 - x, y)[0];
            EXPECT_NEAR(map.texel(x, y)[0], right, 1e-6F * right) << x << " " << y;
        });
    }
}

TEST(EnvironmentMap, TakesAnySizeCameraAndSun) {
    using enum EnvironmentMapping;
    for (const auto& [mapping, size] :
         std::initializer_list<test::MappingCase>{{longitude_latitude, {1, 1}},
                                                  {longitude_latitude, {3, 5}},
                                                  {longitude_latitude, {1, 64}},
                                                  {cube, {1, 6}},
                                                  {cube, {3, 18}},
                                                  {octahedral, {1, 1}},
                                                  {octahedral, {3, 3}}}) {
        for (const double altitude : {0.0, 1.0, 1e5, 1e5 + 0.1, 1e6, 1e9}) {
            for (const double sun : {90.0, 0.0, -6.0, -90.0}) {
                EnvironmentBake bake = bake_of(mapping, size, sun);
                bake.altitude = {altitude};
                bake.sun = config::SunInMap::disc;
                bake.sun_azimuth = {-180 * kDegree};
                const Image2<float> map = baked(earth().light(), bake).image();
                for (const float texel : map.texels) {
                    EXPECT_TRUE(std::isfinite(texel) && texel >= 0)
                        << static_cast<int>(mapping) << " " << altitude << " " << sun;
                }
                // From space there is nothing above the air, but for the sun.
                if (altitude > 1e5 && size[1] == 64 && sun < 90) {
                    EXPECT_EQ(map.texel(0, 0)[2], 0);
                }
            }
        }
    }
}

TEST(EnvironmentMap, CertifiesPartsOfACube) {
    const Baked map = baked(earth().light(), bake_of(EnvironmentMapping::cube, {16, 96}, 25),
                            Certification::quick);
    EXPECT_TRUE(map.certified);
    EXPECT_LT(map.certificate.texel.max, 5e-3);
    EXPECT_GT(map.certificate.texel.max, 0);
    EXPECT_GT(map.certificate.lookup.rms, map.certificate.texel.rms);
    for (const Probe& probe : map.levels[0].probes) {
        EXPECT_GE(probe.uvw[0], 0.5 / 16 - 1e-9);
        EXPECT_LE(probe.uvw[0], 1 - 0.5 / 16 + 1e-9);
    }
}

// In an evenly bright disc of radius R the mean square distance from the middle is R^2 / 2. All of it is
// in the texel in whose middle the sun stands.
TEST(EnvironmentMap, TheDiscIsEvenAndInItsTexel) {
    EnvironmentBake bake = bake_of(EnvironmentMapping::longitude_latitude, {36, 18}, 45);
    bake.sun_azimuth = {-115 * kDegree};
    const auto points = sun_points(earth().light(), bake, nullptr);
    const glm::dvec3 middle = direction_of_angles({-115 * kDegree, 45 * kDegree});
    double squares = 0;
    for (const SunPoint& point : points) {
        squares += std::pow(2 * std::asin(glm::length(point.direction - middle) / 2), 2);
    }
    const double radius = kSunRadius_deg * kDegree;
    EXPECT_NEAR(squares / static_cast<double>(points.size()) / (radius * radius), 0.5, 1e-3);
    Image2<double> map(36, 18, 3);
    add_sun_points(points, {bake.mapping, bake.size}, map);
    testing::for_each_texel(
        36, 18, [&](int x, int y) { EXPECT_EQ(map.texel(x, y)[1] > 0, x == 6 && y == 4); });
}

}  // namespace
}  // namespace skybake
