// The reports of volumes: what all have in common, and what each kind of asset compares.
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
    // Of references that are expensive; 0: as many as of other volumes.
    int points = 0;
    // Of the times that the sweep's variants bring along, and what these are; 0: they bring none.
    int repetitions = 0;
    std::string timing = {};
};

// Bakes the subject and measures its sweep. As report_asset.
config::Outcome<AssetReport> report_volume(const config::Recipe& recipe,
                                           const VolumeReportSubject& subject,
                                           const ReportOptions& options);

// What each kind of asset compares, as report_asset.
//
// Of Bruneton's tables: methods, sizes and pixel types of scattering (bruneton_sweep.h), sizes and
// pixel types of the others. `quick` has sizes below that of a recipe's own where
// making that takes seconds.
config::Outcome<AssetReport> report_bruneton(const config::Recipe& recipe, const config::Bake& bake,
                                             const ReportOptions& options);

// Sizes, pixel types and compressions, and what is saved by not making noise where there is no
// cloud.
config::Outcome<AssetReport> report_cloud_volume(const config::Recipe& recipe,
                                                 const config::Bake& bake,
                                                 const ReportOptions& options);

// Exact quadrature beside sums over shells, of one thickness and of equal attenuation, more and
// more of them. Densities and phase functions have nothing to sum, and nothing to compare.
config::Outcome<AssetReport> report_column_volume(const config::Recipe& recipe,
                                                  const config::Bake& bake,
                                                  const ReportOptions& options);

// Sizes, pixel types, octaves and compressions.
config::Outcome<AssetReport> report_noise_volume(const config::Recipe& recipe,
                                                 const config::Bake& bake,
                                                 const ReportOptions& options);

}  // namespace skybake
