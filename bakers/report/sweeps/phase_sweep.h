// The variants of a phase table that a report compares: spacings, sizes, pixel types, and closed
// forms in its place.
#pragma once

#include "bakers/air/particles/phase_source.h"
#include "bakers/field/baked.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/assets/phase.h"

namespace skybake {

// `baked` is the recipe's own table. The source must outlive the sweep.
Sweep phase_sweep(const PhaseSource& source, const config::PhaseBake& bake, const Baked& baked,
                  bool quick);

}  // namespace skybake
