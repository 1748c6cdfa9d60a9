// Searches the errors of a volume's lookups (error_search.h).
#pragma once

#include "bakers/field/certify.h"
#include "bakers/field/error_search.h"

namespace skybake {

// Measures trilinear lookups of the stored voxels. Axes are clamped or repeated as level.repeats
// says. `counts.per_row` is not used: each row has one point. If `estimate` is not empty and
// counts.exact is not 0, it is searched in place of the reference. Where the voxels let large
// errors expect is only looked at if there are at most 2^18 of them.
VolumeErrors search_volume(const Level& level, PixelType type, const VolumeReference& reference,
                           const VolumeReference& estimate, const SearchCounts& counts,
                           const BakeOptions& options, const VolumeComparison& comparison);

}  // namespace skybake
