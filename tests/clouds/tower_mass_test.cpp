// The integrals of towers that live.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/clouds/living_towers.h"

namespace skybake::cloud {
namespace {

using config::Tower;
using std::numbers::pi;
using test::at_time;
using test::living_gaussian;
using test::looping_cloud;
using test::reference_state;

// 2 pi sigma_x sigma_y sqrt(1 - correlation^2) a, which width squared and height multiply.
TEST(TowerMass, OfAGaussianFollowsItsLife) {
    Cloud cloud = looping_cloud(40);
    cloud.drift = {0.4, 0.9};
    cloud.towers = {living_gaussian()};
    const Tower& tower = cloud.towers[0];
    const double full =
        2 * pi * tower.sigma[0] * tower.sigma[1] * std::sqrt(1 - 0.3 * 0.3) * tower.amplitude;
    double before = 0;
    for (int time = 0; time < 40; ++time) {
        const TowerState state = reference_state(tower, 0, at_time(cloud, time));
        const double mass =
            test::mean_over_tile(TowerField(living_towers(at_time(cloud, time))), 64, 64);
        EXPECT_NEAR(mass, full * state.width * state.width * state.height * state.amplitude,
                    1e-8 * full);
        const double age = time / 40.0;
        if (age > 0 && age <= 0.4) {
            EXPECT_GT(mass, before) << time;
        } else if (age > 0.6 + 1e-9 && age < 0.9) {
            EXPECT_LT(mass, before) << time;
        }
        before = mass;
    }
    EXPECT_EQ(before, 0) << "it is dead before it is born again";
}

}  // namespace
}  // namespace skybake::cloud
