// Towers that grow, stay, dissolve and drift within a loop.
#include "bakers/clouds/tower_life.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "bakers/clouds/cloud_field.h"
#include "bakers/clouds/cloud_reference.h"
#include "bakers/clouds/dome_field.h"
#include "bakers/clouds/tower_field.h"
#include "tests/clouds/clouds.h"
#include "tests/noise/every_target.h"

namespace skybake::cloud {
namespace {

using config::Cloud;
using config::Tower;
using config::TowerLife;
using std::numbers::pi;
using test::any_number;
using test::plain_cloud;

constexpr std::array<double, 3> kilometre = {1000, 1000, 1000};

Cloud at_time(Cloud cloud, int time) {
    cloud.time = time;
    return cloud;
}

Cloud looping_cloud(int period) {
    Cloud cloud = plain_cloud();
    cloud.period = period;
    return cloud;
}

// 600 m wide and 400 m tall, at most 50 m from the middle of the tile.
Tower living_dome() {
    Tower tower;
    tower.shape = config::TowerShape::dome;
    tower.foot = {{{480}, {510}, {0}}};
    tower.size = {{{600}, {500}, {400}}};
    tower.amplitude = 1.5;
    tower.life = {0.5, 0.25, 0.25};
    return tower;
}

Tower living_gaussian() {
    Tower tower = test::tower(0.4, 0.7, 0.05, 0.08, 2);
    tower.rotation.radians = 0.7;
    tower.correlation = 0.3;
    tower.life = {0.4, 0.2, 0.3};
    return tower;
}

// --- The course of a life -----------------------------------------------------------------------

// f(1/4) = 5/32, f(1/2) = 1/2, f(3/4) = 27/32.
TEST(TowerLife, GrowsStaysAndDissolves) {
    const Cloud cloud = looping_cloud(8);
    const std::array<double, 8> height = {0, 0.15625, 0.5, 0.84375, 1, 1, 1, 1};
    const std::array<double, 8> amplitude = {0, 1, 1, 1, 1, 1, 1, 0.5};
    for (int frame = 0; frame < 8; ++frame) {
        const auto index = static_cast<std::size_t>(frame);
        const TowerState state = tower_state(living_dome(), 0, at_time(cloud, frame));
        EXPECT_EQ(state.height, height[index]) << frame;
        EXPECT_EQ(state.amplitude, amplitude[index]) << frame;
        EXPECT_DOUBLE_EQ(state.width, 0.4 + 0.6 * height[index]) << frame;
    }
}

// The same law in other words: a fade is what is left of another one that runs backwards, time is
// counted in frames since the birth, and stages are left one after the other.
TowerState reference(const TowerLife& life, double born, const Cloud& cloud) {
    const auto rise = [](double x) { return 1 - (1 - x) * (1 - x) * (1 + 2 * x); };
    TowerState state;
    double age = std::remainder(cloud.time - born * cloud.period, cloud.period) / cloud.period;
    if (age < 0) age += 1;
    double left = age;
    state.height = rise(std::min(1.0, left / life.life[0]));
    left = std::max(0.0, left - life.life[0]);
    left = std::max(0.0, left - life.life[1]);
    state.amplitude = rise(1 - std::min(1.0, left / life.life[2]));
    state.width = std::lerp(life.grows_from, 1.0, state.height);
    for (std::size_t i = 0; i < 2; ++i) {
        state.moved[i] = age * cloud.drift[i];
        state.leaned[i] = age * cloud.shear[i];
    }
    return state;
}

TEST(TowerLife, AgreesWithTheReference) {
    EXPECT_TRUE(rc::check([] {
        Cloud cloud = looping_cloud(1);
        cloud.towers = {living_dome()};
        test::let_live(cloud);
        const Tower& tower = cloud.towers[0];
        const TowerState found = tower_state(tower, tower.born, cloud);
        const TowerState wanted = reference(tower, tower.born, cloud);
        // Births that fall on a frame may be rounded to its other side.
        if (found.amplitude == 0 || wanted.height < 1e-9) return;
        RC_ASSERT(std::fabs(found.height - wanted.height) <= 1e-9);
        RC_ASSERT(std::fabs(found.width - wanted.width) <= 1e-9);
        RC_ASSERT(std::fabs(found.amplitude - wanted.amplitude) <= 1e-9);
        for (std::size_t i = 0; i < 2; ++i) {
            RC_ASSERT(std::fabs(found.moved[i] - wanted.moved[i]) <= 1e-9);
            RC_ASSERT(std::fabs(found.leaned[i] - wanted.leaned[i]) <= 1e-9);
        }
    }));
}

TEST(TowerLife, IsNoneWithoutALoop) {
    const TowerState state = tower_state(living_dome(), 0.3, plain_cloud());
    EXPECT_EQ(state.height, 1);
    EXPECT_EQ(state.width, 1);
    EXPECT_EQ(state.amplitude, 1);
    EXPECT_EQ(state.moved, (std::array<double, 2>{}));
}

// --- The loop -----------------------------------------------------------------------------------

// Fields of towers over a grid of places.
std::vector<double> fields_of(const Cloud& cloud) {
    constexpr int kPlaces = 24;
    std::vector<double> x;
    for (int i = 0; i < kPlaces; ++i) x.push_back((i + 0.5) / kPlaces);
    std::vector<double> x_m;
    for (const double tiles : x) x_m.push_back(1000 * tiles);
    const TowerField gaussians(living_gaussians(cloud));
    const DomeField domes(domes_of(cloud), kilometre);
    std::vector<double> values;
    for (int j = 0; j < kPlaces; ++j) {
        std::vector<double> row(x.size(), 0.0);
        gaussians.add_row(x[static_cast<std::size_t>(j)], x, row.data());
        values.insert(values.end(), row.begin(), row.end());
        const double y = x_m[static_cast<std::size_t>(j)];
        for (double z = 100; z < 1000; z += 100) {
            std::fill(row.begin(), row.end(), 0.0);
            raise_row(domes.near({{y, y}, {z, z}}), y, z, x_m, row.data());
            values.insert(values.end(), row.begin(), row.end());
        }
    }
    return values;
}

Cloud lively_cloud(int period) {
    Cloud cloud = looping_cloud(period);
    cloud.drift = {0.3, -0.7};
    cloud.shear = {0.5, 0.2};
    cloud.towers = {living_dome(), living_gaussian()};
    cloud.towers[0].lobes = 5;
    cloud.towers[1].born = 0.37;
    cloud.scatter.count = 7;
    cloud.scatter.sigma = {0.03, 0.06};
    cloud.scatter.aspect = {1, 2};
    cloud.scatter.amplitude = {0.2, 0.9};
    cloud.scatter.life = {0.2, 0.3, 0.5};
    return cloud;
}

TEST(TowerLoop, RepeatsBitForBit) {
    const Cloud cloud = lively_cloud(12);
    for (const int time : {0, 1, 7, 11}) {
        const std::vector<double> first = fields_of(at_time(cloud, time));
        for (const int loops : {1, -1, 80000000}) {
            EXPECT_EQ(fields_of(at_time(cloud, time + 12 * loops)), first) << time;
        }
        EXPECT_NE(fields_of(at_time(cloud, time + 1)), first) << time;
    }
}

// A birth that is put off by a frame puts everything off by a frame.
TEST(TowerLoop, BeginsAtTheBirth) {
    Cloud cloud = looping_cloud(16);
    cloud.drift = {0.25, 0};
    cloud.towers = {living_dome()};
    Cloud later = cloud;
    later.towers[0].born = 3.0 / 16;
    for (int time = 0; time < 16; ++time) {
        EXPECT_EQ(fields_of(at_time(later, time + 3)), fields_of(at_time(cloud, time))) << time;
    }
}

double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
    return largest;
}

// Ten times as many frames make a tenth of the change between neighbours, also from the last to the
// first: nothing jumps.
TEST(TowerLoop, IsContinuousAllAround) {
    std::array<double, 2> largest{};
    for (const std::size_t i : {0u, 1u}) {
        const int period = i == 0 ? 30 : 300;
        const Cloud cloud = lively_cloud(period);
        std::vector<double> before = fields_of(at_time(cloud, -1));
        for (int time = 0; time < period; ++time) {
            std::vector<double> now = fields_of(at_time(cloud, time));
            largest[i] = std::max(largest[i], largest_change(before, now));
            before = std::move(now);
        }
    }
    EXPECT_GT(largest[0], 0.05);
    EXPECT_LT(largest[1], largest[0] / 5);
}

// --- Mass ---------------------------------------------------------------------------------------

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
        const TowerState state = reference(tower, 0, at_time(cloud, time));
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
            const TowerState state = reference(tower, 0, at_time(cloud, time));
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

// --- Wind ---------------------------------------------------------------------------------------

// A tower that has drifted out of the tile comes in on the other side.
TEST(TowerWind, WrapsAroundTheTile) {
    Cloud drifting = looping_cloud(8);
    drifting.drift = {2.75, -1.5};
    drifting.towers = {living_dome(), living_gaussian()};
    Cloud placed = looping_cloud(8);
    placed.towers = drifting.towers;
    const double moved = 5 / 8.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto within = [&](double place) { return place - std::floor(place); };
        const double tiles = drifting.drift[i] * moved;
        placed.towers[0].foot[i].meters =
            1000 * within(placed.towers[0].foot[i].meters / 1000 + tiles);
        placed.towers[1].center[i] = within(placed.towers[1].center[i] + tiles);
    }
    const auto found = fields_of(at_time(drifting, 5));
    const auto wanted = fields_of(at_time(placed, 5));
    EXPECT_LT(largest_change(found, wanted), 1e-9);
    EXPECT_GT(largest_change(found, fields_of(at_time(drifting, 4))), 0.1);
}

// A standing tower drifts too, by whole tiles per loop.
TEST(TowerWind, CarriesStandingTowers) {
    Cloud cloud = looping_cloud(8);
    cloud.drift = {2, -1};
    cloud.towers = {living_dome()};
    cloud.towers[0].life = {};
    Cloud moved = plain_cloud();
    moved.towers = cloud.towers;
    moved.towers[0].foot[0].meters += 1000 * 2 * 3 / 8.0 - 1000;
    moved.towers[0].foot[1].meters -= 1000 * 3 / 8.0;
    EXPECT_LT(largest_change(fields_of(at_time(cloud, 3)), fields_of(moved)), 1e-9);
    EXPECT_EQ(fields_of(at_time(cloud, 8)), fields_of(at_time(cloud, 0)));
}

TEST(TowerWind, LeansDomesByTheirAge) {
    Cloud cloud = looping_cloud(8);
    cloud.shear = {0.8, -0.4};
    cloud.towers = {living_dome()};
    cloud.towers[0].lean = {0.1, 0};
    const std::vector<Dome> domes = domes_of(at_time(cloud, 4));
    EXPECT_DOUBLE_EQ(domes[0].lean[0], 0.1 + 0.4);
    EXPECT_DOUBLE_EQ(domes[0].lean[1], -0.2);
    EXPECT_EQ(domes[0].foot[0], 480) << "its foot stays";
}

// --- Scattered towers ---------------------------------------------------------------------------

// Of 200 towers 50 are born in each quarter of the loop, so that the whole changes little.
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

// --- Hard cases ---------------------------------------------------------------------------------

TEST(TowerLife, IsFiniteInHardCases) {
    for (const double grows_from : {0.0, 1.0}) {
        for (const auto& life : {std::array{1e-6, 0.0, 1e-6}, std::array{0.5, 0.0, 0.5},
                                 std::array{1e-300, 0.9, 0.1}}) {
            for (const int period : {1, 2, 999983}) {
                Cloud cloud = looping_cloud(period);
                cloud.drift = {16, -16};
                cloud.shear = {10, -10};
                cloud.towers = {living_dome(), living_gaussian()};
                for (Tower& tower : cloud.towers) {
                    tower.life = life;
                    tower.grows_from = grows_from;
                    tower.born = 1;
                }
                for (const int time : {-1000000000, 0, 1, 1000000000}) {
                    for (const double value : fields_of(at_time(cloud, time))) {
                        ASSERT_TRUE(std::isfinite(value));
                        ASSERT_GE(value, 0);
                    }
                }
            }
        }
    }
}

// Voxels of the whole cloud, with a noise that moves too.
TEST(TowerLoop, OfACloudsVoxelsRepeatsBitForBit) {
    test::CloudCase any = test::plain_case({20, 18, 12});
    any.cloud = lively_cloud(6);
    any.base.period = 6;
    any.base.drift = {1, 0, 0};
    const auto voxels_at = [&](int time) {
        any.cloud.time = any.base.time = time;
        return test::filled(CloudField(any.plan()), {{}, any.size}, 1);
    };
    EXPECT_EQ(voxels_at(6), voxels_at(0));
    EXPECT_EQ(voxels_at(-1), voxels_at(5));
    EXPECT_NE(voxels_at(5), voxels_at(0));
}

}  // namespace
}  // namespace skybake::cloud
