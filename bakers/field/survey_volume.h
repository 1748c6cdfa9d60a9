// One pass over the voxels of a level before anything is written: what files say of them, and
// whether a file can hold them.
#pragma once

#include <array>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

inline constexpr int kHistogramBins = 32;

// Fills statistics, content_hash and peaks of volume.levels[level], from the values as stored, and
// adds to volume.range. histogram_ranges has one pair per channel, the second greater than the
// first; the last bin takes values equal to it. The figures do not depend on the number of threads.
//
// The first voxel, in the order x, y, z, that the pixel type cannot hold is an error: E0401 where
// it is NaN or infinite, E0402 where it is beyond the type's range. After an interruption
// (options.progress->cancelled()) nothing is filled and nothing reported.
[[nodiscard]] std::vector<config::Diagnostic> survey_level(
    Baked& volume, int level, const std::vector<std::array<double, 2>>& histogram_ranges,
    const BakeOptions& options);

}  // namespace skybake
