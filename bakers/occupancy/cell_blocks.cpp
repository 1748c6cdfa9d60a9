#include "bakers/occupancy/cell_blocks.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "bakers/field/pixel_type.h"
#include "bakers/math/memory.h"
#include "bakers/math/parallel.h"

namespace skybake::occupancy {
namespace {

// The blocks of a grid, `rows` rows of cells by `layers` layers, the last ones smaller.
class Blocks {
  public:
    Blocks(const std::array<int, 3>& cells, int rows, int layers)
        : cells_(cells),
          rows_(std::clamp(rows, 1, cells[1])),
          layers_(std::clamp(layers, 1, cells[2])),
          along_y_((cells[1] + rows_ - 1) / rows_),
          along_z_((cells[2] + layers_ - 1) / layers_) {}

    int count() const { return along_y_ * along_z_; }
    CellBlock operator[](int i) const {
        const int y = i % along_y_ * rows_;
        const int z = i / along_y_ * layers_;
        return {{y, std::min(y + rows_, cells_[1])}, {z, std::min(z + layers_, cells_[2])}};
    }

  private:
    std::array<int, 3> cells_;
    int rows_;
    int layers_;
    int along_y_;
    int along_z_;
};

// The voxels that a block and its halo use along z, those outside of the volume left out.
Span planes_of(const CellGrid& grid, const CellBlock& block, int halo) {
    const Span inside = grid.voxels_of(2, block.z);
    return {std::max(inside.first - halo, 0), std::min(inside.last + halo, grid.voxels[2])};
}

// Blocks of about as many rows as planes, so that little of them is halo, and enough of them for
// threads to share: as BoxSequence has it.
Blocks blocks_of_source(const CellGrid& grid, int halo) {
    constexpr double kFewestFloats = 1 << 18;
    constexpr double kMostFloats = 1 << 22;
    const double all = static_cast<double>(count_of(grid.voxels));
    const double budget = std::clamp(all / 16, kFewestFloats, kMostFloats);
    const double rows = budget / grid.voxels[0];  // rows times planes
    const auto cells_within = [&](double voxels) {
        return static_cast<int>(std::max(0.0, voxels - 2 * halo) / grid.cell);
    };
    const int along_y = std::clamp(cells_within(std::sqrt(rows)), 1, grid.size()[1]);
    return {grid.size(), along_y, cells_within(rows / (along_y * grid.cell + 2 * halo))};
}

// The voxels about one block, read from a source. Rows that lie beyond an edge of the volume come
// from boxes of their own.
class BlockVoxels {
  public:
    BlockVoxels(const ChannelSource& source, const CellGrid& grid, const CellBlock& block, int halo)
        : grid_(grid), rows_(grid, block, halo), planes_(planes_of(grid, block, halo)) {
        std::vector<VoxelBox> boxes;
        std::size_t count = 0;
        for (int y = rows_.y().first; y < rows_.y().last; y += boxes.back().size[1]) {
            const int first = wrapped(y, grid.voxels[1]);
            const int height = std::min(rows_.y().last - y, grid.voxels[1] - first);
            boxes.push_back({{0, first, planes_.first}, {grid.voxels[0], height, planes_.count()}});
            count += static_cast<std::size_t>(boxes.back().count());
        }
        empty_ = std::ranges::all_of(
            boxes, [&](const VoxelBox& box) { return source.voxels.is_empty(box); });
        if (empty_) return;
        voxels_.resize(count);
        float* target = voxels_.data();
        int y = rows_.y().first;
        for (const VoxelBox& box : boxes) {
            read(source, box, target);
            point_rows(y, box.size[1], target);
            target += box.count();
            y += box.size[1];
        }
    }

    bool empty() const { return empty_; }
    const BlockRows& rows() const { return rows_; }

  private:
    // Runs of planes, a cell high and more, that are known to be empty are not made.
    void read(const ChannelSource& source, const VoxelBox& box, float* out) const {
        const auto part = [&](int first, int last) {
            VoxelBox planes = box;
            planes.origin[2] += first;
            planes.size[2] = std::min(last, box.size[2]) - first;
            return planes;
        };
        const auto is_empty = [&](int z) {
            return source.voxels.is_empty(part(z, z + grid_.cell));
        };
        int z = 0;
        while (z < box.size[2]) {
            const bool empty = is_empty(z);
            int end = z + grid_.cell;
            while (end < box.size[2] && is_empty(end) == empty) end += grid_.cell;
            const VoxelBox run = part(z, end);
            float* target = out + std::int64_t{z} * box.size[0] * box.size[1];
            if (empty) {
                std::fill_n(target, run.count(), 0.0F);
            } else {
                fill(source, run, target);
            }
            z = end;
        }
    }

    static void fill(const ChannelSource& source, const VoxelBox& box, float* target) {
        std::vector<float*> channels(static_cast<std::size_t>(source.channels), nullptr);
        channels[static_cast<std::size_t>(source.channel)] = target;
        source.voxels.fill(box, channels);
        round_values(target, static_cast<std::size_t>(box.count()), source.pixel_type);
    }

    void point_rows(int y, int height, const float* values) {
        const std::size_t length = rows_.length();
        for (int z = rows_.z().first; z < rows_.z().last; ++z) {
            const int plane = std::clamp(z, planes_.first, planes_.last - 1) - planes_.first;
            for (int i = 0; i < height; ++i) {
                const auto row = static_cast<std::size_t>(plane) * static_cast<std::size_t>(height);
                rows_.at(y + i, z) = values + (row + static_cast<std::size_t>(i)) * length;
            }
        }
    }

    const CellGrid& grid_;
    BlockRows rows_;
    Span planes_;
    AlignedFloats voxels_;
    bool empty_ = false;
};

}  // namespace

BlockRows::BlockRows(const CellGrid& grid, const CellBlock& block, int halo)
    : y_(grid.voxels_of(1, block.y)),
      z_(grid.voxels_of(2, block.z)),
      length_(static_cast<std::size_t>(grid.voxels[0])) {
    for (Span* span : {&y_, &z_}) {
        span->first -= halo;
        span->last += halo;
    }
    rows_.resize(static_cast<std::size_t>(y_.count()) * static_cast<std::size_t>(z_.count()));
}

void for_each_block(const float* voxels, const CellGrid& grid, int halo, int threads,
                    const BlockWork& work) {
    // Eight rows of cells by all layers: what two layers share is still in the second cache.
    const Blocks blocks(grid.size(), 8, grid.size()[2]);
    parallel_for(blocks.count(), threads, [&](int i) {
        BlockRows rows(grid, blocks[i], halo);
        for (int z = rows.z().first; z < rows.z().last; ++z) {
            for (int y = rows.y().first; y < rows.y().last; ++y) {
                rows.at(y, z) = voxels + index_of(grid.voxels, 0, wrapped(y, grid.voxels[1]),
                                                  clamped(z, grid.voxels[2]));
            }
        }
        work(blocks[i], rows);
    });
}

void for_each_block(const ChannelSource& source, const CellGrid& grid, int halo,
                    const BakeOptions& options, const BlockWork& work) {
    const Blocks blocks = blocks_of_source(grid, halo);
    std::atomic<int> done = 0;
    parallel_for(blocks.count(), options.threads, [&](int i) {
        if (options.cancelled()) return;
        const BlockVoxels voxels(source, grid, blocks[i], halo);
        if (!voxels.empty()) work(blocks[i], voxels.rows());
        const int finished = ++done;
        if (options.progress != nullptr) {
            options.progress->advance("cells", static_cast<double>(finished) / blocks.count());
        }
    });
}

}  // namespace skybake::occupancy
