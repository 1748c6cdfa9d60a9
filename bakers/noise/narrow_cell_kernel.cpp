#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/narrow_cell_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bakers/noise/cell_kernel.h"
#include "bakers/noise/cell_tile-inl.h"
#include "bakers/noise/lattice_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {
namespace {

constexpr int kVoxels = static_cast<int>(kLanes);  // of a vector
using LaneIndices = decltype(hn::IndicesFromVec(kFloats, hn::Zero(Integers())));

constexpr int kMostRings = 2;
constexpr std::size_t kMostLines = (2 * kMostRings + 1) * (2 * kMostRings + 1);

// Voxels first ... last - 1 along an axis.
struct Run {
    int first = 0;
    int last = 0;
    // Voxel i, or the last one where there are fewer.
    int at(std::size_t i) const { return std::min(first + static_cast<int>(i), last - 1); }
};

// The voxels from `first` on that lie in its cell.
Run run_from(const AxisCells& axis, int first, int end) {
    const auto cell_of = [&](int voxel) { return axis.cell[static_cast<std::size_t>(voxel)]; };
    Run run{first, first + 1};
    while (run.last < end && cell_of(run.last) == cell_of(first)) ++run.last;
    return run;
}

// The first voxels of a run.
Run part_from(const Run& run, int first, std::size_t most) {
    return {first, std::min(first + static_cast<int>(most), run.last)};
}

// Least distance from voxels to the faces of their cells.
float distance_to_faces(const AxisCells& axis, const Run& run) {
    float least = 1;
    for (int i = run.first; i < run.last; ++i) {
        const float fraction = axis.fraction[static_cast<std::size_t>(i)];
        least = std::min({least, fraction, 1 - fraction});
    }
    return least;
}

// A row of points along x, and the squared distances of the tile's rows and slices from them, at
// `stride` from one to the next.
struct Line {
    const float* x;
    const float* y;
    const float* z;
    float* squared_y;
    float* squared_z;
    float offset_y;  // minus that of the points' cells from the voxels'
    float offset_z;
};

// The rows of points in `rings` of cells about the voxels of one cell along y and z.
struct Lines {
    std::array<Line, kMostLines> line;
    std::size_t count = 0;
};

// The squared distances of a row, or slice, of voxels from `count` points.
void fill_squares(const AxisCells& axis, int voxel, float offset, std::size_t count,
                  const float* HWY_RESTRICT points, float* HWY_RESTRICT squares) {
    const auto fraction = hn::Set(kFloats, axis.fraction[static_cast<std::size_t>(voxel)]);
    for (std::size_t i = 0; i < count; i += kLanes) {
        const auto point = hn::LoadU(kFloats, points + i);
        hn::StoreU(squared_along(fraction, point, hn::Set(kFloats, offset)), kFloats, squares + i);
    }
}

// The lanes of a tile along x.
struct LaneCells {
    FloatVector fraction;
    LaneIndices lanes;   // of their cells, counted from the first lane's
    std::size_t column;  // of the first lane's cell in rows of points, less kMostRings
};

// Returns the value of each lane's cell in a row of values, one per cell.
template <bool kOneCell>
HWY_INLINE FloatVector look_up(const float* values, LaneIndices lanes) {
    if constexpr (kOneCell) return hn::Set(kFloats, *values);
    return hn::TableLookupLanes(hn::LoadU(kFloats, values), lanes);
}

// Takes the points of the cells `kCell` beside the lanes' own.
template <int kCell, bool kOneCell, std::size_t kRows, std::size_t kDepth, bool kSecond>
HWY_INLINE void take_points(const Line& line, std::size_t stride, const LaneCells& x,
                            CellTile<kRows, kDepth, kSecond>& tile) {
    const std::size_t at = x.column + static_cast<std::size_t>(kMostRings + kCell);
    const auto squared_x = squared_along(x.fraction, look_up<kOneCell>(line.x + at, x.lanes),
                                         hn::Set(kFloats, static_cast<float>(-kCell)));
    FloatVector across[kRows];
    HWY_UNROLL(8)
    for (std::size_t row = 0; row < kRows; ++row) {
        const float* squared_y = line.squared_y + row * stride + at;
        across[row] = hn::Add(squared_x, look_up<kOneCell>(squared_y, x.lanes));
    }
    HWY_UNROLL(8)
    for (std::size_t slice = 0; slice < kDepth; ++slice) {
        const float* squares = line.squared_z + slice * stride + at;
        const auto squared_z = look_up<kOneCell>(squares, x.lanes);
        HWY_UNROLL(8)
        for (std::size_t row = 0; row < kRows; ++row) {
            tile.take(row, slice, hn::Add(across[row], squared_z));
        }
    }
}

// Fills a chunk by tiles of kRows and kDepth.
template <std::size_t kRows, std::size_t kDepth, bool kSecond>
class TileFiller {
  public:
    TileFiller(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
               AlignedFloats& squares, const CellTarget& target)
        : field_(field), chunk_(chunk), planes_(planes), squares_(squares), target_(target) {
        squares_.resize(kMostRings * squares_of_rings());
    }

    void fill() {
        const auto [first_x, first_y, first_z] = chunk_.origin;
        const auto& [width, rows, depth] = chunk_.size;
        for (Run z{0, first_z}; z.last < first_z + depth;) {
            z = part_from(run_from(field_.cells[2], z.last, first_z + depth), z.last, kDepth);
            for (Run y{0, first_y}; y.last < first_y + rows;) {
                y = run_from(field_.cells[1], y.last, first_y + rows);
                fill_runs<1>({first_x, first_x + width}, y, z);
            }
        }
    }

  private:
    std::size_t squares_of_rings() const { return kMostLines * (kRows + kDepth) * planes_.stride; }

    // Fills voxels of one cell along y and z.
    template <int kRings>
    void fill_runs(const Run& x, const Run& y, const Run& z) {
        const Lines lines = lines_about<kRings>(y, z);
        // The points of the lanes' cells and the rings about them, from the first on.
        const std::size_t begin = column_of(x.first) - kRings;
        const std::size_t count = column_of(x.last - 1) + kRings + 1 - begin;
        for (std::size_t i = 0; i < lines.count; ++i) {
            const Line& line = lines.line[i];
            for (std::size_t slice = 0; slice < kDepth; ++slice) {
                fill_squares(field_.cells[2], z.at(slice), line.offset_z, count, line.z + begin,
                             line.squared_z + slice * planes_.stride + begin);
            }
        }
        for (Run rows{0, y.first}; rows.last < y.last;) {
            rows = part_from(y, rows.last, kRows);
            for (std::size_t i = 0; i < lines.count; ++i) {
                const Line& line = lines.line[i];
                for (std::size_t row = 0; row < kRows; ++row) {
                    fill_squares(field_.cells[1], rows.at(row), line.offset_y, count,
                                 line.y + begin, line.squared_y + row * planes_.stride + begin);
                }
            }
            fill_tiles<kRings>(lines, x, rows, z);
        }
    }

    // Fills tiles along x. Those that may be nearer to points of further cells are filled again.
    template <int kRings>
    void fill_tiles(const Lines& lines, const Run& x, const Run& rows, const Run& slices) {
        const float margin = std::min(distance_to_faces(field_.cells[1], rows),
                                      distance_to_faces(field_.cells[2], slices));
        const auto& cells = field_.cells[0].cell;
        for (int voxel = x.first; voxel < x.last; voxel += kVoxels) {
            const auto at = static_cast<std::size_t>(voxel);
            float* places[kRows][kDepth];
            for (std::size_t row = 0; row < kRows; ++row) {
                for (std::size_t slice = 0; slice < kDepth; ++slice) {
                    places[row][slice] = target_.at(voxel, rows.at(row), slices.at(slice));
                }
            }
            const bool one_cell = cells[at] == cells[at + kLanes - 1];
            const bool found = one_cell ? fill_tile<kRings, true>(lines, voxel, margin, places)
                                        : fill_tile<kRings, false>(lines, voxel, margin, places);
            if constexpr (kRings < kMostRings) {
                if (!found) fill_runs<kRings + 1>(part_from(x, voxel, kLanes), rows, slices);
            }
        }
    }

    // Returns false if points beyond the rings may be nearer to a voxel.
    template <int kRings, bool kOneCell>
    HWY_INLINE bool fill_tile(const Lines& lines, int voxel, float margin,
                              float* const (&places)[kRows][kDepth]) const {
        const Integers integers;
        const auto at = static_cast<std::size_t>(voxel);
        const std::int32_t* cells = field_.cells[0].cell.data() + at;
        const auto fraction = hn::LoadU(kFloats, field_.cells[0].fraction.data() + at);
        const auto lanes = hn::IndicesFromVec(
            kFloats, hn::Sub(hn::LoadU(integers, cells), hn::Set(integers, cells[0])));
        const LaneCells x{fraction, lanes, column_of(voxel) - kMostRings};
        const std::size_t stride = planes_.stride;
        CellTile<kRows, kDepth, kSecond> tile;
        for (std::size_t i = 0; i < lines.count; ++i) {
            const Line& line = lines.line[i];
            if constexpr (kRings > 1) take_points<-2, kOneCell>(line, stride, x, tile);
            take_points<-1, kOneCell>(line, stride, x, tile);
            take_points<0, kOneCell>(line, stride, x, tile);
            take_points<1, kOneCell>(line, stride, x, tile);
            if constexpr (kRings > 1) take_points<2, kOneCell>(line, stride, x, tile);
        }
        tile.store(field_, [&](std::size_t row, std::size_t slice) { return places[row][slice]; });
        return is_within_rings(tile.farthest(), kRings,
                               hn::Min(hn::Set(kFloats, margin), distance_to_face(fraction)));
    }

    template <int kRings>
    Lines lines_about(const Run& y, const Run& z) {
        const CellPoints points(field_);
        const std::int64_t cell_y = field_.cells[1].cell[static_cast<std::size_t>(y.first)];
        const std::int64_t cell_z = field_.cells[2].cell[static_cast<std::size_t>(z.first)];
        float* squares = squares_.data() + (kRings - 1) * squares_of_rings();
        Lines lines;
        for (int k = -kRings; k <= kRings; ++k) {
            const std::size_t slot = slot_of_plane(cell_z + k, planes_, points);
            for (int j = -kRings; j <= kRings; ++j) {
                const std::size_t row =
                    planes_.row(slot, static_cast<std::size_t>(cell_y + j - planes_.first[1]));
                lines.line[lines.count++] = {planes_.x.data() + row,
                                             planes_.y.data() + row,
                                             planes_.z.data() + row,
                                             squares,
                                             squares + kRows * planes_.stride,
                                             static_cast<float>(-j),
                                             static_cast<float>(-k)};
                squares += (kRows + kDepth) * planes_.stride;
            }
        }
        return lines;
    }

    // The place of a voxel's cell in rows of points.
    std::size_t column_of(int voxel) const {
        return static_cast<std::size_t>(field_.cells[0].cell[static_cast<std::size_t>(voxel)] -
                                        planes_.first[0]);
    }

    const CellField& field_;
    const VoxelBox& chunk_;
    LatticePlanes& planes_;
    AlignedFloats& squares_;
    const CellTarget& target_;
};

// Tiles are no larger than cells and chunks are.
template <bool kSecond>
void fill_as(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
             AlignedFloats& squares, const CellTarget& target) {
    const auto within_a_cell = [&](std::size_t axis) {
        return std::min(voxels_per_cell(field, axis), static_cast<double>(chunk.size[axis]));
    };
    const double rows = within_a_cell(1);
    const double depth = within_a_cell(2);
    if (depth >= 3) {
        TileFiller<2, 4, kSecond>(field, chunk, planes, squares, target).fill();
    } else if (depth > 1) {
        TileFiller<2, 2, kSecond>(field, chunk, planes, squares, target).fill();
    } else if (rows >= 3) {
        TileFiller<4, 1, kSecond>(field, chunk, planes, squares, target).fill();
    } else {
        TileFiller<1, 1, kSecond>(field, chunk, planes, squares, target).fill();
    }
}

}  // namespace

void fill_narrow(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                 AlignedFloats& squares, const CellTarget& target) {
    if (field.feature == config::WorleyFeature::f1) {
        fill_as<false>(field, chunk, planes, squares, target);
    } else {
        fill_as<true>(field, chunk, planes, squares, target);
    }
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(fill_narrow);

void fill_narrow_cells(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                       AlignedFloats& squares, const CellTarget& target) {
    HWY_DYNAMIC_DISPATCH(fill_narrow)(field, chunk, planes, squares, target);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
