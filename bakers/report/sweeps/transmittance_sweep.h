// What a report compares for `asset = "transmittance"`.
#pragma once

#include "bakers/air/medium.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/assets/transmittance.h"

namespace skybake {

// About the table that `bake` asks for, which has `size`: sizes, pixel types, content and mapping
// with the exact kernel, and the rules of the papers with several counts of steps. `medium` must
// outlive the sweep.
Sweep transmittance_sweep(const Medium& medium, const config::TransmittanceBake& bake,
                          std::array<int, 2> size, bool quick);

}  // namespace skybake
