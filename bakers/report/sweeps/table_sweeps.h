// What a report compares of tables, by asset.
#pragma once

#include <optional>

#include "bakers/air/medium.h"
#include "bakers/air/particles/phase_source.h"
#include "bakers/field/baked.h"
#include "bakers/report/report.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/phase.h"
#include "config/assets/transmittance.h"

namespace skybake {

// About the table that `bake` asks for, which has `size`: sizes, pixel types, content and mapping
// with the exact kernel, and the rules of the papers with several counts of steps. `medium` must
// outlive the sweep.
Sweep transmittance_sweep(const Medium& medium, const config::TransmittanceBake& bake,
                          std::array<int, 2> size, bool quick);

// About the table that `bake` asks for, which has `size` and, where converged, quadrature `level`:
// all levels, sizes, pixel types and mappings, and the quadrature of the paper. `medium` must
// outlive the sweep.
Sweep multiple_scattering_sweep(const Medium& medium, const config::MultipleScatteringBake& bake,
                                std::array<int, 2> size, std::optional<int> level, bool quick,
                                int threads);

// Spacings, sizes and pixel types, and closed forms in place of a table. `baked` is the recipe's
// own table. The source must outlive the sweep.
Sweep phase_sweep(const PhaseSource& source, const config::PhaseBake& bake, const Baked& baked,
                  bool quick);

// Time, error and bytes of each variant of a sweep.

// The rows of a sweep, fronts marked, and notes on variants that were left out. `baked` is the
// recipe's own table, whose metadata the variants' files carry too. None: the user has interrupted.
struct MeasuredSweep {
    std::vector<ReportRow> rows;
    std::vector<std::string> notes;
};
std::optional<MeasuredSweep> measure_sweep(const Sweep& sweep, const Baked& baked, int repetitions,
                                           const ReportOptions& options);

}  // namespace skybake
