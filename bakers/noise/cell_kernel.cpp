#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/cell_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "bakers/noise/cell_kernel.h"
#include "bakers/noise/cell_tile-inl.h"
#include "bakers/noise/lattice_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {
namespace {

constexpr std::size_t kLineStride = CellCandidates::kLineStride;

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
std::size_t gather(const CellPoints& points, const std::array<Extent, 3>& block, int rings,
                   LatticePlanes& planes, CellCandidates& candidates) {
    std::size_t count = 0;
    const int across = block[0].cells + 2 * rings;
    const auto column = static_cast<std::size_t>(block[0].cell - rings - planes.first[0]);
    const auto first_cell = hn::Iota(kFloats, static_cast<float>(-rings));
    for (int z = -rings; z < block[2].cells + rings; ++z) {
        const std::size_t slot = slot_of_plane(block[2].cell + z, planes, points);
        const auto cell_z = hn::Set(kFloats, static_cast<float>(z));
        for (int y = -rings; y < block[1].cells + rings; ++y) {
            const auto cell_y = hn::Set(kFloats, static_cast<float>(y));
            const auto line = static_cast<std::size_t>(block[1].cell + y - planes.first[1]);
            const std::size_t row = planes.row(slot, line) + column;
            for (std::size_t i = 0; i < static_cast<std::size_t>(across); i += kLanes) {
                const std::size_t to = count + i;
                const auto copy = [&](const AlignedFloats& from, AlignedFloats& into) HWY_ATTR {
                    hn::StoreU(hn::LoadU(kFloats, from.data() + row + i), kFloats,
                               into.data() + to);
                };
                copy(planes.x, candidates.point_x);
                copy(planes.y, candidates.point_y);
                copy(planes.z, candidates.point_z);
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
std::size_t near_candidates(const CellField& field, const std::array<Extent, 3>& block,
                            LatticePlanes& planes, CellCandidates& candidates) {
    const bool second = field.feature != config::WorleyFeature::f1;
    const CellPoints points(field);
    std::size_t count = gather(points, block, 1, planes, candidates);
    float bound = bound_of(block, count, second, candidates);
    if (!reaches(bound, block)) {
        count = gather(points, block, 2, planes, candidates);
        bound = bound_of(block, count, second, candidates);
    }
    return keep_near(count, bound, candidates);
}

// --- Distances ----------------------------------------------------------------------------------

// Blocks are as wide as a vector.
constexpr int kBlockWidth = static_cast<int>(kLanes);

struct Block {
    VoxelBox box;
    std::array<Extent, 3> extent;
};

// Squared distances along x of a vector of voxels from each candidate.
void fill_squared_x(const CellField& field, const Block& block, std::size_t count,
                    CellCandidates& candidates) {
    const AxisCells& axis = field.cells[0];
    const auto first = static_cast<std::size_t>(block.box.origin[0]);
    const auto fraction = hn::LoadU(kFloats, axis.fraction.data() + first);
    const Integers integers;
    const auto cell = hn::ConvertTo(
        kFloats, hn::Sub(hn::LoadU(integers, axis.cell.data() + first),
                         hn::Set(integers, static_cast<std::int32_t>(block.extent[0].cell))));
    for (std::size_t k = 0; k < count; ++k) {
        const auto offset = hn::Sub(cell, hn::Set(kFloats, candidates.cell_x[k]));
        const auto squared =
            squared_along(fraction, hn::Set(kFloats, candidates.point_x[k]), offset);
        hn::Store(squared, kFloats, candidates.squared_x.data() + k * kLanes);
    }
}

// Squared distances of one row, or slice, of voxels from each candidate.
void fill_line(const AxisCells& axis, int voxel, const Extent& extent, std::size_t count,
               const float* HWY_RESTRICT points, const float* HWY_RESTRICT cells,
               float* HWY_RESTRICT squares) {
    const auto at = static_cast<std::size_t>(voxel);
    const auto fraction = hn::Set(kFloats, axis.fraction[at]);
    const auto cell = hn::Set(kFloats, static_cast<float>(axis.cell[at] - extent.cell));
    for (std::size_t k = 0; k < count; k += kLanes) {
        const auto offset = hn::Sub(cell, hn::Load(kFloats, cells + k));
        hn::Store(squared_along(fraction, hn::Load(kFloats, points + k), offset), kFloats,
                  squares + k);
    }
}

// Fills the block from the candidates. A block of fewer slices than kDepth has its last one again.
template <int kDepth, bool kSecond>
void fill_voxels(const CellField& field, const Block& block, std::size_t count,
                 CellCandidates& candidates, const CellTarget& target) {
    const int x = block.box.origin[0];
    const int first_y = block.box.origin[1];
    const auto slice = [&](std::size_t i) {
        return block.box.origin[2] + std::min(static_cast<int>(i), block.box.size[2] - 1);
    };
    fill_squared_x(field, block, count, candidates);
    for (std::size_t i = 0; i < kDepth; ++i) {
        fill_line(field.cells[2], slice(i), block.extent[2], count, candidates.point_z.data(),
                  candidates.cell_z.data(), candidates.squared_z.data() + i * kLineStride);
    }
    const float* HWY_RESTRICT squared_x = candidates.squared_x.data();
    const float* HWY_RESTRICT squared_y = candidates.squared_y.data();
    const float* HWY_RESTRICT squared_z = candidates.squared_z.data();
    for (int y = first_y; y < first_y + block.box.size[1]; ++y) {
        fill_line(field.cells[1], y, block.extent[1], count, candidates.point_y.data(),
                  candidates.cell_y.data(), candidates.squared_y.data());
        CellTile<1, kDepth, kSecond> tile;
        for (std::size_t k = 0; k < count; ++k) {
            const auto across =
                hn::Add(hn::Load(kFloats, squared_x + k * kLanes), hn::Set(kFloats, squared_y[k]));
            HWY_UNROLL(8)
            for (std::size_t i = 0; i < kDepth; ++i) {
                tile.take(0, i, hn::Add(across, hn::Set(kFloats, squared_z[i * kLineStride + k])));
            }
        }
        tile.store(field, [&](std::size_t, std::size_t i) { return target.at(x, y, slice(i)); });
    }
}

template <int kDepth, bool kSecond>
void fill_block(const CellField& field, const Block& block, LatticePlanes& planes,
                CellCandidates& candidates, const CellTarget& target) {
    const std::size_t count = near_candidates(field, block.extent, planes, candidates);
    fill_voxels<kDepth, kSecond>(field, block, count, candidates, target);
}

template <bool kSecond>
void fill_blocks(const CellField& field, LatticePlanes& planes, CellCandidates& candidates,
                 const VoxelBox& chunk, const CellTarget& target) {
    const int block_rows = voxels_per_cell(field, 1) >= 24 ? 16 : 8;
    const auto extent = [&](std::size_t axis, const Block& block) {
        return extent_of(field.cells[axis], block.box.origin[axis], block.box.size[axis]);
    };
    Block block;
    for (int z = 0; z < chunk.size[2]; z += CellCandidates::kDepth) {
        block.box.origin[2] = chunk.origin[2] + z;
        block.box.size[2] = std::min(CellCandidates::kDepth, chunk.size[2] - z);
        block.extent[2] = extent(2, block);
        const auto fill = block.box.size[2] > 4   ? fill_block<8, kSecond>
                          : block.box.size[2] > 2 ? fill_block<4, kSecond>
                          : block.box.size[2] > 1 ? fill_block<2, kSecond>
                                                  : fill_block<1, kSecond>;
        for (int y = 0; y < chunk.size[1]; y += block_rows) {
            block.box.origin[1] = chunk.origin[1] + y;
            block.box.size[1] = std::min(block_rows, chunk.size[1] - y);
            block.extent[1] = extent(1, block);
            for (int x = 0; x < chunk.size[0]; x += kBlockWidth) {
                block.box.origin[0] = chunk.origin[0] + x;
                block.box.size[0] = std::min(kBlockWidth, chunk.size[0] - x);
                block.extent[0] = extent(0, block);
                fill(field, block, planes, candidates, target);
            }
        }
    }
}

}  // namespace

void fill_field(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                CellCandidates& candidates, const CellTarget& target) {
    if (field.feature == config::WorleyFeature::f1) {
        fill_blocks<false>(field, planes, candidates, chunk, target);
    } else {
        fill_blocks<true>(field, planes, candidates, chunk, target);
    }
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(fill_field);

CellCandidates::CellCandidates() {
    constexpr std::size_t kPadding = kLanePadding;
    constexpr std::size_t kCount = kMost + kPadding;
    for (AlignedFloats* values :
         {&point_x, &point_y, &point_z, &cell_x, &cell_y, &cell_z, &lower, &squared_y}) {
        values->resize(kCount);
    }
    squared_x.resize(kCount * kPadding);
    squared_z.resize(kDepth * kLineStride);
}

LatticePlanes make_cell_planes(const CellField& field, const VoxelBox& box, int chunk_depth) {
    constexpr int kRings = 2;
    return make_lattice_planes(field.frequency, field.key, field.cells, box, chunk_depth, kRings,
                               kRings);
}

double voxels_per_cell(const CellField& field, std::size_t axis) {
    const auto voxels = static_cast<double>(field.cells[axis].cell.size() - kLanePadding);
    return voxels / field.frequency[axis];
}

bool has_wide_cells(const CellField& field) {
    const double x = voxels_per_cell(field, 0);
    const double y = voxels_per_cell(field, 1);
    const double z = voxels_per_cell(field, 2);
    return std::min({x, y, z}) >= 6 && x * y * z > 8 * 8 * 8;
}

void fill_wide_cells(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                     CellCandidates& candidates, const CellTarget& target) {
    HWY_DYNAMIC_DISPATCH(fill_field)(field, chunk, planes, candidates, target);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
