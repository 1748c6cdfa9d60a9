#include "bakers/clouds/tower_life.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace skybake::cloud {

namespace {

using config::Cloud;
using config::Tower;
using config::TowerLife;

// The time since a frame of the loop, in [0, 1) loops.
double loops_since(double born, const Cloud& cloud) {
    const int frame = (cloud.time % cloud.period + cloud.period) % cloud.period;
    const double since = double{1} * frame / cloud.period - born;
    const double loops = since - std::floor(since);
    return loops < 1 ? loops : 0;  // a difference of -1e-17 is rounded to 1
}

double fade(double x) { return x * x * (3 - 2 * x); }

void grow(const TowerLife& tower, double age, TowerState& state) {
    const auto [grows, stays, dissolves] = tower.life;
    const double fading = age - (grows + stays);
    if (age < grows) state.height = fade(age / grows);
    if (fading >= 0) state.amplitude = fading < dissolves ? 1 - fade(fading / dissolves) : 0;
    if (state.height == 0) state.amplitude = 0;
    state.width = tower.grows_from + (1 - tower.grows_from) * state.height;
}

void move(const Cloud& cloud, double loops, TowerState& state) {
    for (std::size_t i = 0; i < 2; ++i) state.moved[i] = cloud.drift[i] * loops;
}

Tower alive(Tower tower, const Cloud& cloud) {
    const TowerState state = tower_state(tower, tower.born, cloud);
    tower.amplitude *= state.height * state.amplitude;
    for (std::size_t i = 0; i < 2; ++i) {
        tower.sigma[i] *= state.width;
        tower.center[i] += state.moved[i];
    }
    return tower;
}

}  // namespace

TowerState tower_state(const TowerLife& tower, double born, const Cloud& cloud) {
    TowerState state;
    if (cloud.period == 0) return state;
    if (!tower.lives()) {
        move(cloud, loops_since(0, cloud), state);
        return state;
    }
    const double age = loops_since(born, cloud);
    grow(tower, age, state);
    move(cloud, age, state);
    return state;
}

std::vector<Tower> living_towers(const Cloud& cloud) {
    std::vector<Tower> towers = cloud.towers;
    for (Tower& tower : towers) tower = alive(std::move(tower), cloud);
    std::erase_if(towers, [](const Tower& tower) { return tower.amplitude == 0; });
    return towers;
}

}  // namespace skybake::cloud
