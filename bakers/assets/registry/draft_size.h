// Reduced sizes for draft pictures that take about a second.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace skybake {

// Reduces the longest edge to at most `most_voxels` and the other edges in proportion, rounded.
inline std::array<int, 3> reduced(const std::array<int, 3>& size, int most_voxels) {
    const std::int64_t longest = *std::ranges::max_element(size);
    if (longest <= most_voxels) return size;
    std::array<int, 3> fewer{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t edge =
            (2 * most_voxels * std::int64_t{size[i]} + longest) / (2 * longest);
        fewer[i] = static_cast<int>(std::max<std::int64_t>(edge, 1));
    }
    return fewer;
}

// Reduces a table to at most `most` texels along each axis. A table without a size of its own
// (max_error is given) gets that size.
template <class Table>
void reduce_table(Table& table, const std::array<int, 2>& most) {
    table.max_error.reset();
    for (std::size_t i = 0; i < 2; ++i) {
        table.size[i] = table.size[i] > 0 ? std::min(table.size[i], most[i]) : most[i];
    }
}

}  // namespace skybake
