// The variants of tables that a report compares, for each kind of asset, and their measurement.
#pragma once

#include <optional>

#include "bakers/air/medium.h"
#include "bakers/air/particles/phase_source.h"
#include "bakers/report/report.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/phase.h"
#include "config/assets/transmittance.h"

namespace skybake {

struct Baked;

// Returns variants of the table that `bake` asks for, which has the size `size`: other sizes, pixel
// types, contents and mappings with the exact kernel, and the rules of the papers with several
// numbers of steps. `medium` must outlive the sweep.
Sweep transmittance_sweep(const Medium& medium, const config::TransmittanceBake& bake,
                          std::array<int, 2> size, bool quick);

// Returns variants of the table that `bake` asks for, which has the size `size` and, if its method
// is converged, the quadrature level `level`: all levels, sizes, pixel types and mappings, and the
// quadrature of the paper. `medium` must outlive the sweep.
Sweep multiple_scattering_sweep(const Medium& medium, const config::MultipleScatteringBake& bake,
                                std::array<int, 2> size, std::optional<int> level, bool quick,
                                int threads);

// Returns variants with other spacings, sizes and pixel types, and closed forms in place of a
// table. `baked` is the recipe's own table. `source` must outlive the sweep.
Sweep phase_sweep(const PhaseSource& source, const config::PhaseBake& bake, const Baked& baked,
                  bool quick);

// The measurements of a sweep: its rows, with marked fronts, and notes on variants that were left
// out.
struct MeasuredSweep {
    std::vector<ReportRow> rows;
    std::vector<std::string> notes;
};
// Measures a sweep. `baked` is the recipe's own table, whose metadata the variants' files also
// carry. Returns nothing if the user has interrupted.
std::optional<MeasuredSweep> measure_sweep(const Sweep& sweep, const Baked& baked, int repetitions,
                                           const ReportOptions& options);

}  // namespace skybake
