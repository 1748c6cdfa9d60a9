#include "bakers/clouds/dome_field.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "bakers/clouds/cloud_reference.h"
#include "tests/clouds/clouds.h"

namespace skybake::cloud {
namespace {

using test::any_dome;
using test::any_number;

constexpr std::array<double, 3> kilometre = {1000, 1000, 1000};

double field_at(const DomeField& field, const std::array<double, 3>& place) {
    const auto [x, y, z] = place;
    double value = 0;
    raise_row(field.near({{y, y}, {z, z}}), y, z, std::array{x}, &value);
    return value;
}

std::vector<Dome> domes_of_tower(const config::Tower& tower) {
    config::Cloud cloud = test::plain_cloud();
    cloud.towers = {tower};
    return domes_of(cloud);
}

config::Tower half_ball() {
    config::Tower tower;
    tower.shape = config::TowerShape::dome;
    tower.foot = {{{500}, {400}, {100}}};
    tower.size = {{{600}, {600}, {300}}};
    tower.amplitude = 2;
    return tower;
}

// Its radius is 300 m: 2 (1 - r^2 / 300^2).
TEST(DomeField, OfAHalfBallDependsOnTheDistanceAlone) {
    const DomeField field(domes_of_tower(half_ball()), kilometre);
    EXPECT_DOUBLE_EQ(field_at(field, {500, 400, 100}), 2);
    EXPECT_DOUBLE_EQ(field_at(field, {650, 400, 100}), 1.5);
    EXPECT_DOUBLE_EQ(field_at(field, {500, 250, 100}), 1.5);
    EXPECT_DOUBLE_EQ(field_at(field, {500, 400, 250}), 1.5);
    EXPECT_NEAR(field_at(field, {500, 580, 340}), 0, 1e-12);
    EXPECT_EQ(field_at(field, {500, 400, 99}), 0) << "below its foot";
    EXPECT_EQ(field_at(field, {500, 400, 401}), 0);
    EXPECT_EQ(field_at(field, {801, 400, 100}), 0);
}

TEST(DomeField, StandsInTheNextTileToo) {
    config::Tower tower = half_ball();
    tower.foot[0].meters = 950;
    const DomeField field(domes_of_tower(tower), kilometre);
    EXPECT_DOUBLE_EQ(field_at(field, {100, 400, 100}), field_at(field, {800, 400, 100}));
    EXPECT_GT(field_at(field, {100, 400, 100}), 0);
}

TEST(DomeField, LeansByItsHeight) {
    config::Tower tower = half_ball();
    tower.lean = {0.5, -0.25};
    const DomeField field(domes_of_tower(tower), kilometre);
    EXPECT_DOUBLE_EQ(field_at(field, {500 + 75, 400 - 37.5, 250}), 1.5);
}

// An anvil is widest at its top, which is flat, and ends there.
TEST(DomeField, OfAnAnvilIsWidestAtItsTop) {
    config::Tower tower = half_ball();
    tower.widest = 1;
    const DomeField field(domes_of_tower(tower), kilometre);
    EXPECT_DOUBLE_EQ(field_at(field, {500, 400, 400}), 2);
    EXPECT_DOUBLE_EQ(field_at(field, {650, 400, 400}), 1.5);
    EXPECT_EQ(field_at(field, {500, 400, 100}), 0);
}

TEST(DomeField, TurnsCounterclockwise) {
    config::Tower tower = half_ball();
    tower.size[1].meters = 200;
    tower.rotation.radians = std::acos(-1.0) / 2;
    const DomeField field(domes_of_tower(tower), kilometre);
    EXPECT_NEAR(field_at(field, {500, 550, 100}), 1.5, 1e-12);
    EXPECT_EQ(field_at(field, {650, 400, 100}), 0);
}

TEST(DomeField, AgreesWithTheReference) {
    int inside = 0;
    EXPECT_TRUE(rc::check([&] {
        config::Cloud cloud = test::plain_cloud();
        cloud.towers = {any_dome(), any_dome()};
        const std::vector<Dome> domes = domes_of(cloud);
        const DomeField field(domes, kilometre);
        for (int i = 0; i < 40; ++i) {
            const std::array<double, 3> place = {any_number(0, 1000), any_number(0, 1000),
                                                 any_number(0, 1000)};
            const double wanted = dome_reference(domes, {1000, 1000}, place);
            // Places are rounded to 1e-12 m, and the least radius is half a metre.
            RC_ASSERT(std::fabs(field_at(field, place) - wanted) <= 1e-10);
            if (wanted > 0) ++inside;
        }
    }));
    EXPECT_GT(inside, 300);
}

TEST(DomeField, RowsAreWhatTheirPlacesAre) {
    EXPECT_TRUE(rc::check([] {
        const DomeField field(domes_of_tower(any_dome()), kilometre);
        std::vector<double> x;
        const int count = *rc::gen::inRange(1, 300);
        for (int i = 0; i < count; ++i) x.push_back((i + 0.5) / count * 1000);
        const double y = any_number(0, 1000);
        const double z = any_number(0, 1000);
        std::vector<double> row(x.size(), 0.0);
        raise_row(field.near({{0, 1000}, {0, 1000}}), y, z, x, row.data());
        for (std::size_t i = 0; i < x.size(); ++i) {
            RC_ASSERT(row[i] == field_at(field, {x[i], y, z}));
        }
    }));
}

// Middles of the lobes of a half ball lie on a smaller half ball, all around.
TEST(Lobes, LieOnAHalfBall) {
    config::Tower tower = half_ball();
    tower.lobes = 400;
    const std::vector<Dome> domes = domes_of_tower(tower);
    ASSERT_EQ(domes.size(), 401u);
    std::array<double, 3> mean{};
    for (std::size_t i = 1; i < domes.size(); ++i) {
        const Dome& lobe = domes[i];
        const double radius = lobe.radii[0];
        EXPECT_GE(radius, 0.3 * 300 - 1e-9);
        EXPECT_LE(radius, 0.55 * 300 + 1e-9);
        EXPECT_DOUBLE_EQ(lobe.height, 2 * radius);
        const std::array<double, 3> from = {lobe.foot[0] - 500, lobe.foot[1] - 400,
                                            lobe.foot[2] + radius - 100};
        EXPECT_NEAR(std::hypot(from[0], from[1], from[2]), 0.65 * 300, 1e-9);
        for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += from[axis] / 400;
    }
    // Five standard deviations of the mean of 400 points of a half ball's surface.
    EXPECT_NEAR(mean[0], 0, 195 / std::sqrt(3.0) / 4);
    EXPECT_NEAR(mean[1], 0, 195 / std::sqrt(3.0) / 4);
    EXPECT_NEAR(mean[2], 195 / 2.0, 195 / std::sqrt(12.0) / 4);
    tower.seed = 1;
    EXPECT_NE(domes_of_tower(tower)[1].foot, domes[1].foot);
}

TEST(Lobes, AreThoseOfTheirTowerWhateverOthersThereAre) {
    config::Cloud cloud = test::plain_cloud();
    cloud.scatter = {{}, {}, 5, 9, {}, {1, 2}, {1, 1}};
    cloud.scatter.shape = config::TowerShape::dome;
    cloud.scatter.width = {{{100}, {400}}};
    cloud.scatter.slenderness = {0.5, 1};
    cloud.scatter.lobes = 3;
    const std::vector<Dome> five = domes_of(cloud);
    ASSERT_EQ(five.size(), 20u);
    cloud.scatter.count = 2;
    const std::vector<Dome> two = domes_of(cloud);
    for (std::size_t i = 0; i < two.size(); ++i) EXPECT_EQ(two[i].foot, five[i].foot);
    for (std::size_t i = 0; i < five.size(); i += 4) {
        EXPECT_GE(five[i].radii[0], 50);
        EXPECT_LE(five[i].radii[0], 200);
        EXPECT_GE(five[i].height, 100 * 0.5);
        EXPECT_LE(five[i].height, 400);
        EXPECT_EQ(five[i].foot[2], 0);
    }
}

}  // namespace
}  // namespace skybake::cloud
