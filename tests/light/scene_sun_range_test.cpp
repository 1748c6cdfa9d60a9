#include "bakers/light/multiple_scattering_mapping.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bakers/light/sky_ray.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using namespace test;

config::Scene scene_of(double low_km, double high_km, double low_sun, double high_sun) {
    config::Scene scene;
    scene.altitude = {config::Length{low_km * 1000}, config::Length{high_km * 1000}};
    scene.sun_elevation = {config::Angle{low_sun}, config::Angle{high_sun}};
    return scene;
}

TEST(SceneSunRange, IsThatOfTheGrazingRay) {
    const Shell earth = {6360, 100};
    const SunRange range = scene_sun_range(scene_of(0, 3, -10 * kDegree, 20 * kDegree), earth);
    const double psi = std::acos(6360.0 / 6363.0) + std::acos(6360.0 / 6460.0);
    EXPECT_NEAR(range.lowest, std::cos(100 * kDegree + psi), 1e-12);
    EXPECT_NEAR(range.highest, std::cos(70 * kDegree - psi), 1e-12);
    const SunRange all = scene_sun_range(scene_of(0, 3, -90 * kDegree, 90 * kDegree), earth);
    EXPECT_NEAR(all.lowest, -1, 1e-15);
    EXPECT_EQ(all.highest, 1);
}

RC_GTEST_PROP(SceneSunRange, HoldsThePointsOfAllRays, ()) {
    const Shell shell = {log_uniform(10, 1e5), log_uniform(1, 100)};
    const double low = shell.thickness_km * uniform(0, 2);
    const double high = low + shell.thickness_km * uniform(0, 2);
    const double low_sun = uniform(-90, 90) * kDegree;
    const double high_sun = low_sun + uniform(0, 1) * (90 * kDegree - low_sun);
    const SunRange range = scene_sun_range(scene_of(low, high, low_sun, high_sun), shell);
    for (int i = 0; i < 20; ++i) {
        const SunZenith sun = sun_at_elevation(uniform(low_sun, high_sun));
        const double mu = uniform(-1, 1);
        const SkyDirection direction =
            sky_direction(sun, mu, std::sqrt((1 - mu) * (1 + mu)), uniform(-1, 1));
        const SkyRay ray = camera_ray(shell, uniform(low, high), sun, direction).in_air;
        if (!(ray.length_km > 0)) continue;
        const double x = uniform(0, 1) * ray.length_km;
        const double r =
            shell.ground_radius_km + altitude_along_km(shell, ray.altitude_km, ray.s_km, x);
        const double cosine = (ray.sun_s_km + x * ray.cosine_to_sun) / r;
        RC_ASSERT(cosine >= range.lowest - 1e-9);
        RC_ASSERT(cosine <= range.highest + 1e-9);
    }
}

}  // namespace
}  // namespace skybake
