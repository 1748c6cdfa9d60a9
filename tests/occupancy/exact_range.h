// The extremes of a cell in integer arithmetic, rounded outwards once: the referee of cell_ranges.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/occupancy/volumes_in_memory.h"

namespace skybake::test {

// 2^-kUnit is the unit of voxels, which are below 2^21 in magnitude and multiples of 2^-84, or
// below 2^-40 and multiples of 2^-149: eight of them fit in 128 bits.
__extension__ using Wide = __int128;

inline int unit_of(Values values) { return values == Values::denormals ? 149 : 84; }

inline Wide in_units(float value, int unit) {
    int exponent = 0;
    const auto mantissa = static_cast<Wide>(std::ldexp(std::frexp(value, &exponent), 24));
    const int shift = exponent - 24 + unit;
    return shift >= 0 ? mantissa * (Wide{1} << shift) : mantissa / (Wide{1} << -shift);
}

// The least float not below sum * 2^-unit.
inline float least_float_above(Wide sum, int unit) {
    bool rest = false;
    while (sum >= (Wide{1} << 24) || sum <= -(Wide{1} << 24) || unit > 149) {
        rest = rest || (sum & 1) != 0;
        sum >>= 1;  // towards minus infinity
        --unit;
    }
    return static_cast<float>(std::ldexp(static_cast<double>(sum + (rest ? 1 : 0)), -unit)) + 0.0F;
}

struct ExactRange {
    Wide least = 0;  // eight times the extremes, in units
    Wide most = 0;
};

// Returns the range of cell (i, j, k) for the trilinear filter: over eight times the means of the two
// voxels about each node along each axis.
inline ExactRange exact_range(const Volume& volume, const std::array<int, 3>& cell, int unit) {
    std::array<std::vector<std::array<int, 2>>, 3> nodes;
    for (std::size_t a = 0; a < 3; ++a) {
        const occupancy::Span span = volume.grid.voxels_of(a, cell[a]);
        const auto at = [&](int i) {
            const int size = volume.grid.voxels[a];
            return a < 2 ? occupancy::wrapped(i, size) : occupancy::clamped(i, size);
        };
        nodes[a].push_back({at(span.first - 1), at(span.first)});
        nodes[a].push_back({at(span.last - 1), at(span.last)});
        for (int i = span.first; i < span.last; ++i) nodes[a].push_back({i, i});
    }
    std::optional<ExactRange> range;
    for (const auto& z : nodes[2]) {
        for (const auto& y : nodes[1]) {
            for (const auto& x : nodes[0]) {
                Wide sum = 0;
                for (std::size_t i = 0; i < 8; ++i) {
                    sum += in_units(volume.at(x[i & 1], y[i >> 1 & 1], z[i >> 2]), unit);
                }
                if (!range) range = ExactRange{sum, sum};
                range->least = std::min(range->least, sum);
                range->most = std::max(range->most, sum);
            }
        }
    }
    return *range;
}

}  // namespace skybake::test
