// Higher orders by Bruneton's iteration: order after order on the table's own grid. It is slow and
// simple, and serves as a baseline for comparison.
//
// For each order from the second on it computes the light of the order before that every texel's
// point scatters towards the texel's direction, by 16 x 32 directions; the integral of that along
// the texel's ray, by 50 steps of the trapezoidal rule; and the irradiance of the ground by the
// order before, by 32 x 64 directions above the horizon. Light between texels is linear in the
// table's coordinates. Cosines between view and sun that no directions have are replaced by the
// nearest that some have. Transmittances and the first order are exact, where Bruneton uses tables
// of them.
//
// The source is algorithm 4.1 of Bruneton & Neyret 2008; the counts are those of the implementation
// of 2017.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// The number of orders in Bruneton's implementation, which "all" stands for in this method.
inline constexpr int kIteratedOrders = 4;

// Returns the sum of orders 2 to `orders` of each texel in 1/sr, for a solar irradiance of 1, u
// fastest. It is incomplete after an interruption.
std::vector<Spectrum> iterated_scattering(const SkyMedium& medium, const ScatteringMapping& mapping,
                                          int orders, const BakeOptions& options);

}  // namespace skybake
