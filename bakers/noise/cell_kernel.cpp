#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/cell_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <limits>

#include "bakers/noise/cell_kernel.h"
#include "bakers/noise/cell_value-inl.h"
#include "bakers/noise/lattice_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise {
namespace HWY_NAMESPACE {
namespace {

constexpr Floats kFloats;
static_assert(hn::MaxLanes(kFloats) <= static_cast<std::size_t>(kLanePadding));
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
using Integers = hn::RebindToSigned<Floats>;
constexpr std::size_t kSliceStride = CellCandidates::kSliceStride;

// Voxels first ... last of one axis on the planes, counted in cells from the first voxel's cell.
struct Extent {
    std::int64_t cell = 0;  // of the first voxel
    int cells = 0;          // that the voxels lie in
    float low = 0;          // position of the first voxel
    float high = 0;         // and of the last
};

HWY_INLINE Extent extent_of(const AxisCells& axis, std::size_t first, std::size_t last) {
    const int span = axis.cell[last] - axis.cell[first];
    return {axis.cell[first], span + 1, axis.fraction[first],
            static_cast<float>(span) + axis.fraction[last]};
}

// Distance from the voxels to where cells were not asked, `rings` cells beyond theirs.
HWY_INLINE float margin_of(const Extent& extent, int rings) {
    return static_cast<float>(rings) +
           std::min(extent.low, static_cast<float>(extent.cells) - extent.high);
}

// True if no point beyond one ring of cells is within the squared distance of a voxel. The slack
// is far above what rounding does.
HWY_INLINE bool reaches(float squared_distance, const std::array<Extent, 3>& block) {
    const float margin =
        std::min({margin_of(block[0], 1), margin_of(block[1], 1), margin_of(block[2], 1)});
    return squared_distance * 1.00001f <= margin * margin;
}

// The points of all cells within `rings` of the block's cells.
std::size_t gather(const std::array<Extent, 3>& block, int rings, LatticePlanes& planes,
                   CellCandidates& candidates) {
    std::size_t count = 0;
    const int across = block[0].cells + 2 * rings;
    const auto column = static_cast<std::size_t>(block[0].cell - rings - planes.first[0]);
    const auto first_cell = hn::Iota(kFloats, static_cast<float>(-rings));
    const auto hash = [](RowKey key, WordVector scaled_x)
                          HWY_ATTR { return cell_point(key, scaled_x); };
    for (int z = -rings; z < block[2].cells + rings; ++z) {
        const std::size_t slot = slot_of_plane(block[2].cell + z, planes, hash);
        const auto cell_z = hn::Set(kFloats, static_cast<float>(z));
        for (int y = -rings; y < block[1].cells + rings; ++y) {
            const auto cell_y = hn::Set(kFloats, static_cast<float>(y));
            const auto line = static_cast<std::size_t>(block[1].cell + y - planes.first[1]);
            const std::size_t row = planes.row(slot, line) + column;
            for (std::size_t i = 0; i < static_cast<std::size_t>(across); i += kLanes) {
                const std::size_t to = count + i;
                hn::StoreU(hn::LoadU(kFloats, planes.x.data() + row + i), kFloats,
                           candidates.point_x.data() + to);
                hn::StoreU(hn::LoadU(kFloats, planes.y.data() + row + i), kFloats,
                           candidates.point_y.data() + to);
                hn::StoreU(hn::LoadU(kFloats, planes.z.data() + row + i), kFloats,
                           candidates.point_z.data() + to);
                hn::StoreU(hn::Add(first_cell, hn::Set(kFloats, static_cast<float>(i))), kFloats,
                           candidates.cell_x.data() + to);
                hn::StoreU(cell_y, kFloats, candidates.cell_y.data() + to);
                hn::StoreU(cell_z, kFloats, candidates.cell_z.data() + to);
            }
            count += static_cast<std::size_t>(across);
        }
    }
    return count;
}

// Least and greatest distance along one axis from the block to points.
struct Span {
    FloatVector least, greatest;
};

HWY_INLINE Span span_to(const Extent& extent, FloatVector point, FloatVector cell) {
    const auto place = hn::Add(point, cell);
    const auto below = hn::Sub(hn::Set(kFloats, extent.low), place);
    const auto above = hn::Sub(place, hn::Set(kFloats, extent.high));
    return {hn::Max(hn::Zero(kFloats), hn::Max(below, above)),
            hn::Max(hn::Neg(below), hn::Neg(above))};
}

// The squared distance that some point (for F2, some second point) lies within of every voxel of
// the block; fills candidates.lower.
float bound_of(const std::array<Extent, 3>& block, std::size_t count, bool second,
               CellCandidates& candidates) {
    const auto infinity = hn::Set(kFloats, std::numeric_limits<float>::infinity());
    auto nearest = infinity;
    auto next = infinity;
    for (std::size_t i = 0; i < count; i += kLanes) {
        const Span x = span_to(block[0], hn::LoadU(kFloats, candidates.point_x.data() + i),
                               hn::LoadU(kFloats, candidates.cell_x.data() + i));
        const Span y = span_to(block[1], hn::LoadU(kFloats, candidates.point_y.data() + i),
                               hn::LoadU(kFloats, candidates.cell_y.data() + i));
        const Span z = span_to(block[2], hn::LoadU(kFloats, candidates.point_z.data() + i),
                               hn::LoadU(kFloats, candidates.cell_z.data() + i));
        const auto squares = [](FloatVector a, FloatVector b, FloatVector c) HWY_ATTR {
            return hn::Add(hn::Add(hn::Mul(a, a), hn::Mul(b, b)), hn::Mul(c, c));
        };
        hn::StoreU(squares(x.least, y.least, z.least), kFloats, candidates.lower.data() + i);
        auto upper = squares(x.greatest, y.greatest, z.greatest);
        if (i + kLanes > count) {
            upper = hn::IfThenElse(hn::FirstN(kFloats, count - i), upper, infinity);
        }
        next = hn::Min(next, hn::Max(nearest, upper));
        nearest = hn::Min(nearest, upper);
    }
    if (!second) return hn::GetLane(hn::MinOfLanes(kFloats, nearest));
    HWY_ALIGN float least[2 * kLanes];
    hn::Store(nearest, kFloats, least);
    hn::Store(next, kFloats, least + kLanes);
    std::nth_element(least, least + 1, least + 2 * kLanes);
    return least[1];
}

// Moves the lanes that a mask names to the front of a vector, in their order. What the lanes behind
// them hold does not matter.
#if HWY_TARGET == HWY_AVX2
// At each call of Highway's Compress, GCC copies its table of 1 KiB to the stack. Vectors of eight
// lanes have a table of their own instead: the lanes that each mask names, and zeros behind them.
using LanesOfMasks = std::array<std::array<std::int32_t, 8>, 256>;

constexpr LanesOfMasks make_lanes_of_masks() {
    LanesOfMasks lanes{};
    for (std::size_t mask = 0; mask < lanes.size(); ++mask) {
        std::size_t count = 0;
        for (std::int32_t lane = 0; lane < 8; ++lane) {
            if ((mask >> lane & 1) != 0) lanes[mask][count++] = lane;
        }
    }
    return lanes;
}

alignas(64) constexpr LanesOfMasks kLanesOfMasks = make_lanes_of_masks();

class LanePacker {
  public:
    HWY_INLINE explicit LanePacker(hn::Mask<Floats> wanted)
        : lanes_(hn::IndicesFromVec(kFloats,
                                    hn::Load(Integers(), kLanesOfMasks[bits_of(wanted)].data()))) {}
    HWY_INLINE FloatVector operator()(FloatVector values) const {
        return hn::TableLookupLanes(values, lanes_);
    }

  private:
    static HWY_INLINE std::size_t bits_of(hn::Mask<Floats> mask) {
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(kFloats, mask, bits);
        return bits[0];
    }

    decltype(hn::IndicesFromVec(kFloats, hn::Zero(Integers()))) lanes_;
};
#else
class LanePacker {
  public:
    HWY_INLINE explicit LanePacker(hn::Mask<Floats> wanted) : wanted_(wanted) {}
    HWY_INLINE FloatVector operator()(FloatVector values) const {
        return hn::Compress(values, wanted_);
    }

  private:
    hn::Mask<Floats> wanted_;
};
#endif

// Keeps the candidates that may be within the bound of some voxel. The margin is far above what
// rounding can do to the bounds.
std::size_t keep_near(std::size_t count, float bound, CellCandidates& candidates) {
    const auto limit = hn::Set(kFloats, bound * 1.00001f + 1e-6f);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; i += kLanes) {
        auto near = hn::Le(hn::LoadU(kFloats, candidates.lower.data() + i), limit);
        if (i + kLanes > count) near = hn::And(near, hn::FirstN(kFloats, count - i));
        const std::size_t more = hn::CountTrue(kFloats, near);
        if (more == 0) continue;
        const LanePacker pack(near);
        for (AlignedFloats* values : {&candidates.point_x, &candidates.point_y, &candidates.point_z,
                                      &candidates.cell_x, &candidates.cell_y, &candidates.cell_z}) {
            hn::StoreU(pack(hn::LoadU(kFloats, values->data() + i)), kFloats,
                       values->data() + kept);
        }
        kept += more;
    }
    return kept;
}

// The candidates within the bound; more rings of cells than one where the bound asks for them.
std::size_t near_candidates(const CellField& field, const std::array<Extent, 3>& block, int rings,
                            LatticePlanes& planes, CellCandidates& candidates) {
    const bool second = field.feature != config::WorleyFeature::f1;
    std::size_t count = gather(block, rings, planes, candidates);
    float bound = bound_of(block, count, second, candidates);
    if (rings == 1 && !reaches(bound, block)) {
        count = gather(block, 2, planes, candidates);
        bound = bound_of(block, count, second, candidates);
    }
    return keep_near(count, bound, candidates);
}

// --- Distances ----------------------------------------------------------------------------------

// Squared distance along one axis of lanes at `fraction` in cell `cell` to one point: the
// specification's ((fraction - point) - offset)^2.
HWY_INLINE FloatVector squared_along(FloatVector fraction, FloatVector cell, float point,
                                     float point_cell) {
    const auto distance = hn::Add(hn::Sub(fraction, hn::Set(kFloats, point)),
                                  hn::Sub(cell, hn::Set(kFloats, point_cell)));
    return hn::Mul(distance, distance);
}

// How the lanes of a vector lie over voxels, and how big blocks are.
struct BlockShape {
    std::size_t across = kLanes;  // lanes along x; the others are rows
    int rows = 8;                 // of a block
    int depth = 8;                // slices
    bool prune = true;            // worth it where blocks are smaller than cells
};

// Positions of a patch's lanes along one axis: in their cells, and these counted from the block's.
struct LanePositions {
    FloatVector fraction, cell;
};

using LaneIndices = decltype(hn::IndicesFromVec(kFloats, hn::Zero(Integers())));

HWY_INLINE LanePositions lane_positions(const AxisCells& axis, int voxel, std::int64_t block_cell,
                                        LaneIndices lanes) {
    const Integers integers;
    const auto at = static_cast<std::size_t>(voxel);
    const auto cell = hn::Sub(hn::LoadU(integers, axis.cell.data() + at),
                              hn::Set(integers, static_cast<std::int32_t>(block_cell)));
    return {hn::TableLookupLanes(hn::LoadU(kFloats, axis.fraction.data() + at), lanes),
            hn::TableLookupLanes(hn::ConvertTo(kFloats, cell), lanes)};
}

// Of each lane of a patch, its column and its row.
HWY_INLINE LaneIndices lane_columns(std::size_t across) {
    const Integers integers;
    const auto mask = hn::Set(integers, static_cast<std::int32_t>(across - 1));
    return hn::IndicesFromVec(kFloats, hn::And(hn::Iota(integers, 0), mask));
}
HWY_INLINE LaneIndices lane_rows(std::size_t across) {
    const Integers integers;
    const int shift = across == 4 ? 2 : across == 8 ? 3 : 4;
    return hn::IndicesFromVec(kFloats, hn::ShiftRightSame(hn::Iota(integers, 0), shift));
}

struct Block {
    VoxelBox box;
    std::array<Extent, 3> extent;
};

template <int kDepth, bool kSecond>
HWY_INLINE void fill_patch(const CellField& field, const CellCandidates& candidates,
                           std::size_t count, const LanePositions& rows,
                           FloatVector* HWY_RESTRICT values, FloatVector& farthest) {
    const auto infinity = hn::Set(kFloats, std::numeric_limits<float>::infinity());
    FloatVector nearest[kDepth];
    FloatVector next[kDepth];
    for (int z = 0; z < kDepth; ++z) {
        nearest[z] = infinity;
        if (kSecond) next[z] = infinity;
    }
    const float* HWY_RESTRICT point_y = candidates.point_y.data();
    const float* HWY_RESTRICT cell_y = candidates.cell_y.data();
    const float* HWY_RESTRICT squared_x = candidates.squared_x.data();
    const float* HWY_RESTRICT squared_z = candidates.squared_z.data();
    for (std::size_t k = 0; k < count; ++k) {
        const auto across = hn::Add(hn::Load(kFloats, squared_x + k * kLanes),
                                    squared_along(rows.fraction, rows.cell, point_y[k], cell_y[k]));
        for (int z = 0; z < kDepth; ++z) {
            const auto squared = hn::Add(
                across,
                hn::Set(kFloats, squared_z[static_cast<std::size_t>(z) * kSliceStride + k]));
            if (kSecond) next[z] = hn::Min(next[z], hn::Max(nearest[z], squared));
            nearest[z] = hn::Min(nearest[z], squared);
        }
    }
    for (int z = 0; z < kDepth; ++z) {
        farthest = hn::Max(farthest, kSecond ? next[z] : nearest[z]);
        values[z] =
            cell_value(field.feature, field.value_form, nearest[z], kSecond ? next[z] : nearest[z]);
    }
}

HWY_INLINE void fill_squares(const CellField& field, const Block& block, const BlockShape& shape,
                             std::size_t count, CellCandidates& candidates) {
    const LanePositions columns = lane_positions(field.cells[0], block.box.origin[0],
                                                 block.extent[0].cell, lane_columns(shape.across));
    for (std::size_t k = 0; k < count; ++k) {
        hn::Store(squared_along(columns.fraction, columns.cell, candidates.point_x[k],
                                candidates.cell_x[k]),
                  kFloats, candidates.squared_x.data() + k * kLanes);
    }
    for (std::size_t slice = 0; slice < static_cast<std::size_t>(block.box.size[2]); ++slice) {
        const std::size_t voxel = static_cast<std::size_t>(block.box.origin[2]) + slice;
        const auto fraction = hn::Set(kFloats, field.cells[2].fraction[voxel]);
        const auto cell =
            hn::Set(kFloats, static_cast<float>(field.cells[2].cell[voxel] - block.extent[2].cell));
        float* HWY_RESTRICT squared_z = candidates.squared_z.data() + slice * kSliceStride;
        for (std::size_t k = 0; k < count; k += kLanes) {
            const auto distance =
                hn::Add(hn::Sub(fraction, hn::Load(kFloats, candidates.point_z.data() + k)),
                        hn::Sub(cell, hn::Load(kFloats, candidates.cell_z.data() + k)));
            hn::Store(hn::Mul(distance, distance), kFloats, squared_z + k);
        }
    }
}

// Writes one slice of a patch, rows of `across` lanes.
HWY_INLINE void store_patch(FloatVector value, std::size_t across, int rows, std::size_t row_stride,
                            float* out) {
    if (across == kLanes) {
        hn::StoreU(value, kFloats, out);
        return;
    }
    HWY_ALIGN float lanes[kLanes];
    hn::Store(value, kFloats, lanes);
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        std::memcpy(out + row * row_stride, lanes + row * across, across * sizeof(float));
    }
}

// The target of a chunk.
struct ChunkRows {
    const VoxelBox& chunk;
    std::size_t row_stride;
    float* out;
    float* at(int x, int y, int z) const {
        const int row = (z - chunk.origin[2]) * chunk.size[1] + (y - chunk.origin[1]);
        return out + static_cast<std::size_t>(row) * row_stride +
               static_cast<std::size_t>(x - chunk.origin[0]);
    }
};

// Fills the block from the candidates; the largest of the squared distances that were decisive.
template <int kDepth, bool kSecond>
float fill_patches(const CellField& field, const Block& block, const BlockShape& shape,
                   std::size_t count, CellCandidates& candidates, const ChunkRows& target) {
    fill_squares(field, block, shape, count, candidates);
    const auto patch_rows = static_cast<int>(kLanes / shape.across);
    const auto& [x, first_y, z] = block.box.origin;
    const int end_y = first_y + block.box.size[1];
    const LaneIndices row_of_lane = lane_rows(shape.across);
    auto farthest = hn::Zero(kFloats);
    for (int y = first_y; y < end_y; y += patch_rows) {
        const LanePositions rows =
            lane_positions(field.cells[1], y, block.extent[1].cell, row_of_lane);
        FloatVector values[kDepth];
        fill_patch<kDepth, kSecond>(field, candidates, count, rows, values, farthest);
        for (int slice = 0; slice < block.box.size[2]; ++slice) {
            store_patch(values[slice], shape.across, std::min(patch_rows, end_y - y),
                        target.row_stride, target.at(x, y, z + slice));
        }
    }
    return hn::GetLane(hn::MaxOfLanes(kFloats, farthest));
}

template <int kDepth, bool kSecond>
void fill_block(const CellField& field, const Block& block, const BlockShape& shape,
                LatticePlanes& planes, CellCandidates& candidates, const ChunkRows& target) {
    if (!shape.prune) {
        const std::size_t count = gather(block.extent, 1, planes, candidates);
        const float farthest =
            fill_patches<kDepth, kSecond>(field, block, shape, count, candidates, target);
        if (reaches(farthest, block.extent)) return;
    }
    const int rings = shape.prune ? 1 : 2;
    const std::size_t count = near_candidates(field, block.extent, rings, planes, candidates);
    fill_patches<kDepth, kSecond>(field, block, shape, count, candidates, target);
}

// Blocks of about half a cell where cells are wide, of about a cell or more where they are narrow:
// there dropping points costs more than looking at them. The bounds are the best of those tried.
BlockShape shape_of(const CellField& field) {
    std::array<double, 3> voxels_per_cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto voxels = static_cast<double>(field.cells[axis].cell.size() - kLanePadding);
        voxels_per_cell[axis] = voxels / field.frequency[axis];
    }
    const auto& [x, y, z] = voxels_per_cell;
    BlockShape shape;
    shape.across = std::min<std::size_t>(kLanes, x >= 6 ? 16 : x >= 3 ? 8 : 4);
    shape.rows = y >= 24 ? 16 : y >= 6 ? 8 : 4;
    shape.depth = z >= 6 ? 8 : 4;
    shape.prune = x * y * z >= 12 * 12 * 12;
    return shape;
}

template <bool kSecond>
void fill_blocks(const CellField& field, const BlockShape& shape, LatticePlanes& planes,
                 CellCandidates& candidates, const ChunkRows& target) {
    const VoxelBox& chunk = target.chunk;
    const auto across = static_cast<int>(shape.across);
    const auto extent = [&](std::size_t axis, const Block& block) {
        const auto first = static_cast<std::size_t>(block.box.origin[axis]);
        return extent_of(field.cells[axis], first,
                         first + static_cast<std::size_t>(block.box.size[axis]) - 1);
    };
    Block block;
    for (int z = 0; z < chunk.size[2]; z += shape.depth) {
        block.box.origin[2] = chunk.origin[2] + z;
        block.box.size[2] = std::min(shape.depth, chunk.size[2] - z);
        block.extent[2] = extent(2, block);
        const auto fill = block.box.size[2] > 4   ? fill_block<8, kSecond>
                          : block.box.size[2] > 2 ? fill_block<4, kSecond>
                          : block.box.size[2] > 1 ? fill_block<2, kSecond>
                                                  : fill_block<1, kSecond>;
        for (int y = 0; y < chunk.size[1]; y += shape.rows) {
            block.box.origin[1] = chunk.origin[1] + y;
            block.box.size[1] = std::min(shape.rows, chunk.size[1] - y);
            block.extent[1] = extent(1, block);
            for (int x = 0; x < chunk.size[0]; x += across) {
                block.box.origin[0] = chunk.origin[0] + x;
                block.box.size[0] = std::min(across, chunk.size[0] - x);
                block.extent[0] = extent(0, block);
                fill(field, block, shape, planes, candidates, target);
            }
        }
    }
}

}  // namespace

void fill_field(const CellField& field, const VoxelBox& chunk, std::size_t row_stride,
                LatticePlanes& planes, CellCandidates& candidates, float* out) {
    const BlockShape shape = shape_of(field);
    const ChunkRows target{chunk, row_stride, out};
    if (field.feature == config::WorleyFeature::f1) {
        fill_blocks<false>(field, shape, planes, candidates, target);
    } else {
        fill_blocks<true>(field, shape, planes, candidates, target);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::noise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(fill_field);

CellCandidates::CellCandidates() {
    constexpr std::size_t kPadding = kLanePadding;
    constexpr std::size_t kCount = kMost + kPadding;
    for (AlignedFloats* values :
         {&point_x, &point_y, &point_z, &cell_x, &cell_y, &cell_z, &lower}) {
        values->resize(kCount);
    }
    squared_x.resize(kCount * kPadding);
    squared_z.resize(kDepth * kSliceStride);
}

LatticePlanes make_cell_planes(const CellField& field, const VoxelBox& box, int chunk_depth) {
    constexpr int kRings = 2;
    return make_lattice_planes(field.frequency, field.key, field.cells, box, chunk_depth, kRings,
                               kRings);
}

void fill_cell_field(const CellField& field, const VoxelBox& chunk, std::size_t row_stride,
                     LatticePlanes& planes, CellCandidates& candidates, float* out) {
    assert(row_stride % kLanePadding == 0);
    assert(row_stride >= static_cast<std::size_t>(chunk.size[0]));
    HWY_DYNAMIC_DISPATCH(fill_field)(field, chunk, row_stride, planes, candidates, out);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
