// Means of numbers, and how far two lists of them are apart.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <vector>

namespace skybake::test {

template <class Numbers>
double mean_of(const Numbers& numbers) {
    return std::accumulate(std::begin(numbers), std::end(numbers), 0.0) /
           static_cast<double>(std::size(numbers));
}

// The largest difference; infinity where a number is none, or where the lists are not of one length.
template <class Numbers>
double largest_difference(const Numbers& a, const Numbers& b) {
    if (std::size(a) != std::size(b)) return INFINITY;
    return std::transform_reduce(
        std::begin(a), std::end(a), std::begin(b), 0.0,
        [](double x, double y) { return x > y ? x : y; },
        [](double x, double y) { return std::isnan(x - y) ? INFINITY : std::fabs(x - y); });
}

template <class Numbers>
double rms_difference(const Numbers& a, const Numbers& b) {
    return std::sqrt(std::transform_reduce(std::begin(a), std::end(a), std::begin(b), 0.0,
                                           std::plus(),
                                           [](double x, double y) { return (x - y) * (x - y); }) /
                     static_cast<double>(std::size(a)));
}

inline bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return std::ranges::equal(a, b, [](float x, float y) { return same_bits(x, y); });
}

}  // namespace skybake::test
