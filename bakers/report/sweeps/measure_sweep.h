// Time, error and bytes of each variant of a sweep.
#pragma once

#include <optional>

#include "bakers/report/report.h"
#include "bakers/report/sweeps/sweep.h"

namespace skybake {

// The rows of a sweep, fronts marked, and notes on variants that were left out. `baked` is the
// recipe's own table, whose metadata the variants' files carry too. None: the user has interrupted.
struct MeasuredSweep {
    std::vector<ReportRow> rows;
    std::vector<std::string> notes;
};
std::optional<MeasuredSweep> measure_sweep(const Sweep& sweep, const Baked& baked, int repetitions,
                                           const ReportOptions& options);

}  // namespace skybake
