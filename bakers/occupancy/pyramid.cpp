#include "bakers/occupancy/pyramid.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bakers/occupancy/cell_grid.h"

namespace skybake::occupancy {

namespace {

template <class Value, class Combine>
std::vector<Value> halved(const std::vector<Value>& values, const std::array<int, 3>& size,
                          const Combine& combine) {
    const std::array<int, 3> coarse = next_level_size(size);
    std::vector<Value> result(count_of(coarse));
    const auto pair_of = [&](std::size_t axis, int i) {
        return Span{2 * i, std::min(2 * i + 2, size[axis])};
    };
    for (int k = 0; k < coarse[2]; ++k) {
        const Span z = pair_of(2, k);
        for (int j = 0; j < coarse[1]; ++j) {
            const Span y = pair_of(1, j);
            for (int i = 0; i < coarse[0]; ++i) {
                const Span x = pair_of(0, i);
                Value value = values[index_of(size, x.first, y.first, z.first)];
                for (int fine_z = z.first; fine_z < z.last; ++fine_z) {
                    for (int fine_y = y.first; fine_y < y.last; ++fine_y) {
                        for (int fine_x = x.first; fine_x < x.last; ++fine_x) {
                            value = combine(value, values[index_of(size, fine_x, fine_y, fine_z)]);
                        }
                    }
                }
                result[index_of(coarse, i, j, k)] = value;
            }
        }
    }
    return result;
}

template <class Value>
Value smaller(Value a, Value b) {
    return std::min(a, b);
}
template <class Value>
Value greater(Value a, Value b) {
    return std::max(a, b);
}

}  // namespace

std::array<int, 3> next_level_size(const std::array<int, 3>& size) {
    return {(size[0] + 1) / 2, (size[1] + 1) / 2, (size[2] + 1) / 2};
}

CellRanges next_level(const CellRanges& ranges) {
    return {next_level_size(ranges.size), halved(ranges.minimum, ranges.size, smaller<float>),
            halved(ranges.maximum, ranges.size, greater<float>)};
}

OccupiedCells next_level(const OccupiedCells& cells) {
    return {next_level_size(cells.size), halved(cells.occupied, cells.size, greater<std::uint8_t>)};
}

}  // namespace skybake::occupancy
