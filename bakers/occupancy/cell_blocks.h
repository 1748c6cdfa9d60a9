// The rows of voxels in and around blocks of cells, read from memory or from a source.
#pragma once

#include <functional>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/cell_range.h"

namespace skybake::occupancy {

// A block of cells: all cells along x, and some along y and z.
struct CellBlock {
    Span y;
    Span z;
};

// The rows of voxels of a block and of `halo` rows and planes around it, wrapped along y and
// clamped along z.
class BlockRows {
  public:
    BlockRows(const CellGrid& grid, const CellBlock& block, int halo);

    Span y() const { return y_; }  // first and last may lie beyond the volume
    Span z() const { return z_; }
    std::size_t length() const { return length_; }  // of a row: the voxels along x
    const float*& at(int y, int z) { return rows_[index(y, z)]; }
    const float* at(int y, int z) const { return rows_[index(y, z)]; }

  private:
    std::size_t index(int y, int z) const {
        return static_cast<std::size_t>(z - z_.first) * static_cast<std::size_t>(y_.count()) +
               static_cast<std::size_t>(y - y_.first);
    }
    Span y_;
    Span z_;
    std::size_t length_ = 0;
    std::vector<const float*> rows_;
};

// Calls `use` with each value of a box of voxels.
template <class Use>
void for_each_value(const BlockRows& rows, Span x, Span y, Span z, const Use& use) {
    for (int plane = z.first; plane < z.last; ++plane) {
        for (int line = y.first; line < y.last; ++line) {
            const float* row = rows.at(line, plane);
            for (int i = x.first; i < x.last; ++i) use(row[i]);
        }
    }
}

// Called once for each block, in any order, on several threads.
using BlockWork = std::function<void(const CellBlock& block, const BlockRows& rows)>;

void for_each_block(const float* voxels, const CellGrid& grid, int halo, int threads,
                    const BlockWork& work);

// Does the same with the voxels of a source, rounded as they are stored. At most 16 MiB of voxels
// per thread are in memory where cells and rows allow it. The work is not called for blocks whose
// rows are known to be 0. Ends early once options.progress is cancelled.
void for_each_block(const ChannelSource& source, const CellGrid& grid, int halo,
                    const BakeOptions& options, const BlockWork& work);

}  // namespace skybake::occupancy
