// Parts of boxes that reach beyond a tile's edge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/wrapped.h"

namespace skybake::cloud {

// A run of voxels along an axis that is one run of the source too.
struct AxisPiece {
    int at = 0;      // in the box
    int source = 0;  // index in the source
    int size = 0;
};

// Returns the runs of voxels `first` to first + count - 1 of an axis that repeats after `period`.
inline std::vector<AxisPiece> wrapped_pieces(int first, int count, int period) {
    std::vector<AxisPiece> pieces;
    for (int at = 0; at < count; at += pieces.back().size) {
        const int source = skybake::wrapped(first + at, period);
        pieces.push_back({at, source, std::min(count - at, period - source)});
    }
    return pieces;
}

// Copies the voxels of a piece, `from`, to their place in a box.
inline void copy_piece(const VoxelBox& box, const AxisPiece& columns, const AxisPiece& rows,
                       const float* from, float* to) {
    for (int z = 0; z < box.size[2]; ++z) {
        for (int y = 0; y < rows.size; ++y, from += columns.size) {
            const std::int64_t row = std::int64_t{z} * box.size[1] + rows.at + y;
            std::copy_n(from, columns.size, to + row * box.size[0] + columns.at);
        }
    }
}

}  // namespace skybake::cloud
