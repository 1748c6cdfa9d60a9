// Lookups of solved light, place by place, against their definition in double.
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/assets/cloud_light/march_light.h"
#include "tests/preview/scenes.h"
#include "tests/support/light_in_cloud_reference.h"

namespace skybake {
namespace {

// Places anywhere in an uneven cloud, beyond the middles of its outermost cells too, seen from all around; among
// them are rays a tenth of a degree beside the sun. Points stand for little of their rays.
TEST(LightInCloud, IsItsDefinition) {
    constexpr std::array<int, 3> kSize = {20, 14, 10};
    const CloudMedium medium =
        test::medium_of({1000, 700, 500}, 500, kSize, test::clumped_voxels(kSize, 7, 0.5), 0.01);
    const BakeOptions options{.threads = 2};
    const SunDirection sun{30, 50};
    const auto light =
        cloud_light::MarchLight(medium, cloud_light::kCellsOfPicture, options).under(sun, options);
    ASSERT_TRUE(light);
    const glm::dvec3 to_sun = direction_of(sun.elevation_degrees, sun.azimuth_degrees);
    for (int i = 0; i < 400; ++i) {
        const auto share = [i](double step) { return std::fmod(0.5 + i * step, 1.0); };
        const glm::dvec3 place(share(0.754878), share(0.569840), share(0.618034));
        const double near = i % 4 == 0 ? 0.1 : 400 * share(0.324718);  // degrees
        const glm::dvec3 look = direction_of(sun.elevation_degrees + near * share(0.8191725),
                                             sun.azimuth_degrees + near);
        const double tau = i % 5 == 0 ? 0 : 12 * share(0.6710436);
        const double beyond = tau / 3;
        const double offset = one_minus_cosine(look, to_sun);
        const LitPoint point = {
            {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)},
            static_cast<float>(tau),
            static_cast<float>(beyond),
            0.01F};
        const PointLight found = light_of(*light, lit_ray(*light, look, offset), point);
        const ReferenceLight wanted = reference_light(*light, look, offset, place, {tau, beyond});
        // F is even between two rows of its table; beside the sun it falls by 2 % from the first to the second.
        const double between = i % 4 == 0 ? 0.015 : 0.002;
        const double once = reference_light(*light, look, offset, place, {0, 0}).sun;
        EXPECT_NEAR(found.sun, wanted.sun, 5e-3 * std::fabs(wanted.sun) + between * once) << i;
        EXPECT_NEAR(found.sky, wanted.sky, 1e-5) << i;
        EXPECT_NEAR(found.ground, wanted.ground, 1e-5) << i;
    }
}

}  // namespace
}  // namespace skybake
