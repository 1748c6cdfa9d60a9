// Higher orders as Bruneton iterates them: order after order on the table's own grid. Slow and
// plain, a baseline to compare with.
//
// Of each order from the second on: what every texel's point scatters of the order before towards
// the texel's direction, by 16 x 32 directions; that along the texel's ray, by 50 steps of the
// trapezoidal rule; and the irradiance of the ground by the order before, by 32 x 64 directions
// above the horizon. Light between texels is linear in the table's coordinates; cosines between
// view and sun that there are not are taken for the nearest that there is. Transmittances and the
// first order are exact, where Bruneton has tables of them.
//
// Bruneton & Neyret 2008, algorithm 4.1; the counts are those of the implementation of 2017.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// How many orders he has: what "all" means to this method.
inline constexpr int kIteratedOrders = 4;

// The sum of orders 2 ... `orders` of each texel in 1/sr, for a solar irradiance of 1, u fastest.
// Unfinished after an interruption.
std::vector<Spectrum> iterated_scattering(const SkyMedium& medium, const ScatteringMapping& mapping,
                                          int orders, const BakeOptions& options);

}  // namespace skybake
