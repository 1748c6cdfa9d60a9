#include "bakers/assets/occupancy/occupancy_proof.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include "bakers/occupancy/cell_blocks.h"
#include "bakers/occupancy/cell_grid.h"

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
        : grid_(grid),
          filter_(filter),
          beyond_(voxels_beyond(filter)),
          cells_(cells),
          threshold_(threshold) {}

    void look_at(const CellBlock& block, const BlockRows& rows) {
        std::vector<float> greatest;
        for (int z = block.z.first; z < block.z.last; ++z) {
            for (int y = block.y.first; y < block.y.last; ++y) {
                const std::uint8_t* const occupied =
                    &cells_.occupied[index_of(cells_.size, 0, y, z)];
                const std::uint8_t* const end = occupied + cells_.size[0];
                if (std::find(occupied, end, 0) == end) continue;
                put_greatest(rows, y, z, greatest);
                for (int x = 0; x < cells_.size[0]; ++x) {
                    if (occupied[x] == 0) look_at(rows, {x, y, z}, greatest);
                }
            }
        }
    }

    const std::optional<LostCell>& lost() const { return lost_; }

  private:
    // Writes the greatest of the voxels along y and z that lookups in a row of cells use, at each
    // voxel along x from `beyond_` before the first one to `beyond_` behind the last one.
    void put_greatest(const BlockRows& rows, int y, int z, std::vector<float>& greatest) const {
        const Span across = grid_.voxels_of(1, y);
        const Span up = grid_.voxels_of(2, z);
        const std::size_t length = rows.length();
        const auto beyond = static_cast<std::size_t>(beyond_);
        greatest.assign(length + 2 * beyond, std::numeric_limits<float>::lowest());
        float* const inside = greatest.data() + beyond;
        for (int k = up.first - beyond_; k < up.last + beyond_; ++k) {
            for (int j = across.first - beyond_; j < across.last + beyond_; ++j) {
                const float* const row = rows.at(j, k);
                for (std::size_t i = 0; i < length; ++i) {
                    inside[i] = inside[i] < row[i] ? row[i] : inside[i];
                }
            }
        }
        for (int i = 1; i <= beyond_; ++i) {
            const auto before = static_cast<std::size_t>(wrapped(-i, grid_.voxels[0]));
            const auto behind = static_cast<std::size_t>(wrapped(i - 1, grid_.voxels[0]));
            *(inside - i) = inside[before];
            inside[length + static_cast<std::size_t>(i) - 1] = inside[behind];
        }
    }

    void look_at(const BlockRows& rows, const std::array<int, 3>& place,
                 const std::vector<float>& greatest) {
        const Span along = grid_.voxels_of(0, place[0]);
        const auto first = greatest.begin() + along.first;
        double value = *std::max_element(first, first + along.count() + 2 * beyond_);
        if (value <= threshold_) return;
        if (filter_ == OccupancyFilter::trilinear) value = Cell(grid_, rows, place).greatest_node();
        if (value <= threshold_) return;
        const std::lock_guard lock(mutex_);
        const auto index = [&](const std::array<int, 3>& at) {
            return index_of(cells_.size, at[0], at[1], at[2]);
        };
        if (!lost_ || index(place) < index(lost_->cell)) lost_ = LostCell{place, value};
    }

    const CellGrid& grid_;
    OccupancyFilter filter_;
    int beyond_;  // voxels beyond a cell's faces that its lookups use
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
