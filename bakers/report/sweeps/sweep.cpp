#include "bakers/report/sweeps/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace skybake {

namespace {

template <std::size_t Axes>
std::int64_t texel_count(const std::array<int, Axes>& size) {
    std::int64_t count = 1;
    for (const int along_axis : size) count *= along_axis;
    return count;
}

}  // namespace

template <std::size_t Axes>
std::vector<std::array<int, Axes>> sizes_around(
    std::array<int, Axes> size, const std::vector<std::array<double, Axes>>& factors,
    std::int64_t max_texels) {
    std::vector<std::array<int, Axes>> sizes;
    for (const std::array<double, Axes>& factor : factors) {
        std::array<int, Axes> candidate;
        for (std::size_t axis = 0; axis < Axes; ++axis) {
            candidate[axis] = std::max(std::min(size[axis], 2),
                                       static_cast<int>(std::lround(size[axis] * factor[axis])));
        }
        if (texel_count(candidate) > max_texels) continue;
        if (std::find(sizes.begin(), sizes.end(), candidate) == sizes.end()) {
            sizes.push_back(candidate);
        }
    }
    return sizes;
}

template <std::size_t Axes>
std::array<int, Axes> size_within(std::array<int, Axes> size, std::int64_t max_texels) {
    while (texel_count(size) > max_texels) {
        for (int& count : size) count = std::max(std::min(count, 2), count / 2);
    }
    return size;
}

template std::vector<std::array<int, 2>> sizes_around(std::array<int, 2>,
                                                      const std::vector<std::array<double, 2>>&,
                                                      std::int64_t);
template std::vector<std::array<int, 3>> sizes_around(std::array<int, 3>,
                                                      const std::vector<std::array<double, 3>>&,
                                                      std::int64_t);
template std::array<int, 2> size_within(std::array<int, 2>, std::int64_t);
template std::array<int, 3> size_within(std::array<int, 3>, std::int64_t);

std::string size_text(std::span<const int> size) {
    return fmt::format("{}", fmt::join(size.begin(), size.end(), "x"));
}

}  // namespace skybake
