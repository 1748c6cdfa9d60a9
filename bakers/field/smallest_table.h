// Finds the smallest table whose lookups keep within an error bound.
#pragma once

#include <functional>
#include <optional>

#include "bakers/field/certify.h"
#include "bakers/field/error_search.h"

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

// Returns the largest table that a search tries.
std::array<int, 2> largest_table(bool one_row);

// Searches the errors of a table that was made at a quadrature level, for instance by search_table.
using TableCheck = std::function<FoundErrors(int level, const Image2<float>& image)>;

// Tries tables of the sizes {4, 6, 8, 12, 16, ... 2048} on each axis (up to 16384 if there is only
// one row) and all quadrature levels, in the order of their cost, texels * cost_per_texel; of equal
// costs, the narrower table comes first. Returns the first one whose stored lookups are within
// `max_error` at every point and, if there is a check, wherever it looks. Points that the check
// finds are added to those that later tables are tried at. The costs are fixed, so the choice is a
// pure function of the parameters.
TableSearch smallest_table(const TableModel& model, double max_error, TexelRounding rounding,
                           ReferencePoints points, const BakeOptions& options,
                           const TableCheck& check = {});

}  // namespace skybake
