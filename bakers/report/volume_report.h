// Reports of volumes: the part that all have in common, and a function for each kind of asset.
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
    config::Bake bake;                // has the size that the report is about, and one level
    std::array<int, 3> asked_size{};  // what the recipe asks for
    int asked_mips = 1;
    const VolumeSweep& sweep;
    const ReferenceOfSize& reference;
    ComparisonOfSize comparison = {};
    // The number of points to compare if the reference is expensive; 0: as many as for other
    // volumes.
    int points = 0;
    // The repetitions behind the times that the sweep's variants bring along, and what these times
    // mean; 0: the variants bring no times.
    int repetitions = 0;
    std::string timing = {};
};

// Bakes the subject and measures its sweep. Outcomes are those of report_asset.
config::Outcome<AssetReport> report_volume(const config::Recipe& recipe,
                                           const VolumeReportSubject& subject,
                                           const ReportOptions& options);

// Reports Bruneton's tables: for scattering it compares methods, sizes and pixel types
// (bruneton_sweep.h), for other tables sizes and pixel types. With `quick`, sizes are below the
// recipe's own if making that takes seconds. Outcomes of this and the following functions are those
// of report_asset.
config::Outcome<AssetReport> report_bruneton(const config::Recipe& recipe, const config::Bake& bake,
                                             const ReportOptions& options);

// Compares sizes, pixel types and compressions, and reports how much time is saved by not making
// noise in places without cloud.
config::Outcome<AssetReport> report_cloud_volume(const config::Recipe& recipe,
                                                 const config::Bake& bake,
                                                 const ReportOptions& options);

// Compares exact quadrature with sums over more and more shells, of equal thickness and of equal
// attenuation. Densities and phase functions have no sums, so there is nothing to compare.
config::Outcome<AssetReport> report_column_volume(const config::Recipe& recipe,
                                                  const config::Bake& bake,
                                                  const ReportOptions& options);

// Compares sizes, pixel types, octaves and compressions.
config::Outcome<AssetReport> report_noise_volume(const config::Recipe& recipe,
                                                 const config::Bake& bake,
                                                 const ReportOptions& options);

}  // namespace skybake
