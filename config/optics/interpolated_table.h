// Linear interpolation between the rows of a table whose first member ascends.
#pragma once

#include <algorithm>
#include <cassert>
#include <span>

namespace skybake::config {

// Where a value stands in a table: between rows `below` and `below` + 1, `fraction` of the way.
struct TablePlace {
    std::size_t below = 0;
    double fraction = 0;
    double between(double first, double second) const {
        return first + (second - first) * fraction;
    }
};

// The table has at least two rows. A value outside of it is taken to its nearest end.
template <class Row>
TablePlace place_in(std::span<const Row> rows, double Row::*key, double value) {
    assert(rows.size() >= 2);
    const auto above = std::ranges::upper_bound(rows, value, {}, key);
    const auto high = std::clamp(above, rows.begin() + 1, rows.end() - 1);
    const auto below = static_cast<std::size_t>(high - rows.begin()) - 1;
    const double first = rows[below].*key, second = rows[below + 1].*key;
    return {below, std::clamp((value - first) / (second - first), 0.0, 1.0)};
}

// Returns another member of the rows at that value of the key.
template <class Row>
double interpolate(std::span<const Row> rows, double Row::*key, double Row::*member, double value) {
    const TablePlace place = place_in(rows, key, value);
    return place.between(rows[place.below].*member, rows[place.below + 1].*member);
}

}  // namespace skybake::config
