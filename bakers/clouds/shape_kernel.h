// Turns noise into cloud, a row at a time: the formulas of cloud_plan.h for vectors. The results
// equal tests/clouds/cloud_specification.h bit for bit.
#pragma once

#include <cstddef>

#include "bakers/clouds/cloud_plan.h"

namespace skybake::cloud {

// The columns of a row.
struct ColumnRow {
    const float* towers = nullptr;
    const float* offset = nullptr;
    const float* second_type = nullptr;  // null without a type map
    const float* third_type = nullptr;
};

// Replaces the base noise in values[0] to values[count - 1] by b. Returns true if any b is above
// `level`, which must not be negative.
bool shape_base(const SliceShape& slice, const ColumnRow& columns, float level, std::size_t count,
                float* values);

// Replaces each b in `values` by v, from b and the detail noise; v is 0 where b is not above
// `level`.
void erode(const SliceShape& slice, const float* detail, float level, std::size_t count,
           float* values);

// Replaces each b in `values` by max(0, b) or, with threshold_in_file, by the density of a slice.
void finish(const CloudPlan& plan, float water, std::size_t count, float* values);

}  // namespace skybake::cloud
