#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/gradient_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <type_traits>

#include "bakers/noise/gradient_kernel.h"
#include "bakers/noise/lattice_planes-inl.h"
#include "bakers/noise/moving_gradient-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise {
namespace HWY_NAMESPACE {
namespace {

// The gradients at lattice points.
class StillGradients {
  public:
    explicit StillGradients(const GradientOctave& octave) : key_(octave.key) {}
    RowKey keys(std::uint32_t y, std::uint32_t z) const { return row_key(key_, y, z); }
    HWY_INLINE void store(RowKey key, WordVector scaled_x, LatticePlanes& planes,
                          std::size_t at) const {
        const GradientVector gradient = lattice_gradient(in_all_lanes(key), scaled_x);
        hn::StoreU(gradient.x, kFloats, planes.x.data() + at);
        hn::StoreU(gradient.y, kFloats, planes.y.data() + at);
        hn::StoreU(gradient.z, kFloats, planes.z.data() + at);
    }

  private:
    std::uint64_t key_;
};

// At a frame the noise of four dimensions is one of three dimensions, whose lattice points have a
// blend of the gradients before and after the frame, and a value, `rest`, beside it.
class MovingGradients {
  public:
    explicit MovingGradients(const GradientOctave& octave) : time_(*octave.time) {}
    TimeKeys keys(std::uint32_t y, std::uint32_t z) const { return time_keys(time_, y, z); }
    HWY_INLINE void store(const TimeKeys& keys, WordVector scaled_x, LatticePlanes& planes,
                          std::size_t at) const {
        const MovingGradientVector gradient =
            gradient_at(time_.basis, in_all_lanes(keys[0]), in_all_lanes(keys[1]), scaled_x);
        hn::StoreU(gradient.x, kFloats, planes.x.data() + at);
        hn::StoreU(gradient.y, kFloats, planes.y.data() + at);
        hn::StoreU(gradient.z, kFloats, planes.z.data() + at);
        hn::StoreU(gradient.rest, kFloats, planes.rest.data() + at);
    }

  private:
    const TimeStep& time_;
};

// Blends the two planes about a slice, for lattice rows begin ... end - 1.
template <class Gradients>
void blend_slice(const GradientOctave& octave, int slice, std::size_t begin, std::size_t end,
                 GradientLattice& lattice) {
    constexpr bool kMoves = std::is_same_v<Gradients, MovingGradients>;
    const auto at = static_cast<std::size_t>(slice);
    const std::int64_t plane = octave.cells[2].cell[at];
    LatticePlanes& planes = lattice.planes;
    const Gradients gradients(octave);
    const std::size_t near = planes.row(slot_of_plane(plane, planes, gradients), 0);
    const std::size_t far = planes.row(slot_of_plane(plane + 1, planes, gradients), 0);
    const AxisBasis& basis = octave.basis[2];
    const auto weight_0 = hn::Set(kFloats, basis.weight_0[at]);
    const auto weight_1 = hn::Set(kFloats, basis.weight_1[at]);
    const auto distance_0 = hn::Set(kFloats, basis.distance_0[at]);
    const auto distance_1 = hn::Set(kFloats, basis.distance_1[at]);
    const auto blend = [&](const AlignedFloats& values, std::size_t p, FloatVector a,
                           FloatVector b) HWY_ATTR {
        return hn::Add(hn::Mul(hn::LoadU(kFloats, values.data() + near + p), a),
                       hn::Mul(hn::LoadU(kFloats, values.data() + far + p), b));
    };
    const auto points = static_cast<std::size_t>(lattice.planes.count[0]);
    for (std::size_t j = begin; j < end; ++j) {
        for (std::size_t i = 0; i < points; i += hn::Lanes(kFloats)) {
            const std::size_t p = j * lattice.planes.stride + i;
            auto distance = blend(planes.z, p, distance_0, distance_1);
            if constexpr (kMoves) {
                distance = hn::Add(distance, blend(planes.rest, p, weight_0, weight_1));
            }
            hn::StoreU(distance, kFloats, lattice.blended_distance.data() + p);
            hn::StoreU(blend(planes.x, p, weight_0, weight_1), kFloats,
                       lattice.blended_x.data() + p);
            hn::StoreU(blend(planes.y, p, weight_0, weight_1), kFloats,
                       lattice.blended_y.data() + p);
        }
    }
}

// Blends the two lattice rows about a row of voxels.
HWY_INLINE void blend_row(const GradientOctave& octave, int voxel_row, GradientLattice& lattice,
                          float* HWY_RESTRICT value, float* HWY_RESTRICT slope) {
    const auto at = static_cast<std::size_t>(voxel_row);
    const std::size_t near =
        static_cast<std::size_t>(octave.cells[1].cell[at] - lattice.planes.first[1]) *
        lattice.planes.stride;
    const std::size_t far = near + lattice.planes.stride;
    const AxisBasis& basis = octave.basis[1];
    const auto weight_0 = hn::Set(kFloats, basis.weight_0[at]);
    const auto weight_1 = hn::Set(kFloats, basis.weight_1[at]);
    const auto distance_0 = hn::Set(kFloats, basis.distance_0[at]);
    const auto distance_1 = hn::Set(kFloats, basis.distance_1[at]);
    const float* HWY_RESTRICT distance = lattice.blended_distance.data();
    const float* HWY_RESTRICT x = lattice.blended_x.data();
    const float* HWY_RESTRICT y = lattice.blended_y.data();
    const auto points = static_cast<std::size_t>(lattice.planes.count[0]);
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
    const float* value;  // blends along z and y, a row every lattice.planes.stride
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
    const auto first_cell = static_cast<std::int32_t>(lattice.planes.first[0]);
    const std::size_t stride = lattice.planes.stride;
    const auto weight = hn::Set(kFloats, weight_);
    const auto scale = hn::Set(kFloats, rows.scale);
    const auto offset = hn::Set(kFloats, rows.offset);
    // For all that compilers know, a store of a vector changes any float or pointer, and what the
    // loop reads through a reference is read again after it.
    const float* HWY_RESTRICT row_values = rows.value;
    const float* HWY_RESTRICT row_slopes = rows.slope;
    float* HWY_RESTRICT out = rows.out;
    const std::size_t out_stride = rows.stride;
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
            float* target = out + row * out_stride + i;
            const auto before = kSet ? hn::Zero(kFloats) : hn::LoadU(kFloats, target);
            auto sum = hn::Add(before, shaped<kShape>(octave_value, weight));
            if (kFinish) sum = hn::Add(hn::Mul(sum, scale), offset);
            hn::StoreU(sum, kFloats, target);
        };
        if (cells[i] == cells[i + kLanes - 1]) {  // the whole vector in one cell
            for (std::size_t row = 0; row < kRows; ++row) {
                const float* values = row_values + row * stride + base;
                const float* slopes = row_slopes + row * stride + base;
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
            const float* values = row_values + row * stride + base;
            const float* slopes = row_slopes + row * stride + base;
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
                const std::size_t at = static_cast<std::size_t>(row) * lattice.planes.stride;
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
                rows.value += lattice.planes.stride;
                rows.slope += lattice.planes.stride;
                rows.out += target.row_stride;
            }
        }
    }
}

}  // namespace

void fill_stack(const GradientStack& stack, const VoxelBox& chunk,
                std::vector<GradientLattice>& lattices, const SumTarget& target) {
    const auto first_row = static_cast<std::size_t>(chunk.origin[1]);
    const auto last_row = first_row + static_cast<std::size_t>(chunk.size[1]) - 1;
    for (int slice = 0; slice < chunk.size[2]; ++slice) {
        for (std::size_t i = 0; i < lattices.size(); ++i) {
            const auto& cell = stack.octaves[i].cells[1].cell;
            const std::int64_t origin = lattices[i].planes.first[1];
            const auto blend =
                stack.octaves[i].time ? blend_slice<MovingGradients> : blend_slice<StillGradients>;
            blend(stack.octaves[i], chunk.origin[2] + slice,
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

}  // namespace HWY_NAMESPACE
}  // namespace skybake::noise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(fill_stack);

std::vector<GradientLattice> make_gradient_lattices(const GradientStack& stack, std::size_t octaves,
                                                    const VoxelBox& box, int chunk_depth) {
    std::vector<GradientLattice> lattices(octaves);
    for (std::size_t i = 0; i < lattices.size(); ++i) {
        const GradientOctave& octave = stack.octaves[i];
        GradientLattice& lattice = lattices[i];
        lattice.planes =
            make_lattice_planes(octave.frequency, octave.key, octave.cells, box, chunk_depth, 0, 1);
        if (octave.time) lattice.planes.rest.resize(lattice.planes.x.size());
        for (AlignedFloats* values :
             {&lattice.blended_distance, &lattice.blended_x, &lattice.blended_y}) {
            values->resize(lattice.planes.row(1, 0));
        }
        lattice.row_value.resize(kRowsAtOnce * lattice.planes.stride);
        lattice.row_slope.resize(kRowsAtOnce * lattice.planes.stride);
    }
    return lattices;
}

void fill_gradient_stack(const GradientStack& stack, const VoxelBox& chunk,
                         std::vector<GradientLattice>& lattices, const SumTarget& target) {
    assert(lattices.size() <= stack.octaves.size());
    HWY_DYNAMIC_DISPATCH(fill_stack)(stack, chunk, lattices, target);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
