#include "bakers/occupancy/cell_range.h"

#include <algorithm>

#include "bakers/occupancy/cell_blocks.h"
#include "bakers/occupancy/cell_row_kernel.h"
#include "bakers/occupancy/exact_extremes.h"
#include "bakers/occupancy/outward_rounding.h"

namespace skybake::occupancy {

namespace {

using config::OccupancyFilter;

// How many voxels beyond a cell's faces the filter uses.
int halo_of(OccupancyFilter filter) {
    switch (filter) {
        case OccupancyFilter::nearest:
            return 0;
        case OccupancyFilter::trilinear:
            return 1;
        case OccupancyFilter::tricubic:
            return 2;
    }
    return 0;
}

// The rows of the last planes seen, with what the kernels want to know of each. Each row is looked
// at once, in order; what follows finds it in a cache.
class SeenRows {
  public:
    SeenRows(const CellGrid& grid, const BlockRows& rows, int planes)
        : rows_(rows),
          cell_(grid.cell),
          cells_(static_cast<std::size_t>(grid.size()[0])),
          planes_(planes),
          next_(rows.z().first) {
        const auto count =
            static_cast<std::size_t>(planes) * static_cast<std::size_t>(rows.y().count());
        magnitudes_.resize(count);
        faces_.resize(cells_ * count);
    }

    // Looks at planes up to `last` - 1. Of those, the last `planes` are remembered.
    void see(int last) {
        for (; next_ < last; ++next_) {
            for (int y = rows_.y().first; y < rows_.y().last; ++y) {
                const float* row = rows_.at(y, next_);
                const std::size_t i = index(y, next_);
                magnitudes_[i] = magnitudes_of(row, rows_.length());
                face_means(row, rows_.length(), cell_, &faces_[cells_ * i]);
            }
        }
    }

    Magnitudes magnitudes(int y, int z) const { return magnitudes_[index(y, z)]; }
    VoxelRow row(int y, int z) const { return {rows_.at(y, z), &faces_[cells_ * index(y, z)]}; }

  private:
    std::size_t index(int y, int z) const {
        return static_cast<std::size_t>((z - rows_.z().first) % planes_) *
                   static_cast<std::size_t>(rows_.y().count()) +
               static_cast<std::size_t>(y - rows_.y().first);
    }

    const BlockRows& rows_;
    const int cell_;
    const std::size_t cells_;
    const int planes_;
    int next_;
    std::vector<Magnitudes> magnitudes_;
    Extremes<double>::Array faces_;
};

// Makes the ranges of a block, row of cells by row of cells.
class BlockRanges {
  public:
    BlockRanges(const CellGrid& grid, OccupancyFilter filter, const BlockRows& rows,
                CellRanges& result)
        : grid_(grid),
          filter_(filter),
          halo_(halo_of(filter)),
          seen_(grid, rows, grid.cell + 2 * halo_),
          result_(result) {
        bundle_.length = rows.length();
        bundle_.cell = grid.cell;
    }

    void run(const CellBlock& block) {
        for (int k = block.z.first; k < block.z.last; ++k) {
            const Span z = with_halo(grid_.voxels_of(2, k));
            seen_.see(z.last);
            for (int j = block.y.first; j < block.y.last; ++j) {
                const Span y = grid_.voxels_of(1, j);
                const Magnitudes magnitudes = gather(with_halo(y), z);
                // Ranges are 0 to begin with.
                if (!magnitudes.all_zero()) {
                    make_row(magnitudes, index_of(result_.size, 0, j, k));
                }
            }
        }
    }

  private:
    Span with_halo(Span span) const { return {span.first - halo_, span.last + halo_}; }

    Magnitudes gather(Span y, Span z) {
        bundle_.height = y.count();
        bundle_.depth = z.count();
        bundle_.rows.clear();
        Magnitudes magnitudes;
        for (int plane = z.first; plane < z.last; ++plane) {
            for (int row = y.first; row < y.last; ++row) {
                bundle_.rows.push_back(seen_.row(row, plane));
                magnitudes.add(seen_.magnitudes(row, plane));
            }
        }
        return magnitudes;
    }

    // The ranges of the cells from `first` on.
    void make_row(const Magnitudes& magnitudes, std::size_t first) {
        float* least = &result_.minimum[first];
        float* most = &result_.maximum[first];
        if (filter_ == OccupancyFilter::trilinear) return make_trilinear(magnitudes, least, most);
        footprint_row(bundle_, halo_, scratch_, least, most);
        for (std::size_t i = 0; i < bundle_.cells(); ++i) {
            least[i] += 0.0F;  // a zero without its sign
            most[i] += 0.0F;
        }
    }

    void make_trilinear(const Magnitudes& magnitudes, float* least, float* most) {
        trilinear_row(bundle_, scratch_, extremes_);
        const bool exact = means_are_exact(magnitudes);
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

    const CellGrid& grid_;
    const OccupancyFilter filter_;
    const int halo_;
    SeenRows seen_;
    CellRanges& result_;
    RowBundle bundle_;
    RowScratch scratch_;
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
        BlockRanges(grid, filter, rows, ranges).run(block);
    };
}

}  // namespace

CellRanges cell_ranges(const float* voxels, const CellGrid& grid, OccupancyFilter filter,
                       int threads) {
    CellRanges ranges = zero_ranges(grid);
    for_each_block(voxels, grid, halo_of(filter), threads, ranges_into(ranges, grid, filter));
    return ranges;
}

CellRanges cell_ranges(const ChannelSource& source, const CellGrid& grid, OccupancyFilter filter,
                       const BakeOptions& options) {
    CellRanges ranges = zero_ranges(grid);
    for_each_block(source, grid, halo_of(filter), options, ranges_into(ranges, grid, filter));
    return ranges;
}

}  // namespace skybake::occupancy
