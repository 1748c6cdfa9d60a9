#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/gradient_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>

#include "bakers/noise/gradient_kernel.h"
#include "bakers/noise/lattice_hash-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise {
namespace HWY_NAMESPACE {
namespace {

constexpr Floats kFloats;
static_assert(hn::MaxLanes(kFloats) <= static_cast<std::size_t>(kLanePadding));
using Integers = hn::RebindToSigned<Floats>;

// The gradients of one lattice plane.
void hash_plane(const GradientOctave& octave, std::int64_t plane, std::size_t slot,
                GradientLattice& lattice) {
    const Words words;
    const std::uint32_t z = wrapped_cell(plane, octave.frequency[2]);
    const auto rows = static_cast<std::size_t>(lattice.count[1]);
    for (std::size_t j = 0; j < rows; ++j) {
        const std::uint32_t y =
            wrapped_cell(lattice.first[1] + static_cast<std::int64_t>(j), octave.frequency[1]);
        const RowKey key = row_key(octave.key, y, z);
        const std::size_t row = (slot * rows + j) * lattice.stride;
        for (std::size_t i = 0; i < static_cast<std::size_t>(lattice.count[0]);
             i += hn::Lanes(kFloats)) {
            const auto gradient =
                lattice_gradient(key, hn::LoadU(words, lattice.scaled_x.data() + i));
            hn::StoreU(gradient.x, kFloats, lattice.x.data() + row + i);
            hn::StoreU(gradient.y, kFloats, lattice.y.data() + row + i);
            hn::StoreU(gradient.z, kFloats, lattice.z.data() + row + i);
        }
    }
    lattice.plane_of_slot[slot] = plane;
}

std::size_t slot_of_plane(const GradientOctave& octave, std::int64_t plane,
                          GradientLattice& lattice) {
    const auto slot = static_cast<std::size_t>(plane % lattice.count[2]);
    if (lattice.plane_of_slot[slot] != plane) hash_plane(octave, plane, slot, lattice);
    return slot;
}

// Blends the two planes about a slice, for lattice rows begin ... end - 1.
void blend_slice(const GradientOctave& octave, int slice, std::size_t begin, std::size_t end,
                 GradientLattice& lattice) {
    const auto at = static_cast<std::size_t>(slice);
    const std::int64_t plane = octave.cells[2].cell[at];
    const auto rows = static_cast<std::size_t>(lattice.count[1]);
    const std::size_t near = slot_of_plane(octave, plane, lattice) * rows * lattice.stride;
    const std::size_t far = slot_of_plane(octave, plane + 1, lattice) * rows * lattice.stride;
    const AxisBasis& basis = octave.basis[2];
    const auto weight_0 = hn::Set(kFloats, basis.weight_0[at]);
    const auto weight_1 = hn::Set(kFloats, basis.weight_1[at]);
    const auto distance_0 = hn::Set(kFloats, basis.distance_0[at]);
    const auto distance_1 = hn::Set(kFloats, basis.distance_1[at]);
    const auto blend = [](const float* from, const float* to, FloatVector a,
                          FloatVector b) HWY_ATTR {
        return hn::Add(hn::Mul(hn::LoadU(kFloats, from), a), hn::Mul(hn::LoadU(kFloats, to), b));
    };
    const auto points = static_cast<std::size_t>(lattice.count[0]);
    for (std::size_t j = begin; j < end; ++j) {
        for (std::size_t i = 0; i < points; i += hn::Lanes(kFloats)) {
            const std::size_t p = j * lattice.stride + i;
            hn::StoreU(blend(lattice.z.data() + near + p, lattice.z.data() + far + p, distance_0,
                             distance_1),
                       kFloats, lattice.blended_distance.data() + p);
            hn::StoreU(
                blend(lattice.x.data() + near + p, lattice.x.data() + far + p, weight_0, weight_1),
                kFloats, lattice.blended_x.data() + p);
            hn::StoreU(
                blend(lattice.y.data() + near + p, lattice.y.data() + far + p, weight_0, weight_1),
                kFloats, lattice.blended_y.data() + p);
        }
    }
}

// Blends the two lattice rows about a row of voxels.
HWY_INLINE void blend_row(const GradientOctave& octave, int voxel_row, GradientLattice& lattice,
                          float* HWY_RESTRICT value, float* HWY_RESTRICT slope) {
    const auto at = static_cast<std::size_t>(voxel_row);
    const std::size_t near =
        static_cast<std::size_t>(octave.cells[1].cell[at] - lattice.first[1]) * lattice.stride;
    const std::size_t far = near + lattice.stride;
    const AxisBasis& basis = octave.basis[1];
    const auto weight_0 = hn::Set(kFloats, basis.weight_0[at]);
    const auto weight_1 = hn::Set(kFloats, basis.weight_1[at]);
    const auto distance_0 = hn::Set(kFloats, basis.distance_0[at]);
    const auto distance_1 = hn::Set(kFloats, basis.distance_1[at]);
    const float* HWY_RESTRICT distance = lattice.blended_distance.data();
    const float* HWY_RESTRICT x = lattice.blended_x.data();
    const float* HWY_RESTRICT y = lattice.blended_y.data();
    const auto points = static_cast<std::size_t>(lattice.count[0]);
    for (std::size_t i = 0; i < points; i += hn::Lanes(kFloats)) {
        const auto first = hn::Add(hn::Mul(hn::LoadU(kFloats, distance + near + i), weight_0),
                                   hn::Mul(hn::LoadU(kFloats, y + near + i), distance_0));
        const auto second = hn::Add(hn::Mul(hn::LoadU(kFloats, distance + far + i), weight_1),
                                    hn::Mul(hn::LoadU(kFloats, y + far + i), distance_1));
        hn::StoreU(hn::Add(first, second), kFloats, value + i);
        hn::StoreU(hn::Add(hn::Mul(hn::LoadU(kFloats, x + near + i), weight_0),
                           hn::Mul(hn::LoadU(kFloats, x + far + i), weight_1)),
                   kFloats, slope + i);
    }
}

template <OctaveShape kShape>
HWY_INLINE FloatVector shaped(FloatVector octave, FloatVector weight) {
    if constexpr (kShape == OctaveShape::plain) return octave;
    if constexpr (kShape == OctaveShape::absolute) return hn::Mul(hn::Abs(octave), weight);
    return hn::Mul(hn::Sub(hn::Set(kFloats, 1.0f), hn::Abs(octave)), weight);
}

// Some rows of an octave on their way to the sums.
struct Rows {
    const float* value;  // blends along z and y, a row every lattice.stride
    const float* slope;
    float* out;
    std::size_t stride;
    float scale;  // of the finished sum
    float offset;
};

// Adds an octave to kRows rows of `size` voxels, or sets them.
template <OctaveShape kShape, int kRows, bool kSet, bool kFinish>
HWY_INLINE void add_rows(const GradientOctave& octave, int first_voxel, int size, float weight_,
                         const GradientLattice& lattice, const Rows& rows) {
    const Integers integers;
    constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
    const AxisBasis& basis = octave.basis[0];
    const auto from = static_cast<std::size_t>(first_voxel);
    const float* HWY_RESTRICT weight_0 = basis.weight_0.data() + from;
    const float* HWY_RESTRICT weight_1 = basis.weight_1.data() + from;
    const float* HWY_RESTRICT distance_0 = basis.distance_0.data() + from;
    const float* HWY_RESTRICT distance_1 = basis.distance_1.data() + from;
    const std::int32_t* HWY_RESTRICT cells = octave.cells[0].cell.data() + from;
    const auto first_cell = static_cast<std::int32_t>(lattice.first[0]);
    const std::size_t stride = lattice.stride;
    const auto weight = hn::Set(kFloats, weight_);
    const auto scale = hn::Set(kFloats, rows.scale);
    const auto offset = hn::Set(kFloats, rows.offset);
    for (std::size_t i = 0; i < static_cast<std::size_t>(size); i += kLanes) {
        const auto w0 = hn::LoadU(kFloats, weight_0 + i);
        const auto w1 = hn::LoadU(kFloats, weight_1 + i);
        const auto d0 = hn::LoadU(kFloats, distance_0 + i);
        const auto d1 = hn::LoadU(kFloats, distance_1 + i);
        const auto base = static_cast<std::size_t>(cells[i] - first_cell);
        const auto store = [&](std::size_t row, FloatVector v0, FloatVector v1, FloatVector s0,
                               FloatVector s1) HWY_ATTR {
            const auto octave_value = hn::Add(hn::Add(hn::Mul(v0, w0), hn::Mul(v1, w1)),
                                              hn::Add(hn::Mul(s0, d0), hn::Mul(s1, d1)));
            float* target = rows.out + row * rows.stride + i;
            const auto before = kSet ? hn::Zero(kFloats) : hn::LoadU(kFloats, target);
            auto sum = hn::Add(before, shaped<kShape>(octave_value, weight));
            if (kFinish) sum = hn::Add(hn::Mul(sum, scale), offset);
            hn::StoreU(sum, kFloats, target);
        };
        if (cells[i] == cells[i + kLanes - 1]) {  // the whole vector in one cell
            for (std::size_t row = 0; row < kRows; ++row) {
                const float* values = rows.value + row * stride + base;
                const float* slopes = rows.slope + row * stride + base;
                store(row, hn::Set(kFloats, values[0]), hn::Set(kFloats, values[1]),
                      hn::Set(kFloats, slopes[0]), hn::Set(kFloats, slopes[1]));
            }
            continue;
        }
        const auto lanes = hn::IndicesFromVec(
            kFloats, hn::Sub(hn::LoadU(integers, cells + i), hn::Set(integers, cells[i])));
        const auto look_up = [&](const float* table) HWY_ATTR {
            return hn::TableLookupLanes(hn::LoadU(kFloats, table), lanes);
        };
        for (std::size_t row = 0; row < kRows; ++row) {
            const float* values = rows.value + row * stride + base;
            const float* slopes = rows.slope + row * stride + base;
            store(row, look_up(values), look_up(values + 1), look_up(slopes), look_up(slopes + 1));
        }
    }
}

template <OctaveShape kShape, int kRows>
void add_octave(const GradientOctave& octave, const VoxelBox& chunk, float weight, bool set,
                bool finish, const GradientLattice& lattice, const Rows& rows) {
    const auto add =
        set ? (finish ? add_rows<kShape, kRows, true, true> : add_rows<kShape, kRows, true, false>)
            : (finish ? add_rows<kShape, kRows, false, true>
                      : add_rows<kShape, kRows, false, false>);
    add(octave, chunk.origin[0], chunk.size[0], weight, lattice, rows);
}

template <OctaveShape kShape>
void fill_rows(const GradientStack& stack, const VoxelBox& chunk, int slice,
               std::vector<GradientLattice>& lattices, const SumTarget& target) {
    for (int y = 0; y < chunk.size[1]; y += kRowsAtOnce) {
        const int count = std::min(kRowsAtOnce, chunk.size[1] - y);
        float* out = target.out + (static_cast<std::size_t>(slice) * target.slice_stride +
                                   static_cast<std::size_t>(y) * target.row_stride);
        for (std::size_t i = 0; i < lattices.size(); ++i) {
            const GradientOctave& octave = stack.octaves[i];
            GradientLattice& lattice = lattices[i];
            Rows rows{lattice.row_value.data(),
                      lattice.row_slope.data(),
                      out,
                      target.row_stride,
                      target.scale,
                      target.offset};
            for (int row = 0; row < count; ++row) {
                const std::size_t at = static_cast<std::size_t>(row) * lattice.stride;
                blend_row(octave, chunk.origin[1] + y + row, lattice, lattice.row_value.data() + at,
                          lattice.row_slope.data() + at);
            }
            const float weight = stack.weights.empty() ? 1 : stack.weights[i];
            const bool finish = i + 1 == lattices.size() && target.finishes();
            if (count == kRowsAtOnce) {
                add_octave<kShape, kRowsAtOnce>(octave, chunk, weight, i == 0, finish, lattice,
                                                rows);
                continue;
            }
            for (int row = 0; row < count; ++row) {
                add_octave<kShape, 1>(octave, chunk, weight, i == 0, finish, lattice, rows);
                rows.value += lattice.stride;
                rows.slope += lattice.stride;
                rows.out += target.row_stride;
            }
        }
    }
}

void fill(const GradientStack& stack, const VoxelBox& chunk, std::vector<GradientLattice>& lattices,
          const SumTarget& target) {
    const auto first_row = static_cast<std::size_t>(chunk.origin[1]);
    const auto last_row = first_row + static_cast<std::size_t>(chunk.size[1]) - 1;
    for (int slice = 0; slice < chunk.size[2]; ++slice) {
        for (std::size_t i = 0; i < lattices.size(); ++i) {
            const auto& cell = stack.octaves[i].cells[1].cell;
            const std::int64_t origin = lattices[i].first[1];
            blend_slice(stack.octaves[i], chunk.origin[2] + slice,
                        static_cast<std::size_t>(cell[first_row] - origin),
                        static_cast<std::size_t>(cell[last_row] - origin) + 2, lattices[i]);
        }
        switch (stack.shape) {
            case OctaveShape::plain:
                fill_rows<OctaveShape::plain>(stack, chunk, slice, lattices, target);
                break;
            case OctaveShape::absolute:
                fill_rows<OctaveShape::absolute>(stack, chunk, slice, lattices, target);
                break;
            case OctaveShape::one_minus_absolute:
                fill_rows<OctaveShape::one_minus_absolute>(stack, chunk, slice, lattices, target);
                break;
        }
    }
}

}  // namespace

void fill_stack(const GradientStack& stack, const VoxelBox& chunk,
                std::vector<GradientLattice>& lattices, const SumTarget& target) {
    fill(stack, chunk, lattices, target);
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::noise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(fill_stack);

namespace {

GradientLattice make_lattice(const GradientOctave& octave, const VoxelBox& box, int chunk_depth) {
    GradientLattice lattice;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& cell = octave.cells[axis].cell;
        const auto begin = static_cast<std::size_t>(box.origin[axis]);
        const int length = axis == 2 ? std::min(chunk_depth, box.size[2]) : box.size[axis];
        lattice.first[axis] = cell[begin];
        // Planes along z are a ring: wherever a chunk begins, it meets at most one cell more.
        const auto last = begin + static_cast<std::size_t>(length) - 1;
        lattice.count[axis] = static_cast<int>(cell[last] - cell[begin]) + (axis == 2 ? 3 : 2);
    }
    const auto points = static_cast<std::size_t>(lattice.count[0]);
    constexpr std::size_t kPadding = kLanePadding;
    // A vector may start at any point and its neighbour.
    lattice.stride = (points + kPadding + 1 + kPadding - 1) / kPadding * kPadding;
    lattice.scaled_x.resize(points + kPadding);
    for (std::size_t i = 0; i < lattice.scaled_x.size(); ++i) {
        lattice.scaled_x[i] =
            wrapped_cell(lattice.first[0] + static_cast<std::int64_t>(i), octave.frequency[0]) *
            kGolden32;
    }
    const auto rows = static_cast<std::size_t>(lattice.count[1]);
    const auto planes = static_cast<std::size_t>(lattice.count[2]);
    for (AlignedFloats* values : {&lattice.x, &lattice.y, &lattice.z}) {
        values->resize(planes * rows * lattice.stride);
    }
    lattice.plane_of_slot.assign(planes, -1);
    for (AlignedFloats* values :
         {&lattice.blended_distance, &lattice.blended_x, &lattice.blended_y}) {
        values->resize(rows * lattice.stride);
    }
    lattice.row_value.resize(kRowsAtOnce * lattice.stride);
    lattice.row_slope.resize(kRowsAtOnce * lattice.stride);
    return lattice;
}

}  // namespace

GradientScratch::GradientScratch(const GradientStack& stack, const VoxelBox& box, int chunk_depth) {
    for (const GradientOctave& octave : stack.octaves) {
        lattices_.push_back(make_lattice(octave, box, chunk_depth));
    }
}

bool is_separable(const GradientOctave& octave, const std::array<TileAxis, 3>& axes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (octave.frequency[axis] > axes[axis].size && axes[axis].size > 1) return false;
    }
    return true;
}

void fill_gradient_stack(const GradientStack& stack, const VoxelBox& chunk,
                         GradientScratch& scratch, const SumTarget& target) {
    HWY_DYNAMIC_DISPATCH(fill_stack)(stack, chunk, scratch.lattices(), target);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
