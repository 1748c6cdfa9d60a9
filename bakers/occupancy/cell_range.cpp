#include "bakers/occupancy/cell_range.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "bakers/occupancy/cell_blocks.h"
#include "bakers/occupancy/cell_row_kernel.h"
#include "bakers/occupancy/exact_extremes.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyFilter;

// Facts that the kernels need about rows of the last planes: each row is looked at once, shortly
// before it is used, so that its voxels are in a cache by then.
class SeenRows {
  public:
    SeenRows(const CellGrid& grid, OccupancyFilter filter, const BlockRows& rows)
        : rows_(rows),
          cell_(grid.cell),
          cells_(static_cast<std::size_t>(grid.size()[0])),
          planes_(grid.cell + 2 * voxels_beyond(filter)),
          with_faces_(filter == OccupancyFilter::trilinear) {
        const auto count =
            static_cast<std::size_t>(planes_) * static_cast<std::size_t>(rows.y().count());
        magnitudes_.resize(count);
        if (with_faces_) faces_.resize(cells_ * count);
    }

    // Looks at rows y of planes z, which take the place of those that many planes below.
    void see(Span y, Span z) {
        for (int plane = z.first; plane < z.last; ++plane) {
            for (int i = y.first; i < y.last; ++i) {
                const float* row = rows_.at(i, plane);
                const std::size_t index = first_of(plane) + offset_of(i);
                magnitudes_[index] = magnitudes_of(row, rows_.length(), row_of_later(i, plane));
                if (with_faces_) face_means(row, rows_.length(), cell_, faces_of(index));
            }
        }
    }

    // Rows y of planes z, and the magnitudes of their voxels.
    Magnitudes gather(Span y, Span z, std::vector<VoxelRow>& rows) {
        rows.resize(static_cast<std::size_t>(y.count()) * static_cast<std::size_t>(z.count()));
        Magnitudes magnitudes;
        VoxelRow* row = rows.data();
        for (int plane = z.first; plane < z.last; ++plane) {
            std::size_t index = first_of(plane) + offset_of(y.first);
            for (int i = y.first; i < y.last; ++i, ++index) {
                *row++ = {rows_.at(i, plane), with_faces_ ? faces_of(index) : nullptr};
                magnitudes.add(magnitudes_[index]);
            }
        }
        return magnitudes;
    }

  private:
    // The row that will be looked at a row of cells later, or a layer after the last of them.
    const float* row_of_later(int y, int z) const {
        const int beyond = y + cell_ - rows_.y().last;
        if (beyond < 0) return rows_.at(y + cell_, z);
        return rows_.at(std::min(rows_.y().first + beyond, rows_.y().last - 1),
                        std::min(z + cell_, rows_.z().last - 1));
    }

    double* faces_of(std::size_t index) { return faces_.data() + cells_ * index; }

    std::size_t first_of(int plane) const {
        return static_cast<std::size_t>((plane - rows_.z().first) % planes_) *
               static_cast<std::size_t>(rows_.y().count());
    }
    std::size_t offset_of(int y) const { return static_cast<std::size_t>(y - rows_.y().first); }

    const BlockRows& rows_;
    const int cell_;
    const std::size_t cells_;
    const int planes_;  // remembered
    const bool with_faces_;
    std::vector<Magnitudes> magnitudes_;
    Extremes<double>::Array faces_;
};

// Makes the ranges of a block, row of cells by row of cells.
class BlockRanges {
  public:
    BlockRanges(const CellGrid& grid, OccupancyFilter filter, const CellBlock& block,
                const BlockRows& rows, CellRanges& result)
        : grid_(grid),
          filter_(filter),
          halo_(voxels_beyond(filter)),
          first_row_(block.y.first),
          seen_(grid, filter, rows),
          result_(result),
          z_faces_(static_cast<std::size_t>(block.y.count())) {
        bundle_.length = rows.length();
        bundle_.cell = grid.cell;
    }

    void run(const CellBlock& block) {
        int next_plane = with_halo(grid_.voxels_of(2, block.z)).first;
        for (int k = block.z.first; k < block.z.last; ++k) {
            const Span z = with_halo(grid_.voxels_of(2, k));
            int next_row = with_halo(grid_.voxels_of(1, block.y)).first;
            for (int j = block.y.first; j < block.y.last; ++j) {
                const Span y = with_halo(grid_.voxels_of(1, j));
                seen_.see({next_row, y.last}, {next_plane, z.last});
                next_row = y.last;
                bundle_.height = y.count();
                bundle_.depth = z.count();
                const Magnitudes magnitudes = seen_.gather(y, z, bundle_.rows);
                // Ranges are 0 to begin with.
                if (!magnitudes.all_zero()) make_row(magnitudes, j, k);
            }
            next_plane = z.last;
        }
    }

  private:
    Span with_halo(Span span) const { return {span.first - halo_, span.last + halo_}; }

    void make_row(const Magnitudes& magnitudes, int j, int k) {
        const std::size_t first = index_of(result_.size, 0, j, k);
        float* least = &result_.minimum[first];
        float* most = &result_.maximum[first];
        if (filter_ == OccupancyFilter::trilinear) {
            make_extremes(j, k);
            round_extremes(means_are_exact(magnitudes), least, most);
            return;
        }
        footprint_row(bundle_, halo_, scratch_, least, most);
        for (std::size_t i = 0; i < bundle_.cells(); ++i) {
            least[i] += 0.0F;  // a zero without its sign
            most[i] += 0.0F;
        }
    }

    // Lower faces are the upper ones of the rows before, unless those were left out.
    void make_extremes(int j, int k) {
        ZFace& z = z_faces_[static_cast<std::size_t>(j - first_row_)];
        if (y_cell_ != std::array{j - 1, k}) {
            y_face_extremes(bundle_, Face::lower, scratch_, y_lower_);
        }
        if (z.layer != k - 1) z_face_extremes(bundle_, Face::lower, scratch_, z.nodes);
        y_face_extremes(bundle_, Face::upper, scratch_, y_upper_);
        z_face_extremes(bundle_, Face::upper, scratch_, z_upper_);
        trilinear_row(bundle_, {&y_lower_, &y_upper_, &z.nodes, &z_upper_}, scratch_, extremes_);
        std::swap(y_lower_, y_upper_);
        y_cell_ = {j, k};
        std::swap(z.nodes, z_upper_);
        z.layer = k;
    }

    void round_extremes(bool exact, float* least, float* most) {
        for (std::size_t i = 0; i < bundle_.cells(); ++i) {
            const double low = extremes_.least[i];
            const double high = extremes_.most[i];
            const CellExtremes rounded =
                exact ? CellExtremes{rounded_down(low), rounded_up(high)}
                      : exact_extremes(bundle_, static_cast<int>(i), low, high);
            least[i] = rounded.least;
            most[i] = rounded.most;
        }
    }

    // The upper face of the last layer made of a row of cells.
    struct ZFace {
        NodeExtremes nodes;
        int layer = -2;  // none, nor the one below the first
    };

    const CellGrid& grid_;
    const OccupancyFilter filter_;
    const int halo_;
    const int first_row_;
    SeenRows seen_;
    CellRanges& result_;
    RowBundle bundle_;
    RowScratch scratch_;
    NodeExtremes y_lower_;
    NodeExtremes y_upper_;
    std::array<int, 2> y_cell_ = {-2, -2};  // whose upper face y_lower_ is: row and layer
    NodeExtremes z_upper_;
    std::vector<ZFace> z_faces_;  // one per row of cells of the block
    Extremes<double> extremes_;
};

CellRanges zero_ranges(const CellGrid& grid) {
    CellRanges ranges{grid.size(), {}, {}};
    ranges.minimum.resize(count_of(ranges.size));
    ranges.maximum.resize(count_of(ranges.size));
    return ranges;
}

BlockWork ranges_into(CellRanges& ranges, const CellGrid& grid, OccupancyFilter filter) {
    return [&ranges, &grid, filter](const CellBlock& block, const BlockRows& rows) {
        BlockRanges(grid, filter, block, rows, ranges).run(block);
    };
}

}  // namespace

CellRanges cell_ranges(const float* voxels, const CellGrid& grid, OccupancyFilter filter,
                       int threads) {
    assert(grid.cell >= 1);
    CellRanges ranges = zero_ranges(grid);
    for_each_block(voxels, grid, voxels_beyond(filter), threads, ranges_into(ranges, grid, filter));
    return ranges;
}

CellRanges cell_ranges(const ChannelSource& source, const CellGrid& grid, OccupancyFilter filter,
                       const BakeOptions& options) {
    assert(grid.cell >= 1 && source.channel >= 0 && source.channel < source.channels);
    CellRanges ranges = zero_ranges(grid);
    for_each_block(source, grid, voxels_beyond(filter), options, ranges_into(ranges, grid, filter));
    return ranges;
}

}  // namespace skybake::occupancy
