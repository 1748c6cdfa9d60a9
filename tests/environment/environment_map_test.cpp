#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "bakers/assets/environment/environment_lights.h"
#include "bakers/assets/environment/environment_sun.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/assets/environment/sphere_harmonics.h"
#include "bakers/light/sky_irradiance.h"
#include "tests/environment/maps.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using config::EnvironmentBake;
using config::EnvironmentMapping;
using config::SkyOrders;
using test::kDegree;
using test::kPi;
using test::TestSky;

EnvironmentBake bake_of(EnvironmentMapping mapping, std::array<int, 2> size, double sun) {
    EnvironmentBake bake;
    bake.mapping = mapping;
    bake.size = size;
    bake.sun_elevation = {sun * kDegree};
    return bake;
}

Baked baked(const SkyLight& light, const EnvironmentBake& bake,
            Certification certification = Certification::off) {
    Baked table;
    table.name = "around";
    table.channel_names = {"R", "G", "B"};
    auto outcome =
        bake_environment(light, bake, {.threads = 1, .certification = certification}, table);
    if (!outcome.value) throw std::runtime_error(outcome.diagnostics.front().message);
    return std::move(*outcome.value);
}

const TestSky& earth() {
    static const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::all);
    return sky;
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
            sky_irradiance(earth().light(), 0, std::sin(sun * kDegree), {28, 32, 12});
        const EnvironmentBake bake =
            bake_of(EnvironmentMapping::longitude_latitude, {1024, 512}, sun);
        const Baked map = baked(earth().light(), bake);
        const auto found = level_irradiance(map.image(), {bake.mapping, bake.size});
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / wanted[c], 1, 1e-3) << sun;
    }
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
            sky_irradiance(earth().light(), 0, std::sin(25 * kDegree), {28, 32, 12});
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
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            EXPECT_NEAR(after.texel((x + 16) % 64, y)[1], before.texel(x, y)[1],
                        1e-6 * before.texel(x, y)[1] + 1e-12);
        }
    }
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

TEST(EnvironmentMap, TakesAnySizeCameraAndSun) {
    for (const EnvironmentMapping mapping :
         {EnvironmentMapping::longitude_latitude, EnvironmentMapping::cube,
          EnvironmentMapping::octahedral}) {
        for (const int edge : {1, 3}) {
            for (const double altitude : {0.0, 1e6}) {
                for (const double sun : {90.0, -90.0}) {
                    EnvironmentBake bake =
                        bake_of(mapping,
                                {edge, mapping == EnvironmentMapping::cube ? 6 * edge : edge}, sun);
                    bake.altitude = {1000 * altitude};
                    bake.sun = config::SunInMap::disc;
                    bake.sun_azimuth = {-180 * kDegree};
                    const Baked map = baked(earth().light(), bake);
                    for (const float texel : map.image().texels) {
                        EXPECT_TRUE(std::isfinite(texel) && texel >= 0)
                            << texel << " " << static_cast<int>(mapping) << " " << edge << " "
                            << altitude << " " << sun;
                    }
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

// Of an evenly bright disc of radius R the mean square distance from the middle is R^2 / 2. All of it is
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
    for (int y = 0; y < 18; ++y) {
        for (int x = 0; x < 36; ++x) EXPECT_EQ(map.texel(x, y)[1] > 0, x == 6 && y == 4);
    }
}

}  // namespace
}  // namespace skybake
