// Towers that live, what their fields are, and the law of their lives in other words.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bakers/clouds/dome_field.h"
#include "bakers/clouds/tower_field.h"
#include "bakers/clouds/tower_life.h"
#include "tests/clouds/clouds.h"

namespace skybake::test {

inline config::Cloud at_time(config::Cloud cloud, int time) {
    cloud.time = time;
    return cloud;
}

inline config::Cloud looping_cloud(int period) {
    config::Cloud cloud = plain_cloud();
    cloud.period = period;
    return cloud;
}

// 600 m wide and 400 m tall, at most 50 m from the middle of the tile.
inline config::Tower living_dome() {
    config::Tower tower;
    tower.shape = config::TowerShape::dome;
    tower.foot = {{{480}, {510}, {0}}};
    tower.size = {{{600}, {500}, {400}}};
    tower.amplitude = 1.5;
    tower.life = {0.5, 0.25, 0.25};
    return tower;
}

inline config::Tower living_gaussian() {
    config::Tower tower = test::tower(0.4, 0.7, 0.05, 0.08, 2);
    tower.rotation.radians = 0.7;
    tower.correlation = 0.3;
    tower.life = {0.4, 0.2, 0.3};
    return tower;
}

// The law of tower_life.h in other words: a fade is what is left of another one that runs backwards, time is
// counted in frames since the birth, and stages are left one after the other.
inline cloud::TowerState reference_state(const config::TowerLife& life, double born,
                                         const config::Cloud& cloud) {
    const auto rise = [](double x) { return 1 - (1 - x) * (1 - x) * (1 + 2 * x); };
    cloud::TowerState state;
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

// Fields of towers over a grid of places.
inline std::vector<double> fields_of(const config::Cloud& cloud) {
    constexpr int kPlaces = 24;
    std::vector<double> x;
    for (int i = 0; i < kPlaces; ++i) x.push_back((i + 0.5) / kPlaces);
    std::vector<double> x_m;
    for (const double tiles : x) x_m.push_back(1000 * tiles);
    const cloud::TowerField gaussians(cloud::living_gaussians(cloud));
    const cloud::DomeField domes(cloud::domes_of(cloud), {1000, 1000, 1000});
    std::vector<double> values;
    for (int j = 0; j < kPlaces; ++j) {
        std::vector<double> row(x.size(), 0.0);
        gaussians.add_row(x[static_cast<std::size_t>(j)], x, row.data());
        values.insert(values.end(), row.begin(), row.end());
        const double y = x_m[static_cast<std::size_t>(j)];
        for (double z = 100; z < 1000; z += 100) {
            std::fill(row.begin(), row.end(), 0.0);
            cloud::raise_row(domes.near({{y, y}, {z, z}}), y, z, x_m, row.data());
            values.insert(values.end(), row.begin(), row.end());
        }
    }
    return values;
}

inline config::Cloud lively_cloud(int period) {
    config::Cloud cloud = looping_cloud(period);
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

inline double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
    return largest;
}

}  // namespace skybake::test
