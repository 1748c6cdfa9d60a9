#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/bump_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "bakers/noise/cell_kernel.h"
#include "bakers/noise/cell_tile-inl.h"
#include "bakers/noise/lattice_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {
namespace {

constexpr int kRows = 8;    // of a block
constexpr int kSlices = 8;  // of a block
// Cells have four voxels or more: 16 voxels reach into five of them and 8 into three, and points may be
// one cell farther off on either side.
constexpr std::size_t kMostPoints = (5 + 2) * (3 + 2) * (3 + 2);

// The points of cells, of which planes hold the places and the heights of the bumps.
class BumpPoints : public CellPoints {
  public:
    using CellPoints::CellPoints;
    HWY_INLINE void store(RowKey key, WordVector scaled_x, LatticePlanes& planes,
                          std::size_t at) const {
        const CellPointVector point = CellPoints::store(key, scaled_x, planes, at);
        hn::StoreU(point.height, kFloats, planes.rest.data() + at);
    }
};

// A point in its cell, which is counted from the block's first.
struct Bump {
    std::array<float, 3> point;
    std::array<float, 3> cell;
    float height;
};

// The squared distance along one axis from the block to a point.
float squared_to(const Extent& extent, float place) {
    const float distance = std::max({0.0F, extent.low - place, place - extent.high});
    return distance * distance;
}

struct Block {
    VoxelBox box;
    std::array<Extent, 3> extent;
    std::array<Bump, kMostPoints> bumps;
    std::size_t count = 0;
};

// Finds the points that are within a cell of the block. The margin is far above what rounding does.
void find_bumps(const CellField& field, LatticePlanes& planes, Block& block) {
    constexpr float kReach = 1.00001F;
    const BumpPoints points(field);
    const std::array<Extent, 3>& extent = block.extent;
    block.count = 0;
    for (int z = -1; z <= extent[2].cells; ++z) {
        const std::size_t slot = slot_of_plane(extent[2].cell + z, planes, points);
        for (int y = -1; y <= extent[1].cells; ++y) {
            const auto line = static_cast<std::size_t>(extent[1].cell + y - planes.first[1]);
            const std::size_t row = planes.row(slot, line);
            for (int x = -1; x <= extent[0].cells; ++x) {
                const std::size_t at =
                    row + static_cast<std::size_t>(extent[0].cell + x - planes.first[0]);
                const Bump bump{
                    {planes.x[at], planes.y[at], planes.z[at]},
                    {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)},
                    planes.rest[at]};
                float squared = 0;
                for (std::size_t a = 0; a < 3; ++a) {
                    squared += squared_to(extent[a], bump.point[a] + bump.cell[a]);
                }
                if (squared < kReach) block.bumps[block.count++] = bump;
            }
        }
    }
}

void fill_squared_x(const CellField& field, const Block& block, AlignedFloats& squared_x) {
    const Integers integers;
    const AxisCells& axis = field.cells[0];
    const auto first = static_cast<std::size_t>(block.box.origin[0]);
    const auto fraction = hn::LoadU(kFloats, axis.fraction.data() + first);
    const auto cell = hn::ConvertTo(
        kFloats, hn::Sub(hn::LoadU(integers, axis.cell.data() + first),
                         hn::Set(integers, static_cast<std::int32_t>(block.extent[0].cell))));
    for (std::size_t k = 0; k < block.count; ++k) {
        const Bump& bump = block.bumps[k];
        hn::Store(squared_along(fraction, hn::Set(kFloats, bump.point[0]),
                                hn::Sub(cell, hn::Set(kFloats, bump.cell[0]))),
                  kFloats, squared_x.data() + k * kLanes);
    }
}

// The squared distances of a row or a slice of voxels from all points.
using LineSquares = std::array<float, kMostPoints>;

void fill_line(const CellField& field, const Block& block, std::size_t axis, int voxel,
               LineSquares& squares) {
    const AxisCells& cells = field.cells[axis];
    const auto at = static_cast<std::size_t>(voxel);
    const auto cell = static_cast<float>(cells.cell[at] - block.extent[axis].cell);
    for (std::size_t k = 0; k < block.count; ++k) {
        const Bump& bump = block.bumps[k];
        const float distance = (cells.fraction[at] - bump.point[axis]) + (cell - bump.cell[axis]);
        squares[k] = distance * distance;
    }
}

void fill_block(const CellField& field, LatticePlanes& planes, Block& block,
                AlignedFloats& squared_x, const CellTarget& target) {
    find_bumps(field, planes, block);
    fill_squared_x(field, block, squared_x);
    const VoxelBox& box = block.box;
    std::array<LineSquares, kSlices> squared_z;
    LineSquares squared_y;
    for (int z = 0; z < box.size[2]; ++z) {
        fill_line(field, block, 2, box.origin[2] + z, squared_z[static_cast<std::size_t>(z)]);
    }
    for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) {
        fill_line(field, block, 1, y, squared_y);
        for (int z = 0; z < box.size[2]; ++z) {
            const LineSquares& along_z = squared_z[static_cast<std::size_t>(z)];
            GreatestBumpsVector<FloatVector> bumps{hn::Zero(kFloats), hn::Zero(kFloats)};
            for (std::size_t k = 0; k < block.count; ++k) {
                const auto across = hn::Add(hn::Load(kFloats, squared_x.data() + k * kLanes),
                                            hn::Set(kFloats, squared_y[k]));
                bumps.add(hn::Add(across, hn::Set(kFloats, along_z[k])),
                          hn::Set(kFloats, block.bumps[k].height));
            }
            hn::StoreU(bumps.value(), kFloats, target.at(box.origin[0], y, box.origin[2] + z));
        }
    }
}

}  // namespace

void fill_blocks(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                 AlignedFloats& squared_x, const CellTarget& target) {
    constexpr std::array<int, 3> most = {static_cast<int>(kLanes), kRows, kSlices};
    squared_x.resize(kMostPoints * kLanes);
    Block block;
    const auto place = [&](std::size_t axis, int first) {
        block.box.origin[axis] = chunk.origin[axis] + first;
        block.box.size[axis] = std::min(most[axis], chunk.size[axis] - first);
        block.extent[axis] =
            extent_of(field.cells[axis], block.box.origin[axis], block.box.size[axis]);
    };
    for (int z = 0; z < chunk.size[2]; z += most[2]) {
        place(2, z);
        for (int y = 0; y < chunk.size[1]; y += most[1]) {
            place(1, y);
            for (int x = 0; x < chunk.size[0]; x += most[0]) {
                place(0, x);
                fill_block(field, planes, block, squared_x, target);
            }
        }
    }
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(fill_blocks);

LatticePlanes make_bump_planes(const CellField& field, const VoxelBox& box, int chunk_depth) {
    LatticePlanes planes =
        make_lattice_planes(field.frequency, field.key, field.cells, box, chunk_depth, 1, 1);
    planes.rest.resize(planes.x.size());
    return planes;
}

bool has_wide_bumps(const CellField& field) {
    constexpr double kFewestVoxels = 4;
    return voxels_per_cell(field, 0) >= kFewestVoxels &&
           voxels_per_cell(field, 1) >= kFewestVoxels && voxels_per_cell(field, 2) >= kFewestVoxels;
}

void fill_bumps(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                AlignedFloats& squared_x, const CellTarget& target) {
    HWY_DYNAMIC_DISPATCH(fill_blocks)(field, chunk, planes, squared_x, target);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
