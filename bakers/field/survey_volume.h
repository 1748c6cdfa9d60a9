// Makes one pass over the voxels of a level before anything is written. It gathers what files say
// about them and checks whether a file can hold them.
#pragma once

#include <array>
#include <vector>

#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

inline constexpr int kHistogramBins = 32;

// Fills in statistics, content_hash, peaks and filled of volume.levels[level] from the values as stored,
// and adds to volume.range. histogram_ranges has one pair per channel, lower bound first; the last
// bin includes values equal to the upper bound. The results do not depend on the number of threads.
//
// The first voxel, in the order x, y, z, that the pixel type cannot hold is an error: E0401 if it
// is NaN or infinite, E0402 if it is beyond the type's range. After an interruption
// (options.progress->cancelled()), nothing is filled in and nothing is reported.
//
// `count` asks for the columns along w of the first channel; null: not counted.
struct ColumnCount {
    float above = 0;
    double share = 0;  // of the columns with a stored value above that
};
[[nodiscard]] std::vector<Diagnostic> survey_level(
    Baked& volume, int level, const std::vector<std::array<double, 2>>& histogram_ranges,
    const BakeOptions& options, ColumnCount* count = nullptr);

}  // namespace skybake
