// Towers that live: each grows, stays and dissolves within the loop of its cloud, and is born anew in
// the next one. So the frame `period` is the frame 0 bit for bit.
//
// With its age a in loops, of a life of g loops of growth, m of maturity and d of decay (the three
// stages of a cumulus of Byers and Braham 1949, "The Thunderstorm"), and with the fade
// f(x) = x^2 (3 - 2 x) on [0, 1], which begins and ends at rest:
//
//   height     h = f(a / g) of the full height until a = g, then 1
//   width      grows_from + (1 - grows_from) h of the full width
//   amplitude  1 - f((a - g - m) / d) of the full amplitude once a >= g + m; 0 once it is dead
//
// The height of a Gaussian is its amplitude. So the integral of a growing tower grows as width squared
// times height, and that of a dissolving one falls as its amplitude; the lower field lets noise eat the
// cloud from its edges. The course of f is chosen for its smoothness.
//
// The wind carries a tower from the place where it was born: by `drift` tiles per loop of its age. Towers
// without a life stand, and drift through whole tiles.
#pragma once

#include <array>
#include <vector>

#include "config/sections/cloud.h"

namespace skybake::cloud {

struct TowerState {
    double height = 1;              // over the full height
    double width = 1;               // over the full width
    double amplitude = 1;           // over the full amplitude; 0 if the tower does not live
    std::array<double, 2> moved{};  // along x and y, in tiles
};

// Returns the state at the cloud's time of a tower that is born at `born`, in loops. It is a pure
// function of the time modulo the period.
TowerState tower_state(const config::TowerLife& tower, double born, const config::Cloud& cloud);

// Returns the towers of a cloud that live at its time.
std::vector<config::Tower> living_towers(const config::Cloud& cloud);

}  // namespace skybake::cloud
