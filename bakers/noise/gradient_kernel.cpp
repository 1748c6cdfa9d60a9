#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/gradient_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <type_traits>

#include "bakers/noise/gradient_blend-inl.h"
#include "bakers/noise/gradient_kernel.h"
#include "bakers/noise/lattice_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {
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
    // The keys of a lattice row before and after the frame.
    std::array<RowKey, 2> keys(std::uint32_t y, std::uint32_t z) const {
        return {row_key(time_.keys[0], y, z), row_key(time_.keys[1], y, z)};
    }
    HWY_INLINE void store(const std::array<RowKey, 2>& keys, WordVector scaled_x,
                          LatticePlanes& planes, std::size_t at) const {
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
    const Basis z = basis_at(octave.basis[2], at);
    const auto blended = [&](const AlignedFloats& values, std::size_t p, FloatVector a,
                             FloatVector b) HWY_ATTR {
        return blend(hn::LoadU(kFloats, values.data() + near + p), a,
                     hn::LoadU(kFloats, values.data() + far + p), b);
    };
    const auto points = static_cast<std::size_t>(planes.count[0]);
    for (std::size_t j = begin; j < end; ++j) {
        for (std::size_t i = 0; i < points; i += hn::Lanes(kFloats)) {
            const std::size_t p = j * planes.stride + i;
            auto distance = blended(planes.z, p, z.distance_0, z.distance_1);
            if constexpr (kMoves) {
                distance = hn::Add(distance, blended(planes.rest, p, z.weight_0, z.weight_1));
            }
            hn::StoreU(distance, kFloats, lattice.blended_distance.data() + p);
            hn::StoreU(blended(planes.x, p, z.weight_0, z.weight_1), kFloats,
                       lattice.blended_x.data() + p);
            hn::StoreU(blended(planes.y, p, z.weight_0, z.weight_1), kFloats,
                       lattice.blended_y.data() + p);
        }
    }
}

// Blends the two lattice rows about a row of voxels, for `points` points along x from `first` on.
HWY_INLINE void blend_row(const GradientOctave& octave, int voxel_row, std::size_t first,
                          std::size_t points, const GradientLattice& lattice,
                          float* HWY_RESTRICT value) {
    const auto at = static_cast<std::size_t>(voxel_row);
    const std::size_t near =
        static_cast<std::size_t>(octave.cells[1].cell[at] - lattice.planes.first[1]) *
            lattice.planes.stride +
        first;
    const std::size_t far = near + lattice.planes.stride;
    const Basis y = basis_at(octave.basis[1], at);
    const float* HWY_RESTRICT distances = lattice.blended_distance.data();
    const float* HWY_RESTRICT xs = lattice.blended_x.data();
    const float* HWY_RESTRICT ys = lattice.blended_y.data();
    for (std::size_t i = 0; i < points; i += hn::Lanes(kFloats)) {
        const auto from = [&](const float* row) HWY_ATTR { return hn::LoadU(kFloats, row + i); };
        const auto sum =
            hn::Add(blend(from(distances + near), y.weight_0, from(ys + near), y.distance_0),
                    blend(from(distances + far), y.weight_1, from(ys + far), y.distance_1));
        hn::StoreU(sum, kFloats, value + i);
        hn::StoreU(blend(from(xs + near), y.weight_0, from(xs + far), y.weight_1), kFloats,
                   value + kSlopes + i);
    }
}

template <OctaveShape kShape>
HWY_INLINE FloatVector shaped(FloatVector octave, FloatVector weight) {
    if constexpr (kShape == OctaveShape::plain) return octave;
    if constexpr (kShape == OctaveShape::absolute) return hn::Mul(hn::Abs(octave), weight);
    return hn::Mul(hn::Sub(hn::Set(kFloats, 1.0f), hn::Abs(octave)), weight);
}

// Holds what sums of a piece of rows take from an octave.
struct OctavePiece {
    const GradientOctave* octave;
    GradientLattice* lattice;
    std::size_t voxel;          // the first
    const AxisBasis* basis;     // along x
    const std::int32_t* cells;  // of voxels from the first on
    float* blends;              // of the first row, from the first voxel's cell on
    float weight;
};

struct Piece {
    int x;  // in the chunk
    std::size_t size;
    std::vector<OctavePiece> octaves;
};

std::vector<Piece> pieces_of(const GradientStack& stack, const VoxelBox& chunk,
                             std::vector<GradientLattice>& lattices) {
    std::vector<Piece> pieces;
    for (int x = 0; x < chunk.size[0]; x += kVoxelsAtOnce) {
        const auto from = static_cast<std::size_t>(chunk.origin[0] + x);
        const int size = std::min(kVoxelsAtOnce, chunk.size[0] - x);
        pieces.push_back({x, static_cast<std::size_t>(size), {}});
        for (std::size_t i = 0; i < lattices.size(); ++i) {
            const GradientOctave& octave = stack.octaves[i];
            pieces.back().octaves.push_back(
                {&octave, &lattices[i], from, &octave.basis[0], octave.cells[0].cell.data() + from,
                 lattices[i].rows.data(), stack.weights.empty() ? 1 : stack.weights[i]});
        }
    }
    return pieces;
}

// Blends lattice rows for `count` rows of a piece from voxel row `first_row` on.
void blend_rows(const OctavePiece& piece, std::size_t size, int first_row, int count) {
    const std::int32_t cell = piece.cells[0];
    const auto first = static_cast<std::size_t>(cell - piece.lattice->planes.first[0]);
    const auto points = static_cast<std::size_t>(piece.cells[size - 1] - cell + 2);
    float* blends = piece.blends;
    for (int row = 0; row < count; ++row, blends += kBlendStride) {
        blend_row(*piece.octave, first_row + row, first, points, *piece.lattice, blends);
    }
}

// Adds an octave to the voxels from number i on of kRows rows.
template <OctaveShape kShape, std::size_t kRows>
HWY_INLINE void add_octave(const OctavePiece& octave, std::size_t first_row, std::size_t i,
                           FloatVector (&sums)[kRows]) {
    constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
    const Basis x = bases_from(*octave.basis, octave.voxel + i);
    const auto weight = hn::Set(kFloats, octave.weight);
    const std::int32_t cell = octave.cells[i];
    const float* blends = octave.blends + first_row * kBlendStride + (cell - octave.cells[0]);
    const auto add = [&](std::size_t row, FloatVector v0, FloatVector v1, FloatVector s0,
                         FloatVector s1) HWY_ATTR {
        const auto value = hn::Add(blend(v0, x.weight_0, v1, x.weight_1),
                                   blend(s0, x.distance_0, s1, x.distance_1));
        sums[row] = hn::Add(sums[row], shaped<kShape>(value, weight));
    };
    if (cell == octave.cells[i + kLanes - 1]) {  // the whole vector in one cell
        for (std::size_t row = 0; row < kRows; ++row) {
            const float* v = blends + row * kBlendStride;
            const float* s = v + kSlopes;
            add(row, hn::Set(kFloats, v[0]), hn::Set(kFloats, v[1]), hn::Set(kFloats, s[0]),
                hn::Set(kFloats, s[1]));
        }
        return;
    }
    const auto lanes = hn::IndicesFromVec(
        kFloats, hn::Sub(hn::LoadU(Integers(), octave.cells + i), hn::Set(Integers(), cell)));
    const auto look_up = [&](const float* table) HWY_ATTR {
        return hn::TableLookupLanes(hn::LoadU(kFloats, table), lanes);
    };
    for (std::size_t row = 0; row < kRows; ++row) {
        const float* v = blends + row * kBlendStride;
        const float* s = v + kSlopes;
        add(row, look_up(v), look_up(v + 1), look_up(s), look_up(s + 1));
    }
}

// Writes kRows rows of a piece. The sums stay in registers from octave to octave, so that stores are far
// enough apart to wait for no memory. Inlined, the loop would lack registers.
template <OctaveShape kShape, std::size_t kRows>
HWY_NOINLINE void write_rows(const Piece& piece, std::size_t first_row, const SumTarget& target,
                             float* out) {
    const auto scale = hn::Set(kFloats, target.scale);
    const auto offset = hn::Set(kFloats, target.offset);
    // For all that compilers know, a store of a vector changes any number, and what the loop reads
    // through a reference is read again after it.
    const std::size_t stride = target.row_stride;
    const OctavePiece* const begin = piece.octaves.data();
    const OctavePiece* const end = begin + piece.octaves.size();
    for (std::size_t i = 0; i < piece.size; i += hn::MaxLanes(kFloats)) {
        FloatVector sums[kRows];
        for (auto& sum : sums) sum = hn::Zero(kFloats);
        for (const OctavePiece* octave = begin; octave < end; ++octave) {
            add_octave<kShape>(*octave, first_row, i, sums);
        }
        for (std::size_t row = 0; row < kRows; ++row) {
            hn::StoreU(hn::Add(hn::Mul(sums[row], scale), offset), kFloats, out + row * stride + i);
        }
    }
}

// Writes all rows of a piece in one slice.
template <OctaveShape kShape>
void fill_rows(const Piece& piece, const VoxelBox& chunk, const SumTarget& target, float* out) {
    for (int y = 0; y < chunk.size[1]; y += kRowsAtOnce) {
        const int count = std::min(kRowsAtOnce, chunk.size[1] - y);
        for (const OctavePiece& octave : piece.octaves) {
            blend_rows(octave, piece.size, chunk.origin[1] + y, count);
        }
        const bool whole = count == kRowsAtOnce;
        const auto write = whole ? write_rows<kShape, kRowsAtOnce> : write_rows<kShape, 1>;
        for (int row = 0; row < count; row += whole ? kRowsAtOnce : 1) {
            const std::size_t at = static_cast<std::size_t>(y + row) * target.row_stride;
            write(piece, static_cast<std::size_t>(row), target, out + at);
        }
    }
}

}  // namespace

void fill_stack(const GradientStack& stack, const VoxelBox& chunk,
                std::vector<GradientLattice>& lattices, const SumTarget& target) {
    const auto first_row = static_cast<std::size_t>(chunk.origin[1]);
    const auto last_row = first_row + static_cast<std::size_t>(chunk.size[1]) - 1;
    const std::vector<Piece> pieces = pieces_of(stack, chunk, lattices);
    const auto fill = stack.shape == OctaveShape::plain ? fill_rows<OctaveShape::plain>
                      : stack.shape == OctaveShape::absolute
                          ? fill_rows<OctaveShape::absolute>
                          : fill_rows<OctaveShape::one_minus_absolute>;
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
        float* out = target.out + static_cast<std::size_t>(slice) * target.slice_stride;
        for (const Piece& piece : pieces) fill(piece, chunk, target, out + piece.x);
    }
}

}  // namespace skybake::noise::HWY_NAMESPACE
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
        lattice.rows.resize(kRowsAtOnce * kBlendStride);
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
