#include "bakers/field/search_grid.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace skybake {

std::vector<double> even_edges(int cells) {
    std::vector<double> edges;
    for (int i = 0; i <= cells; ++i) edges.push_back(static_cast<double>(i) / cells);
    return edges;
}

SearchGrid::SearchGrid(std::vector<std::vector<double>> edges) : edges_(std::move(edges)) {
    assert(edges_.size() <= 3);
    for (const std::vector<double>& axis : edges_) {
        assert(axis.size() >= 2);
        count_ *= axis.size() - 1;
    }
}

std::array<std::size_t, 3> SearchGrid::indices(std::size_t cell) const {
    std::array<std::size_t, 3> result{};
    for (std::size_t a = 0; a < edges_.size(); ++a) {
        const std::size_t cells = edges_[a].size() - 1;
        result[a] = cell % cells;
        cell /= cells;
    }
    return result;
}

double SearchGrid::share(std::size_t cell) const {
    const std::array<std::size_t, 3> index = indices(cell);
    double share = 1;
    for (std::size_t a = 0; a < edges_.size(); ++a) {
        share *= (edges_[a][index[a] + 1] - edges_[a][index[a]]) /
                 (edges_[a].back() - edges_[a].front());
    }
    return share;
}

SearchPlace SearchGrid::place(std::size_t cell, const SearchPlace& within) const {
    const std::array<std::size_t, 3> index = indices(cell);
    SearchPlace result{};
    for (std::size_t a = 0; a < edges_.size(); ++a) {
        const double low = edges_[a][index[a]];
        const double high = edges_[a][index[a] + 1];
        result[a] = std::clamp(low + within[a] * (high - low), low, high);
    }
    return result;
}

std::size_t SearchGrid::cell_at(const SearchPlace& place) const {
    std::size_t cell = 0;
    std::size_t stride = 1;
    for (std::size_t a = 0; a < edges_.size(); ++a) {
        const std::vector<double>& axis = edges_[a];
        const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, place[a]);
        cell += stride * static_cast<std::size_t>(above - axis.begin() - 1);
        stride *= axis.size() - 1;
    }
    return cell;
}

SearchPlace SearchGrid::moved(const SearchPlace& place, std::size_t axis, double widths) const {
    const std::size_t index = indices(cell_at(place))[axis];
    const std::vector<double>& edges = edges_[axis];
    SearchPlace result = place;
    result[axis] = std::clamp(place[axis] + widths * (edges[index + 1] - edges[index]),
                              edges.front(), edges.back());
    return result;
}

}  // namespace skybake
