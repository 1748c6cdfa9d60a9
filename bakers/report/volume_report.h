// The report of any volume.
#pragma once

#include <array>
#include <string>

#include "bakers/report/report.h"
#include "bakers/report/sweeps/measure_volume_sweep.h"
#include "bakers/report/sweeps/volume_sweep.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

struct VolumeReportSubject {
    config::Bake bake;                // of the size that the report is about, with one level
    std::array<int, 3> asked_size{};  // what the recipe asks for
    int asked_mips = 1;
    const VolumeSweep& sweep;
    const ReferenceOfSize& reference;
    ComparisonOfSize comparison = {};
    // Of references that are dear; 0: as many as of other volumes.
    int points = 0;
    // Of the times that the sweep's variants bring along, and what these are; 0: they bring none.
    int repetitions = 0;
    std::string timing = {};
};

// Bakes the subject and measures its sweep. As report_asset.
config::Outcome<AssetReport> report_volume(const config::Recipe& recipe,
                                           const VolumeReportSubject& subject,
                                           const ReportOptions& options);

}  // namespace skybake
