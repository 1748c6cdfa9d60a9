#include "bakers/assets/occupancy/occupancy_proof.h"

#include <algorithm>
#include <cstddef>
#include <mutex>

#include "bakers/occupancy/cell_blocks.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {

namespace {

using config::OccupancyFilter;

// Twice a position along an axis: odd at voxel centres, even at the faces between them.
struct VoxelSpan {
    int low = 0;   // the voxels that a lookup there is the mean of
    int high = 0;  // the same at centres
};

class Cell {
  public:
    Cell(const CellGrid& grid, const BlockRows& rows, const std::array<int, 3>& place)
        : rows_(rows), width_(grid.voxels[0]) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            voxels_[axis] = grid.voxels_of(axis, place[axis]);
        }
    }

    float greatest_voxel(int beyond) const {
        float greatest = voxel(voxels_[0].first, voxels_[1].first, voxels_[2].first);
        for (int z = voxels_[2].first - beyond; z < voxels_[2].last + beyond; ++z) {
            for (int y = voxels_[1].first - beyond; y < voxels_[1].last + beyond; ++y) {
                for (int x = voxels_[0].first - beyond; x < voxels_[0].last + beyond; ++x) {
                    greatest = std::max(greatest, voxel(x, y, z));
                }
            }
        }
        return greatest;
    }

    double greatest_node() const {
        double greatest = voxel(voxels_[0].first, voxels_[1].first, voxels_[2].first);
        const int z_nodes = 2 * voxels_[2].count();
        for (int k = 0; k <= z_nodes; k = next_node(k, z_nodes)) {
            const int y_nodes = 2 * voxels_[1].count();
            for (int j = 0; j <= y_nodes; j = next_node(j, y_nodes)) {
                const int x_nodes = 2 * voxels_[0].count();
                for (int i = 0; i <= x_nodes; i = next_node(i, x_nodes)) {
                    greatest = std::max(greatest, mean({i, j, k}));
                }
            }
        }
        return greatest;
    }

  private:
    // Faces are at 0 and `last`, centres at odd numbers between.
    static int next_node(int node, int last) {
        if (node == last) return last + 1;
        return node + 1 == last ? last : node + (node == 0 ? 1 : 2);
    }

    VoxelSpan node(std::size_t axis, int half_steps) const {
        const int high = voxels_[axis].first + half_steps / 2;
        return half_steps % 2 == 1 ? VoxelSpan{high, high} : VoxelSpan{high - 1, high};
    }

    double mean(const std::array<int, 3>& half_steps) const {
        const VoxelSpan x = node(0, half_steps[0]);
        const VoxelSpan y = node(1, half_steps[1]);
        const VoxelSpan z = node(2, half_steps[2]);
        double sum = 0;
        for (const int k : {z.low, z.high}) {
            for (const int j : {y.low, y.high}) {
                for (const int i : {x.low, x.high}) sum += double{voxel(i, j, k)};
            }
        }
        return sum / 8;
    }

    float voxel(int x, int y, int z) const {
        return rows_.at(y, z)[static_cast<std::size_t>(wrapped(x, width_))];
    }

    const BlockRows& rows_;
    int width_;
    std::array<Span, 3> voxels_;
};

// How far the least lost cell is known, by any thread.
class Search {
  public:
    Search(const CellGrid& grid, OccupancyFilter filter, const OccupiedCells& cells,
           float threshold)
        : grid_(grid), filter_(filter), cells_(cells), threshold_(threshold) {}

    void look_at(const CellBlock& block, const BlockRows& rows) {
        for (int z = block.z.first; z < block.z.last; ++z) {
            for (int y = block.y.first; y < block.y.last; ++y) {
                for (int x = 0; x < cells_.size[0]; ++x) {
                    if (cells_.occupied[index_of(cells_.size, x, y, z)] == 0) {
                        look_at(rows, {x, y, z});
                    }
                }
            }
        }
    }

    const std::optional<LostCell>& lost() const { return lost_; }

  private:
    void look_at(const BlockRows& rows, const std::array<int, 3>& place) {
        const Cell cell(grid_, rows, place);
        double value = cell.greatest_voxel(voxels_beyond(filter_));
        if (value <= threshold_) return;
        if (filter_ == OccupancyFilter::trilinear) value = cell.greatest_node();
        if (value <= threshold_) return;
        const std::lock_guard lock(mutex_);
        const auto index = [&](const std::array<int, 3>& at) {
            return index_of(cells_.size, at[0], at[1], at[2]);
        };
        if (!lost_ || index(place) < index(lost_->cell)) lost_ = LostCell{place, value};
    }

    const CellGrid& grid_;
    OccupancyFilter filter_;
    const OccupiedCells& cells_;
    float threshold_;
    std::mutex mutex_;
    std::optional<LostCell> lost_;
};

}  // namespace

std::optional<LostCell> find_lost_cell(const ChannelSource& source, const CellGrid& grid,
                                       OccupancyFilter filter, const OccupiedCells& cells,
                                       float threshold, const BakeOptions& options) {
    Search search(grid, filter, cells, threshold);
    for_each_block(
        source, grid, voxels_beyond(filter), options,
        [&](const CellBlock& block, const BlockRows& rows) { search.look_at(block, rows); });
    if (options.cancelled()) return std::nullopt;
    return search.lost();
}

}  // namespace skybake::occupancy
