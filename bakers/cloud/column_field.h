// What a cloud has over its ground plan: towers, coverage and type, column by column.
#pragma once

#include <vector>

#include "bakers/cloud/cloud_plan.h"
#include "bakers/core/aligned_floats.h"

namespace skybake::cloud {

// Columns x ... x + width - 1, y ... y + rows - 1, rows of `width` values.
struct Columns {
    int width = 0;
    int rows = 0;
    AlignedFloats towers;       // T
    AlignedFloats offset;       // c - 1
    AlignedFloats second_type;  // with a type map: P = p0 + second (p1 - p0) + third (p2 - p1)
    AlignedFloats third_type;
};

// The columns of the plan. Each is a pure function of its place, rounded to float once.
Columns make_columns(const CloudPlan& plan, int first_x, int width, int first_y, int rows);

}  // namespace skybake::cloud
