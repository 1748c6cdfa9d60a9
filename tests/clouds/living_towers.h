// Towers that live, what their fields are, and the law of their lives in other words.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "bakers/clouds/tower_field.h"
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

// Wide, and near the middle of the tile.
inline config::Tower living_tower() {
    config::Tower tower = test::tower(0.48, 0.51, 0.2, 0.17, 1.5);
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

// The law of tower_field.h in other words: a fade is what is left of another one that runs backwards, time is
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
    for (std::size_t i = 0; i < 2; ++i) state.moved[i] = age * cloud.drift[i];
    return state;
}

// Fields of towers over a grid of places.
inline std::vector<double> fields_of(const config::Cloud& cloud) {
    constexpr int kPlaces = 24;
    std::vector<double> x;
    for (int i = 0; i < kPlaces; ++i) x.push_back((i + 0.5) / kPlaces);
    const cloud::TowerField towers(cloud::living_towers(cloud));
    std::vector<double> values;
    for (const double y : x) {
        std::vector<double> row(x.size(), 0.0);
        towers.add_row(y, x, row.data());
        values.insert(values.end(), row.begin(), row.end());
    }
    return values;
}

inline config::Cloud lively_cloud(int period) {
    config::Cloud cloud = looping_cloud(period);
    cloud.drift = {0.3, -0.7};
    cloud.towers = {living_tower(), living_gaussian()};
    cloud.towers[1].born = 0.37;
    return cloud;
}

}  // namespace skybake::test
