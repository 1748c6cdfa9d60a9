// The quantities of a cloud that depend only on the place in its ground plan: towers, coverage and
// type, column by column.
#pragma once

#include <cstddef>

#include "bakers/clouds/cloud_plan.h"
#include "bakers/math/memory.h"

namespace skybake::cloud {

// The columns from first_x to first_x + width - 1 and first_y to first_y + rows - 1, in rows of
// `width` values.
struct Columns {
    int first_x = 0;
    int first_y = 0;
    int width = 0;
    int rows = 0;
    AlignedFloats towers;       // T
    AlignedFloats offset;       // c - 1
    AlignedFloats second_type;  // with a type map: P = p0 + second (p1 - p0) + third (p2 - p1)
    AlignedFloats third_type;

    // Returns the index of the plan's column (x, y) in the arrays.
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - first_y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x - first_x);
    }
};

// Makes columns of the plan. Each value is a pure function of its place, rounded to float once.
Columns make_columns(const CloudPlan& plan, int first_x, int width, int first_y, int rows);

}  // namespace skybake::cloud
