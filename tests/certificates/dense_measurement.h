// Shared by dense measurements of tables and of volumes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

#include "bakers/field/error_search.h"

namespace skybake::test {

// The largest of many errors, whose largest few are measured again.
template <class Place>
class LargestErrors {
  public:
    void add(const Place& at, double error) { points_.push_back({at, error}); }

    // `exactly` returns the error at a place against the reference itself.
    double figure(const std::function<double(const Place&)>& exactly) {
        constexpr std::size_t kAgain = 12;
        const auto end =
            points_.begin() + static_cast<std::ptrdiff_t>(std::min(kAgain, points_.size()));
        std::partial_sort(points_.begin(), end, points_.end(),
                          [](const Point& a, const Point& b) { return a.error > b.error; });
        double largest = 0;
        for (auto point = points_.begin(); point != end; ++point) {
            largest = std::max(largest, exactly(point->at));
        }
        return largest;
    }

  private:
    struct Point {
        Place at{};
        double error = 0;
    };
    std::vector<Point> points_;
};

// The indices of the largest squares, which hold this share of their sum.
inline std::vector<std::size_t> largest_holding(double share, const std::vector<double>& squares) {
    const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
    std::vector<std::size_t> order(squares.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return squares[a] > squares[b]; });
    double held = 0;
    std::size_t count = 0;
    while (count < order.size() && held < share * sum) held += squares[order[count++]];
    order.resize(count);
    return order;
}

}  // namespace skybake::test
