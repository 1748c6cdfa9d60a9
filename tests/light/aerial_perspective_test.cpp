#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bakers/air/optical_depth.h"
#include "bakers/assets/aerial_perspective/aerial_perspective_volume.h"
#include "bakers/light/sky_ray.h"
#include "config/assets/aerial_perspective.h"
#include "tests/light/sky_media.h"
#include "tests/support/bakes.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using config::SkyOrders;
using namespace test;

constexpr Shell kEarth = {6360, 100};

config::AerialPerspectiveBake camera_at(double altitude_km, double pitch_degrees) {
    config::AerialPerspectiveBake bake;
    bake.size = {4, 4, 4};
    bake.altitude = {altitude_km * 1000};
    bake.sun_elevation = {20 * kDegree};
    bake.pitch = {pitch_degrees * kDegree};
    bake.fov = {60 * kDegree};
    bake.aspect = 2;
    bake.view_distance = {64000};
    bake.formats = {config::FileFormat::exr};
    return bake;
}

TEST(AerialCamera, LooksWhereItIsTurned) {
    config::AerialPerspectiveBake bake = camera_at(1, 10);
    bake.heading = {90 * kDegree};
    const AerialCamera camera(bake, kEarth);
    const ViewDirection centre = camera.direction(0.5, 0.5);
    EXPECT_NEAR(centre.mu, std::sin(10 * kDegree), 1e-14);
    EXPECT_NEAR(centre.azimuth_cosine, 0, 1e-14);
    EXPECT_NEAR(camera.direction(0.5, 0).mu, std::sin(40 * kDegree), 1e-14);
    EXPECT_NEAR(camera.direction(0.5, 1).mu, std::sin(-20 * kDegree), 1e-14);
    // The heading turns to the right, so the sun stands to the left.
    EXPECT_GT(camera.direction(0, 0.5).azimuth_cosine, 0);
    EXPECT_LT(camera.direction(1, 0.5).azimuth_cosine, 0);
    EXPECT_EQ(camera.distance_km(0.5, 0.5, 1), 64);
    EXPECT_EQ(camera.distance_km(0.5, 0.5, 0.5), 16);
    bake.heading = {60 * kDegree};
    EXPECT_NEAR(AerialCamera(bake, kEarth).direction(0.5, 0.5).azimuth_cosine, 0.5, 1e-12);
    bake.slices = config::SliceSpacing::linear;
    EXPECT_EQ(AerialCamera(bake, kEarth).distance_km(0.5, 0.5, 0.5), 32);
}

TEST(AerialCamera, LooksStraightUp) {
    const AerialCamera camera(camera_at(0, 90), kEarth);
    const ViewDirection centre = camera.direction(0.5, 0.5);
    EXPECT_NEAR(centre.mu, 1, 1e-15);
    EXPECT_NEAR(centre.sine, 0, 1e-15);
}

// From space the slices begin with the air, on a sphere of radius 6460 km, and end with it or with the
// ground.
TEST(AerialCamera, SlicesBeginWithTheAir) {
    for (const double altitude_km : {100.001, 400.0, 20000.0}) {
        for (const double pitch : {-90.0, -40.0, -20.0, 0.0}) {
            config::AerialPerspectiveBake bake = camera_at(altitude_km, pitch);
            bake.view_distance = {2e7};
            EXPECT_EQ(AerialCamera(bake, kEarth).distance_km(0.3, 0.7, 0), 0) << "at the camera";
            EXPECT_EQ(AerialCamera(bake, kEarth).distance_km(0.3, 0.7, 1), 20000);
            bake.slices_begin = config::SlicesBegin::air;
            const AerialCamera camera(bake, kEarth);
            for (const double v : {0.05, 0.5, 0.95}) {
                const ViewDirection view = camera.direction(0.2, v);
                const auto altitude_at = [&](double d) {
                    return std::hypot(d * view.sine, 6360 + altitude_km + d * view.mu) - 6360;
                };
                const double begin = camera.distance_km(0.2, v, 0);
                const double nearest = -(6360 + altitude_km) * view.mu;
                if (nearest <= 0) {
                    EXPECT_EQ(begin, 0) << "looks away";
                } else if (altitude_at(nearest) > 100) {
                    EXPECT_NEAR(begin, nearest, 1e-8 * nearest) << "misses the air";
                } else {
                    EXPECT_NEAR(altitude_at(begin), 100, 1e-5);
                    EXPECT_LT(begin, nearest);
                    // A ray that leaves the air again ends with it, another one has the ground half way.
                    const bool leaves = altitude_at(nearest) > 0;
                    const double end = camera.distance_km(0.2, v, leaves ? 1 : std::sqrt(0.5));
                    // Slices of rays that graze the air are longer than their way through it.
                    if (altitude_at(nearest) < 99) {
                        EXPECT_NEAR(altitude_at(end), leaves ? 100 : 0, 1e-5);
                    }
                }
            }
        }
    }
    // In the air they begin at the camera, whatever the key says.
    config::AerialPerspectiveBake low = camera_at(50, -20);
    low.slices_begin = config::SlicesBegin::air;
    EXPECT_EQ(AerialCamera(low, kEarth).distance_km(0.5, 0.9, 0), 0);
    EXPECT_EQ(AerialCamera(low, kEarth).distance_km(0.5, 0.9, 1), 64);
}

// The same place of the air, looked up in files whose slices begin at the camera and with the air.
TEST(AerialPerspective, FromSpaceShowsTheAir) {
    const auto baked = [](const std::string& keys) {
        auto outcome = test::bake_first(
            "preset = 'earth_hillaire'\n[bake.air]\nasset = 'aerial_perspective'\n"
            "size = [16, 16, 32]\naltitude = '400 km'\npitch = '-20 deg'\n"
            "view_distance = '20000 km'\nsun_elevation = '10 deg'\npixel_type = 'float'\n" +
                keys,
            {.threads = 2});
        EXPECT_EQ(outcome.diagnostics.size(), keys.empty() ? 0U : 1U);
        for (const auto& one : outcome.diagnostics) EXPECT_EQ(one.code, "W0221") << one.message;
        return std::move(outcome.value).value();
    };
    const SkyError from_air = *baked("").certificate.sky;
    const Baked coarse = baked("slices_begin = 'camera'\n");
    EXPECT_LT(from_air.median, 0.1);
    EXPECT_GT(coarse.certificate.sky->median, 1) << "two slices of 32 have air";
    EXPECT_NE(coarse.certificate.advice, "");
}

// Light grows and transmittance falls with distance; far enough they are those of the whole sky.
RC_GTEST_PROP(AerialPerspective, IsThePartOfTheSkyThatIsNearer, ()) {
    const TestSky sky(test::random_atmosphere(), SkyOrders::all);
    const Shell& shell = sky.light().shell();
    const AerialCamera camera(camera_at(uniform(0, 1) * shell.thickness_km, 45), shell);
    const double u = uniform(0, 1);
    const double v = uniform(0, 0.9);
    const double far = 10 * (shell.ground_radius_km + shell.thickness_km);
    std::vector<double> distances = {0};
    for (int i = 1; i <= 6; ++i) distances.push_back(0.2 * i * shell.thickness_km);
    distances.push_back(far);
    const auto values = aerial_perspective(sky.light(), camera, u, v, distances);
    for (std::size_t i = 1; i < values.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            RC_ASSERT(values[i].single[c] >= values[i - 1].single[c]);
            RC_ASSERT(values[i].transmittance[c] <= values[i - 1].transmittance[c]);
        }
    }
    RC_ASSERT(values[0].transmittance == (Spectrum(1.0)));
    const ViewDirection view = camera.direction(u, v);
    // Cut at the same places: how the quadrature depends on them is not for this test to say.
    const SkyRay ray =
        sky_ray(shell, camera.altitude_km(), camera.sun(),
                sky_direction(camera.sun(), view.mu, view.sine, view.azimuth_cosine));
    std::vector<double> in_air;
    for (const double distance : distances) in_air.push_back(std::min(distance, ray.length_km));
    const SkyRadiance whole = sky.light().integrator().up_to(ray, in_air).back();
    for (std::size_t c = 0; c < 3; ++c) {
        RC_ASSERT(std::fabs(values.back().single[c] - whole.single[c]) <= 1e-12 * whole.single[c]);
        RC_ASSERT(std::fabs(values.back().transmittance[c] - whole.transmittance[c]) <= 1e-12);
    }
}

TEST(AerialPerspective, TransmittanceIsThatOfTheWay) {
    const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::single);
    const AerialCamera camera(camera_at(2, 0), sky.light().shell());
    for (const double v : {0.1, 0.45}) {
        const ViewDirection view = camera.direction(0.2, v);
        const Spectrum depth = optical_depth_along(sky.light().medium().air, 2, view.mu, 30);
        const auto found = aerial_perspective(sky.light(), camera, 0.2, v, {30});
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[0].transmittance[c], std::exp(-depth[c]), 1e-12);
        }
    }
}

TEST(AerialPerspective, IsContinuousWhereTheGroundIs) {
    for (const double altitude : {0.0, 0.002, 2.0, 300.0}) {
        const AerialCamera camera(camera_at(altitude, 0), earth().light().shell());
        std::vector<SkyRadiance> before;
        for (double v = 0.3; v < 1; v += 1.0 / 1024) {
            const auto now = aerial_perspective(earth().light(), camera, 0.4, v, {5, 20, 64, 2500});
            for (std::size_t i = 0; i < before.size(); ++i) {
                for (std::size_t c = 0; c < 3; ++c) {
                    // A step of 1/1024 of the picture: what air there is changes little, but for
                    // the edge of the air against space.
                    EXPECT_NEAR(now[i].transmittance[c], before[i].transmittance[c],
                                altitude < 100 ? 0.02 : 0.2)
                        << altitude << " v " << v << " distance " << i;
                }
            }
            before = now;
        }
    }
}

TEST(AerialPerspective, TakesAnyCameraAndNoAir) {
    const TestSky vacuum(test::preset_atmosphere("vacuum"), SkyOrders::single);
    for (const double altitude : {0.0, 1e-3, 50.0, 100.0, 100.001, 1e5}) {
        for (const double pitch : {-90.0, -30.0, 0.0, 30.0, 90.0}) {
            const AerialCamera camera(camera_at(altitude, pitch), earth().light().shell());
            for (const double v : {0.0, 0.5, 1.0}) {
                for (const SkyRadiance& value :
                     aerial_perspective(earth().light(), camera, 0.5, v, {0, 1, 1000, 1e6})) {
                    for (std::size_t c = 0; c < 3; ++c) {
                        EXPECT_TRUE(std::isfinite(value.total()[c]));
                        EXPECT_GT(value.transmittance[c], 0);
                        EXPECT_LE(value.transmittance[c], 1);
                    }
                }
                const auto none = aerial_perspective(vacuum.light(), camera, 0.5, v, {1000});
                EXPECT_EQ(none[0].total(), Spectrum{});
                EXPECT_EQ(none[0].transmittance, (Spectrum(1.0)));
            }
        }
    }
}

TEST(AerialPerspective, IsBakedByARecipe) {
    const config::Recipe recipe = test::recipe_of(
        "preset = 'earth_hillaire'\n[bake.air]\nasset = 'aerial_perspective'\nsize = [4, 6, 8]\n"
        "orders = 'single'\nsun_elevation = '20 deg'\naltitude = '1 km'\npixel_type = 'float'\n"
        "[bake.shade]\nasset = 'aerial_perspective'\nsize = [4, 6, 8]\n"
        "content = 'transmittance'\nsun_elevation = '20 deg'\naltitude = '1 km'\n"
        "pixel_type = 'float'\n");
    std::vector<std::vector<float>> channels;
    for (const config::Bake& bake : recipe.parameters.bakes) {
        const auto baked = bake_asset(recipe, bake, {.threads = 2});
        ASSERT_TRUE(baked.value);
        const Baked& volume = *baked.value;
        EXPECT_EQ(volume.levels[0].repeats, (std::array<bool, 3>{}));
        EXPECT_TRUE(volume.certified);
        EXPECT_LT(volume.certificate.texel.max, 1e-6);
        const auto values = testing::planes_of(volume);
        channels.insert(channels.end(), values.begin(), values.end());
    }
    // R, G, B, A of the one, R, G, B of the other.
    ASSERT_EQ(channels.size(), 7u);
    for (std::size_t i = 0; i < channels[0].size(); ++i) {
        const double mean = (double{channels[4][i]} + channels[5][i] + channels[6][i]) / 3;
        EXPECT_NEAR(channels[3][i], mean, 1e-6);
    }
}

}  // namespace
}  // namespace skybake
