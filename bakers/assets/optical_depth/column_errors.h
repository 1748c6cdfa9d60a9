// What a table of columns is worth, in transmittance: of each kind alone, and of all together, with
// the layers' own extinction in each colour channel.
#pragma once

#include <vector>

#include "bakers/assets/optical_depth/column_kinds.h"
#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/field/baked.h"

namespace skybake {

// Of the mean densities of each kind, transmittances of a path in this order: all kinds together in
// each of `channels` colours, then each kind alone.
std::vector<double> transmittances(const std::vector<ColumnKind>& kinds, int channels,
                                   double length_km, const std::vector<double>& mean_densities);

// A stored table as a runtime looks it up.
class StoredColumns {
  public:
    // All must outlive it. `channels` is the count of colours.
    StoredColumns(const std::vector<ColumnKind>& kinds, int channels, const ColumnTable& table,
                  const Level& level, config::PixelType type);

    // As transmittances().
    std::vector<double> transmittances_of(const ColumnPath& path) const;
    std::vector<double> exact_transmittances_of(const ColumnPath& path) const;

  private:
    const std::vector<ColumnKind>& kinds_;
    int channels_;
    const ColumnTable& table_;
    const Level& level_;
    config::PixelType type_;
};

struct ColumnErrors {
    ErrorFigures together;
    std::vector<ErrorFigures> alone;  // of each kind
    // T(a to c) - T(a to b) T(b to c), b on the way. Of tables to the top the first factor is
    // exact.
    ErrorFigures additivity;
    ErrorFigures symmetry;  // T(a to b) - T(b to a): 0 of tables to the top
    int points = 0;
};

// At `points` of the fixed set of places, colours and (the last two) kinds pooled.
ColumnErrors measure_columns(const std::vector<ColumnKind>& kinds, int channels,
                             const ColumnTable& table, bool to_top, const Level& level,
                             config::PixelType type, int points);

}  // namespace skybake
