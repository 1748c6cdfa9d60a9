// Searches the largest error of lookups and estimates their root mean square, for tables of any
// number of axes.
//
// Errors are far from uniform: most of a table is smooth, and a terminator, a horizon or the edge
// of a layer crosses few of its cells. So points are drawn where the texels themselves let errors
// expect, with weights that keep the mean square that of the uniform measure. From the largest
// errors found, the search climbs to the largest nearby. If the reference is expensive, a cheaper
// estimate of it is searched in its place; the reference is then evaluated where the estimate found
// the largest errors, and at further points that correct the mean square.
//
// A row holds the coordinates that points share. Points of a row are evaluated together, because
// many references share their work along a row.
//
// The grids have at most three axes; searches draw points in their cells.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Coordinates in [0, 1] along at most three axes. Those of further axes are 0.
using SearchPlace = std::array<double, 3>;

// Returns the edges of as many cells of equal width in [0, 1].
std::vector<double> even_edges(int cells);

// The cells of a grid, between neighbouring edges along each axis.
class SearchGrid {
  public:
    // At most three axes, each with two or more ascending edges in [0, 1]. Without axes there is
    // one cell.
    explicit SearchGrid(std::vector<std::vector<double>> edges);

    std::size_t axes() const { return edges_.size(); }
    std::size_t count() const { return count_; }
    // The cell's share of the volume of all cells.
    double share(std::size_t cell) const;
    // The place at the fractions `within`, from 0 at the cell's lower edges to 1 at its upper ones.
    SearchPlace place(std::size_t cell, const SearchPlace& within) const;
    SearchPlace middle(std::size_t cell) const { return place(cell, {0.5, 0.5, 0.5}); }
    // The cell that holds a place; of two, the upper one.
    std::size_t cell_at(const SearchPlace& place) const;
    // Moves a place along an axis by a number of widths of its cell, at most to the grid's edge.
    SearchPlace moved(const SearchPlace& place, std::size_t axis, double widths) const;

  private:
    std::array<std::size_t, 3> indices(std::size_t cell) const;

    std::vector<std::vector<double>> edges_;
    std::size_t count_ = 1;
};

// The error of a lookup, over all channels.
struct PointError {
    double largest = 0;  // absolute; infinite if it is not a number
    double mean_square = 0;

    // Makes it of one error for each channel.
    static PointError of(const double* errors, std::size_t channels);
};

// Writes the error at each point of a row.
using RowErrors = std::function<void(const SearchPlace& row, const std::vector<SearchPlace>& points,
                                     PointError* errors)>;

struct LookupSearch {
    SearchGrid rows;
    SearchGrid points;   // of each row
    RowErrors exact;     // against the reference
    RowErrors estimate;  // against the cheaper estimate; empty: the reference is searched itself
    // Returns the size that texels let the error in a cell expect; only ratios of these matter.
    std::function<double(std::size_t row_cell, std::size_t point_cell)> expected;
};

// How much is evaluated.
struct SearchCounts {
    int rows = 0;       // rows that are drawn for the mean square
    int per_row = 0;    // points in each row
    int peak_rows = 0;  // rows through the cells where the largest errors are expected
    int climbs = 0;     // places from which the search climbs
    int exact = 0;      // points at which the reference is evaluated, if there is an estimate
};

struct FoundErrors {
    ErrorFigures figures;  // the largest of all points of the reference; over the uniform measure
    SearchPlace worst_row{};
    SearchPlace worst_point{};
    int points = 0;  // at which the reference was evaluated
};

// The same figures for any number of threads. After an interruption they must not be used.
FoundErrors search_errors(const LookupSearch& search, const SearchCounts& counts,
                          const BakeOptions& options);

}  // namespace skybake
