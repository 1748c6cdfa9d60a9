// The texels of a file, what goes wrong with them, and the lookup that a runtime makes, from their
// definitions: nothing here is shared with what chooses probes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "tests/support/loops.h"

namespace skybake::testing {

using Uvw = std::array<double, 3>;

// How a runtime's sampler is set for the texture.
struct Sampler {
    std::array<bool, 3> repeats{};
    bool nearest = false;
};

struct Texels {
    std::array<int, 3> size{1, 1, 1};
    std::size_t channels = 0;
    std::vector<double> values;  // x, y, z order, channels interleaved

    std::size_t offset(const std::array<int, 3>& at) const {
        const auto row = static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(size[1]) +
                         static_cast<std::size_t>(at[1]);
        return (row * static_cast<std::size_t>(size[0]) + static_cast<std::size_t>(at[0])) *
               channels;
    }
};

inline int index_on(int i, int size, bool repeats) {
    return repeats ? ((i % size) + size) % size : std::clamp(i, 0, size - 1);
}

// A new file whose texel at `at` is what `value` writes.
template <class Value>
Texels made(const std::array<int, 3>& size, std::size_t channels, const Value& value) {
    Texels texels{size, channels, {}};
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        for (std::size_t c = 0; c < channels; ++c) {
            texels.values.push_back(value(std::array<int, 3>{x, y, z}, c));
        }
    });
    return texels;
}

inline Texels zeros(const Texels& from) {
    return made(from.size, from.channels, [](const auto&, std::size_t) { return 0.0; });
}

inline Texels flipped(const Texels& from, std::size_t axis) {
    return made(from.size, from.channels, [&](std::array<int, 3> at, std::size_t c) {
        at[axis] = from.size[axis] - 1 - at[axis];
        return from.values[from.offset(at) + c];
    });
}

// A file written with two axes exchanged; of equal sizes.
inline Texels exchanged(const Texels& from, std::size_t a, std::size_t b) {
    return made(from.size, from.channels, [&](std::array<int, 3> at, std::size_t c) {
        std::swap(at[a], at[b]);
        return from.values[from.offset(at) + c];
    });
}

// A file sampled half a texel off, to one side.
inline Texels shifted(const Texels& from, const Sampler& sampler, std::size_t axis, int side) {
    return made(from.size, from.channels, [&](const std::array<int, 3>& at, std::size_t c) {
        std::array<int, 3> next = at;
        next[axis] = index_on(at[axis] + side, from.size[axis], sampler.repeats[axis]);
        return 0.5 * (from.values[from.offset(at) + c] + from.values[from.offset(next) + c]);
    });
}

// The texels of an axis that a lookup takes, with their weights.
inline std::vector<std::pair<int, double>> taken(double coordinate, int size, bool repeats,
                                                 bool nearest) {
    const double position = coordinate * size - 0.5;  // centres are at whole numbers
    if (nearest) {
        return {{index_on(static_cast<int>(std::floor(position + 0.5)), size, repeats), 1.0}};
    }
    const auto below = static_cast<int>(std::floor(position));
    const double share = position - below;
    return {{index_on(below, size, repeats), 1 - share},
            {index_on(below + 1, size, repeats), share}};
}

inline std::vector<double> looked_up(const Texels& texels, const Sampler& sampler, const Uvw& uvw) {
    std::array<std::vector<std::pair<int, double>>, 3> axes;
    for (std::size_t a = 0; a < 3; ++a) {
        axes[a] = taken(uvw[a], texels.size[a], sampler.repeats[a], sampler.nearest);
    }
    std::vector<double> sum(texels.channels, 0.0);
    for (const auto& [z, of_z] : axes[2]) {
        for (const auto& [y, of_y] : axes[1]) {
            for (const auto& [x, of_x] : axes[0]) {
                const std::size_t at = texels.offset({x, y, z});
                for (std::size_t c = 0; c < sum.size(); ++c) {
                    sum[c] += of_x * of_y * of_z * texels.values[at + c];
                }
            }
        }
    }
    return sum;
}

}  // namespace skybake::testing
