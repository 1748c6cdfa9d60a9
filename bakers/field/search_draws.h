// Where a search of errors (error_search.h) draws its points, and the weights of their squares in
// the mean square of all.
//
// A cell is drawn the more often the larger the errors that are expected there, and its points
// weigh the less, so that the mean square is that of the uniform measure whatever is expected.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "bakers/field/error_search.h"

namespace skybake {

// One draw from a series of cells.
struct Draw {
    std::size_t index = 0;
    double weight = 0;  // of its square in the mean of all
    double within = 0;  // the share of the cell that lies before the draw
};

// Draws `count` of the cells, of the given shares and expected squares. `start`, from 0 to 1,
// chooses one of many such series.
std::vector<Draw> draw(const std::vector<double>& shares, const std::vector<double>& squares,
                       int count, double start);

// The `count` largest elements' indices, the largest first; of equal ones, the first.
std::vector<std::size_t> largest_of(const std::vector<double>& values, std::size_t count);

// A row that is evaluated together, and the weights of its points in the mean square; points of
// weight 0 are there for the maximum alone.
struct SearchRow {
    SearchPlace at{};
    std::vector<SearchPlace> points;
    std::vector<double> weights;
    std::vector<PointError> errors;
};

struct SearchPoint {
    SearchPlace row{};
    SearchPlace point{};
    double weight = 0;
    PointError error;
};

class SearchDraws {
  public:
    // Looks at what the texels let expect of each cell. `search` must outlive this object.
    SearchDraws(const LookupSearch& search, int threads);

    // Returns `count` rows of `per_row` points each, whose weights sum to about `weight`.
    std::vector<SearchRow> rows(int count, int per_row, double weight) const;

    // Returns rows through the middles of the `count` cells in which the largest errors are
    // expected, of weight 0.
    std::vector<SearchRow> peak_rows(int count, int per_row) const;

    // Later draws go by these points too, whose mean square is `mean_square`: what the texels let
    // expect is scaled to it, and in the cells where a larger error was found that error is
    // expected.
    void learn(const std::vector<SearchPoint>& measured, double mean_square);

  private:
    double square_of(std::size_t row, std::size_t column) const;
    std::vector<double> squares_in(std::size_t row) const;

    const LookupSearch& search_;
    std::vector<double> row_shares_;
    std::vector<double> point_shares_;
    std::vector<double> row_squares_;
    std::vector<double> row_peaks_;
    double scale_ = 1;                                             // of expected squares
    std::map<std::pair<std::size_t, std::size_t>, double> found_;  // squares, by row and point cell
};

}  // namespace skybake
