// Searches the errors of a table's lookups (error_search.h).
#pragma once

#include "bakers/field/error_search.h"
#include "bakers/field/table_model.h"

namespace skybake {

// Measures bilinear lookups of the stored image against model.reference. If counts.exact is not 0,
// the kernel at the quadrature level is the estimate that is searched. `threads` may be any number.
FoundErrors search_table(const TableModel& model, int level, const Image2<float>& image,
                         const SearchCounts& counts, const BakeOptions& options);

}  // namespace skybake
