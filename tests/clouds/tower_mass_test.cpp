// The integrals of towers that live, each one's and those of many that are born at different times.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/clouds/living_towers.h"

namespace skybake::cloud {
namespace {

using config::Cloud;
using config::Tower;
using std::numbers::pi;
using test::at_time;
using test::living_dome;
using test::living_gaussian;
using test::looping_cloud;
using test::reference_state;

constexpr std::array<double, 3> kilometre = {1000, 1000, 1000};

// The integral of the Gaussians over a tile. Sums over a periodic grid are exact for smooth fields.
double gaussian_mass(const Cloud& cloud) {
    constexpr int kPlaces = 64;
    std::vector<double> x;
    for (int i = 0; i < kPlaces; ++i) x.push_back((i + 0.5) / kPlaces);
    const TowerField field(living_gaussians(cloud));
    double mass = 0;
    for (const double y : x) {
        std::vector<double> row(x.size(), 0.0);
        field.add_row(y, x, row.data());
        for (const double value : row) mass += value / (kPlaces * kPlaces);
    }
    return mass;
}

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
        const double mass = gaussian_mass(at_time(cloud, time));
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

double dome_mass_m3(const Cloud& cloud) {
    constexpr int kPlaces = 80;
    const DomeField field(domes_of(cloud), kilometre);
    const auto place = [](int i) { return (i + 0.5) / kPlaces * 1000; };
    std::vector<double> x;
    for (int i = 0; i < kPlaces; ++i) x.push_back(place(i));
    double mass = 0;
    for (int k = 0; k < kPlaces; ++k) {
        for (int j = 0; j < kPlaces; ++j) {
            std::vector<double> row(x.size(), 0.0);
            const double y = place(j);
            const double z = place(k);
            raise_row(field.near({{y, y}, {z, z}}), y, z, x, row.data());
            for (const double value : row) mass += value;
        }
    }
    return mass * std::pow(1000.0 / kPlaces, 3);
}

// The integral of 1 - s^2 - u^2 - v^2 over a half ellipsoid is 4 pi / 15 times its half axes. Lean
// and drift change nothing in it.
TEST(TowerMass, OfADomeFollowsItsLife) {
    for (const double widest : {0.0, 0.5, 0.8}) {
        Cloud cloud = looping_cloud(24);
        cloud.drift = {0.5, 0.5};
        cloud.shear = {0.6, 0};
        cloud.towers = {living_dome()};
        Tower& tower = cloud.towers[0];
        tower.widest = widest;
        const double full = 4 * pi / 15 * 300 * 250 * 400 * tower.amplitude;
        double before = 0;
        for (int time = 4; time < 24; time += 2) {
            const TowerState state = reference_state(tower, 0, at_time(cloud, time));
            const double mass = dome_mass_m3(at_time(cloud, time));
            EXPECT_NEAR(mass / full, state.width * state.width * state.height * state.amplitude,
                        0.01)
                << time;
            if (time <= 12) {
                EXPECT_GT(mass, before) << time;
            }
            if (time > 18) {
                EXPECT_LT(mass, before) << time;
            }
            before = mass;
        }
    }
}

// A dome that is still flat has flat lobes: its field begins at its foot.
TEST(TowerMass, OfANewbornIsNone) {
    Cloud cloud = looping_cloud(1000000);
    cloud.towers = {living_dome()};
    cloud.towers[0].lobes = 40;
    EXPECT_TRUE(domes_of(cloud).empty());
    const std::vector<Dome> domes = domes_of(at_time(cloud, 5000));
    ASSERT_EQ(domes.size(), 41u);
    for (const Dome& dome : domes) {
        EXPECT_LT(dome.foot[2] + dome.height, 2 * domes[0].height);
        EXPECT_GT(dome.foot[2], -domes[0].height);
    }
}

// Among 200 towers, 50 are born in each quarter of the loop, so that the whole changes little.
TEST(ScatteredTowers, AreBornAllOverTheLoop) {
    Cloud cloud = looping_cloud(20);
    cloud.scatter.count = 200;
    cloud.scatter.sigma = {0.02, 0.02};
    cloud.scatter.aspect = {1, 1};
    cloud.scatter.amplitude = {1, 1};
    cloud.scatter.life = {0.4, 0.3, 0.3};
    std::array<int, 4> quarters{};
    for (int i = 0; i < 200; ++i) {
        const double born = scattered_birth(cloud.scatter, i);
        ++quarters[static_cast<std::size_t>(std::floor(4 * born))];
    }
    EXPECT_EQ(quarters, (std::array<int, 4>{50, 50, 50, 50}));
    double least = 1e9;
    double most = 0;
    for (int time = 0; time < 20; ++time) {
        const double mass = gaussian_mass(at_time(cloud, time));
        least = std::min(least, mass);
        most = std::max(most, mass);
    }
    EXPECT_LT(most / least, 1.02);
}

// Within its share of the loop a birth is uniform, with a variance of 1/12, and it says nothing of the place
// of the tower or of its neighbours in the list. The bounds are four standard deviations wide.
TEST(ScatteredTowers, AreBornAtRandomWithinTheirShares) {
    constexpr int kTowers = 1000;
    config::TowerScatter scatter;
    scatter.count = kTowers;
    scatter.sigma = {0.02, 0.02};
    scatter.aspect = {1, 1};
    scatter.amplitude = {1, 1};
    const std::vector<Tower> towers = scattered_towers(scatter);
    ASSERT_EQ(towers.size(), std::size_t{kTowers});
    double squares = 0;
    std::array<double, 3>
        along_x{};  // with the place of the tower before, its own and the next one's
    for (int i = 1; i + 1 < kTowers; ++i) {
        const double off = kTowers * scattered_birth(scatter, i) - i - 0.5;
        ASSERT_LE(std::fabs(off), 0.5);
        squares += off * off / kTowers;
        for (std::size_t k = 0; k < 3; ++k) {
            const Tower& tower = towers[static_cast<std::size_t>(i) - 1 + k];
            along_x[k] += off * (tower.center[0] - 0.5) / kTowers;
        }
    }
    EXPECT_NEAR(squares, 1 / 12.0, 0.01);
    for (const double covariance : along_x) EXPECT_NEAR(covariance, 0, 0.011);
}

}  // namespace
}  // namespace skybake::cloud
