#include "bakers/light/solver/transport.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "bakers/light/solver/solution_levels.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

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
