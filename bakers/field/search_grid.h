// Grids of at most three axes, in whose cells searches of errors draw points (error_search.h).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

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

}  // namespace skybake
