// From noise to cloud, a row at a time: the formula of cloud_plan.h for vectors.
// cloud_specification is what it equals bit for bit.
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

// values[i] = b of `count` voxels, from their base noise, which stands there before. Returns
// whether any of them is above `level`, which is not negative.
bool shape_base(const SliceShape& slice, const ColumnRow& columns, float level, std::size_t count,
                float* values);

// values[i] = v from b and the detail noise; 0 where b is not above `level`.
void erode(const SliceShape& slice, const float* detail, float level, std::size_t count,
           float* values);

// values[i] = max(0, b), and with threshold_in_file the density from it.
void finish(const CloudPlan& plan, std::size_t count, float* values);

}  // namespace skybake::cloud
