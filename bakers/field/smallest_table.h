// Finds the smallest table whose lookups keep within an error bound.
#pragma once

#include <optional>

#include "bakers/field/certify.h"

namespace skybake {

struct TableChoice {
    std::array<int, 2> size{};
    int level = 0;
    double max_error = 0;  // of lookups at the points
};

struct TableSearch {
    std::optional<TableChoice> found;
    TableChoice best;  // what the largest table at the finest level reaches, if none is found
};

// Tries tables of the sizes {4, 6, 8, 12, 16, ... 2048} on each axis (up to 16384 if there is only
// one row) and all quadrature levels, in the order of their cost, texels * cost_per_texel; of equal
// costs, the narrower table comes first. Returns the first one whose stored lookups are within
// `max_error` at every point. The costs are fixed, so the choice is a pure function of the
// parameters.
TableSearch smallest_table(const TableModel& model, double max_error, config::PixelType type,
                           const ReferencePoints& points, const BakeOptions& options);

}  // namespace skybake
