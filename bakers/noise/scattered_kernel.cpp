#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/scattered_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>

#include "bakers/noise/cell_tile-inl.h"
#include "bakers/noise/gradient_blend-inl.h"
#include "bakers/noise/scattered_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {
namespace {

constexpr Integers kIntegers;
using Frequency = std::array<int, 3>;

// --- Samples ------------------------------------------------------------------------------------

// A vector's samples along one axis: their cells, in [0, 2 frequency), and their places in them.
struct AxisSamples {
    IntegerVector cell;
    FloatVector fraction;
};

HWY_INLINE AxisSamples displaced_by(const AxisSamples& samples, FloatVector displacement,
                                    int frequency) {
    const auto within = hn::Sub(displacement, hn::Round(displacement));
    const auto place =
        hn::Add(samples.fraction, hn::Mul(within, hn::Set(kFloats, static_cast<float>(frequency))));
    const auto cells = hn::Floor(place);
    const auto period = hn::Set(kIntegers, frequency);
    // Displaced by at most half a tile, a sample of the tile or of that after it is in one of four.
    auto cell = hn::Add(samples.cell, hn::ConvertTo(kIntegers, cells));
    cell = hn::IfThenElse(hn::Lt(cell, hn::Zero(kIntegers)), hn::Add(cell, period), cell);
    for (int tile = 0; tile < 2; ++tile) {
        cell = hn::IfThenElse(hn::Lt(cell, period), cell, hn::Sub(cell, period));
    }
    return {cell, hn::Sub(place, cells)};
}

struct Samples {
    AxisSamples x, y, z;
};

// A vector of voxels from `voxel` of a row on, whose displacements begin at `at`.
HWY_INLINE Samples samples_at(const std::array<AxisCells, 3>& cells, const Frequency& frequency,
                              std::size_t voxel, std::size_t row, std::size_t slice,
                              const DisplacedRows& displaced, std::size_t at) {
    const auto same = [](const AxisCells& axis, std::size_t i) HWY_ATTR {
        return AxisSamples{hn::Set(kIntegers, axis.cell[i]), hn::Set(kFloats, axis.fraction[i])};
    };
    Samples samples{{hn::LoadU(kIntegers, cells[0].cell.data() + voxel),
                     hn::LoadU(kFloats, cells[0].fraction.data() + voxel)},
                    same(cells[1], row),
                    same(cells[2], slice)};
    if (displaced[0] == nullptr) return samples;
    const auto displacement = [&](std::size_t axis)
                                  HWY_ATTR { return hn::LoadU(kFloats, displaced[axis] + at); };
    return {displaced_by(samples.x, displacement(0), frequency[0]),
            displaced_by(samples.y, displacement(1), frequency[1]),
            displaced_by(samples.z, displacement(2), frequency[2])};
}

// --- Lattice rows -------------------------------------------------------------------------------

std::uint32_t neighbour(std::int32_t cell, int offset, int period) {
    cell += offset;
    while (cell < 0) cell += period;
    while (cell >= period) cell -= period;
    return static_cast<std::uint32_t>(cell);
}

// Hashes the lattice rows of a vector's samples. Neighbours are often in one row, which is hashed
// once.
class LaneRows {
  public:
    HWY_INLINE LaneRows(const Samples& samples, const Frequency& frequency)
        : frequency_(frequency) {
        hn::StoreU(samples.y.cell, kIntegers, y_);
        hn::StoreU(samples.z.cell, kIntegers, z_);
    }

    // The keys of the rows `dy` and `dz` beyond those of the samples.
    HWY_INLINE RowKeyVector keys(std::uint64_t octave_key, int dy, int dz) const {
        std::uint32_t low[kLanes];
        std::uint32_t high[kLanes];
        RowKey key;
        for (std::size_t i = 0; i < kLanes; ++i) {
            if (i == 0 || y_[i] != y_[i - 1] || z_[i] != z_[i - 1]) {
                key = row_key(octave_key, neighbour(y_[i], dy, frequency_[1]),
                              neighbour(z_[i], dz, frequency_[2]));
            }
            low[i] = key.low;
            high[i] = key.high;
        }
        return {hn::LoadU(Words(), low), hn::LoadU(Words(), high)};
    }

  private:
    const Frequency& frequency_;
    std::int32_t y_[kLanes];
    std::int32_t z_[kLanes];
};

// --- Gradient noise -----------------------------------------------------------------------------

HWY_INLINE Basis basis_at(FloatVector u) {
    const auto one = hn::Set(kFloats, 1.0f);
    const auto slope =
        hn::Add(hn::Mul(u, hn::Sub(hn::Mul(hn::Set(kFloats, 6.0f), u), hn::Set(kFloats, 15.0f))),
                hn::Set(kFloats, 10.0f));
    const auto weight_1 = hn::Mul(hn::Mul(hn::Mul(u, u), u), slope);
    const auto weight_0 = hn::Sub(one, weight_1);
    return {weight_0, weight_1, hn::Mul(u, weight_0), hn::Mul(hn::Sub(u, one), weight_1)};
}

HWY_INLINE Basis scaled(const Basis& basis, FloatVector factor) {
    return {hn::Mul(basis.weight_0, factor), hn::Mul(basis.weight_1, factor),
            hn::Mul(basis.distance_0, factor), hn::Mul(basis.distance_1, factor)};
}

template <class Row>
HWY_INLINE FloatVector gradient_value(const GradientOctave& octave, const Samples& samples) {
    const LaneRows lane_rows(samples, octave.frequency);
    const auto row = [&](int dy, int dz) HWY_ATTR {
        return Row::of(octave,
                       [&](std::uint64_t key) HWY_ATTR { return lane_rows.keys(key, dy, dz); });
    };
    const Row rows[2][2] = {{row(0, 0), row(0, 1)}, {row(1, 0), row(1, 1)}};
    const int period = octave.frequency[0];
    return blended_gradients(
        rows, scaled_neighbours(samples.x.cell, 0, period),
        scaled_neighbours(samples.x.cell, 1, period),
        {basis_at(samples.x.fraction),
         scaled(basis_at(samples.y.fraction), hn::Set(kFloats, octave.amplitude)),
         basis_at(samples.z.fraction)});
}

// --- Cellular noise -----------------------------------------------------------------------------

// Calls take(squared distance, height of the bump) for the points of the cells within kRings rings
// that are beyond `done` rings.
template <int kRings, class Take>
HWY_INLINE void for_points(const CellField& field, const Samples& samples, const LaneRows& rows,
                           int done, const Take& take) {
    WordVector scaled_x[2 * kRings + 1];
    for (int dx = -kRings; dx <= kRings; ++dx) {
        scaled_x[dx + kRings] = scaled_neighbours(samples.x.cell, dx, field.frequency[0]);
    }
    for (int dz = -kRings; dz <= kRings; ++dz) {
        for (int dy = -kRings; dy <= kRings; ++dy) {
            CellPointVector points[2 * kRings + 1];
            cell_points(rows.keys(field.key, dy, dz), scaled_x, field.shift, points);
            for (int dx = -kRings; dx <= kRings; ++dx) {
                if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) <= done) continue;
                const CellPointVector& point = points[dx + kRings];
                const auto along = [](const AxisSamples& axis, FloatVector at,
                                      int offset) HWY_ATTR {
                    return squared_along(axis.fraction, at,
                                         hn::Set(kFloats, -static_cast<float>(offset)));
                };
                take(hn::Add(hn::Add(along(samples.x, point.x, dx), along(samples.y, point.y, dy)),
                             along(samples.z, point.z, dz)),
                     point.height);
            }
        }
    }
}

template <bool kSecond>
HWY_INLINE FloatVector worley_value(const CellField& field, const Samples& samples,
                                    const LaneRows& rows) {
    CellTile<1, 1, kSecond> tile;
    const auto take = [&](FloatVector squared, FloatVector) HWY_ATTR { tile.take(0, 0, squared); };
    for_points<1>(field, samples, rows, -1, take);
    const auto to_face =
        hn::Min(hn::Min(distance_to_face(samples.x.fraction), distance_to_face(samples.y.fraction)),
                distance_to_face(samples.z.fraction));
    if (!is_within_rings(tile.farthest(), 1, to_face)) {
        for_points<2>(field, samples, rows, 1, take);
    }
    return tile.value(field, 0, 0);
}

// Bumps end within one ring of cells.
HWY_INLINE FloatVector alligator_value(const CellField& field, const Samples& samples,
                                       const LaneRows& rows) {
    GreatestBumpsVector<FloatVector> bumps{hn::Zero(kFloats), hn::Zero(kFloats)};
    for_points<1>(field, samples, rows, -1, [&](FloatVector squared, FloatVector height) HWY_ATTR {
        bumps.add(squared, height);
    });
    return bumps.value();
}

// --- Boxes --------------------------------------------------------------------------------------

// Sets every voxel of the chunk to value(samples).
template <class Value>
HWY_INLINE void for_each_vector(const std::array<AxisCells, 3>& cells, const Frequency& frequency,
                                const VoxelBox& chunk, std::size_t row_stride,
                                const DisplacedRows& displaced, float* out, const Value& value) {
    for (int z = 0; z < chunk.size[2]; ++z) {
        for (int y = 0; y < chunk.size[1]; ++y) {
            const std::size_t row = static_cast<std::size_t>(z * chunk.size[1] + y) * row_stride;
            for (std::size_t i = 0; i < static_cast<std::size_t>(chunk.size[0]); i += kLanes) {
                const Samples samples =
                    samples_at(cells, frequency, static_cast<std::size_t>(chunk.origin[0]) + i,
                               static_cast<std::size_t>(chunk.origin[1] + y),
                               static_cast<std::size_t>(chunk.origin[2] + z), displaced, row + i);
                hn::StoreU(value(samples), kFloats, out + row + i);
            }
        }
    }
}

}  // namespace

void gradient_scattered(const GradientOctave& octave, const VoxelBox& chunk, std::size_t row_stride,
                        const DisplacedRows& displaced, float* out) {
    const auto fill = [&](const auto& value) HWY_ATTR {
        for_each_vector(octave.cells, octave.frequency, chunk, row_stride, displaced, out, value);
    };
    if (octave.time) {
        fill([&](const Samples& s) HWY_ATTR { return gradient_value<MovingRow>(octave, s); });
    } else {
        fill([&](const Samples& s) HWY_ATTR { return gradient_value<StillRow>(octave, s); });
    }
}

void cells_scattered(const CellField& field, const VoxelBox& chunk, std::size_t row_stride,
                     const DisplacedRows& displaced, float* out) {
    const auto fill = [&](const auto& value) HWY_ATTR {
        for_each_vector(field.cells, field.frequency, chunk, row_stride, displaced, out,
                        [&](const Samples& samples) HWY_ATTR {
                            return value(field, samples, LaneRows(samples, field.frequency));
                        });
    };
    if (field.kind == CellKind::alligator) return fill(alligator_value);
    fill(field.feature == config::WorleyFeature::f1 ? worley_value<false> : worley_value<true>);
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(gradient_scattered);
HWY_EXPORT(cells_scattered);

void fill_scattered_gradient_octave(const GradientOctave& octave, const VoxelBox& chunk,
                                    std::size_t row_stride, const DisplacedRows& displaced,
                                    float* out) {
    assert(octave.derivative_axis < 0);
    HWY_DYNAMIC_DISPATCH(gradient_scattered)(octave, chunk, row_stride, displaced, out);
}

void fill_scattered_cell_field(const CellField& field, const VoxelBox& chunk,
                               std::size_t row_stride, const DisplacedRows& displaced, float* out) {
    HWY_DYNAMIC_DISPATCH(cells_scattered)(field, chunk, row_stride, displaced, out);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
