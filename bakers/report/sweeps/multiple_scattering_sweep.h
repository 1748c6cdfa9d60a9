// What a report compares for `asset = "multiple_scattering"`.
#pragma once

#include <optional>

#include "bakers/air/medium.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/assets/multiple_scattering.h"

namespace skybake {

// About the table that `bake` asks for, which has `size` and, where converged, quadrature `level`:
// all levels, sizes, pixel types and mappings, and the quadrature of the paper. `medium` must
// outlive the sweep.
Sweep multiple_scattering_sweep(const Medium& medium, const config::MultipleScatteringBake& bake,
                                std::array<int, 2> size, std::optional<int> level, bool quick,
                                int threads);

}  // namespace skybake
