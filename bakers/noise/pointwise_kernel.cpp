#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/pointwise_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "bakers/noise/cell_value-inl.h"
#include "bakers/noise/gradient_blend-inl.h"
#include "bakers/noise/lattice_hash-inl.h"
#include "bakers/noise/pointwise_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise {
namespace HWY_NAMESPACE {
namespace {

// --- Gradient noise -----------------------------------------------------------------------------

HWY_INLINE Basis basis_at(const AxisBasis& axis, std::size_t voxel) {
    return {hn::Set(kFloats, axis.weight_0[voxel]), hn::Set(kFloats, axis.weight_1[voxel]),
            hn::Set(kFloats, axis.distance_0[voxel]), hn::Set(kFloats, axis.distance_1[voxel])};
}

HWY_INLINE Basis bases_from(const AxisBasis& axis, std::size_t voxel) {
    return {hn::LoadU(kFloats, axis.weight_0.data() + voxel),
            hn::LoadU(kFloats, axis.weight_1.data() + voxel),
            hn::LoadU(kFloats, axis.distance_0.data() + voxel),
            hn::LoadU(kFloats, axis.distance_1.data() + voxel)};
}

// Lattice rows whose gradients stand still, and ones whose gradients change in time.
struct StillRow {
    static StillRow of(const GradientOctave& octave, std::uint32_t y, std::uint32_t z) {
        return {row_key(octave.key, y, z)};
    }
    HWY_INLINE GradientVector gradient(WordVector scaled_x) const {
        return lattice_gradient(key, scaled_x);
    }
    RowKey key;
};

struct MovingRow {
    static MovingRow of(const GradientOctave& octave, std::uint32_t y, std::uint32_t z) {
        return {&octave.time->basis, time_keys(*octave.time, y, z)};
    }
    HWY_INLINE MovingGradientVector gradient(WordVector scaled_x) const {
        return gradient_at(*time, in_all_lanes(keys[0]), in_all_lanes(keys[1]), scaled_x);
    }
    const GradientBasis* time;
    TimeKeys keys;
};

template <class Row>
void gradient_row(const GradientOctave& octave, int first_voxel, int size, std::size_t row,
                  std::size_t slice, float* out) {
    Row rows[2][2];
    for (int dy = 0; dy < 2; ++dy) {
        for (int dz = 0; dz < 2; ++dz) {
            rows[dy][dz] =
                Row::of(octave, wrapped_cell(octave.cells[1].cell[row] + dy, octave.frequency[1]),
                        wrapped_cell(octave.cells[2].cell[slice] + dz, octave.frequency[2]));
        }
    }
    const Basis y = basis_at(octave.basis[1], row);
    const Basis z = basis_at(octave.basis[2], slice);
    const int period = octave.frequency[0];
    for (std::size_t i = 0; i < static_cast<std::size_t>(size); i += kLanes) {
        const std::size_t voxel = static_cast<std::size_t>(first_voxel) + i;
        const auto cell = hn::LoadU(Integers(), octave.cells[0].cell.data() + voxel);
        const auto value = blended_gradients(rows, scaled_neighbours(cell, 0, period),
                                             scaled_neighbours(cell, 1, period),
                                             {bases_from(octave.basis[0], voxel), y, z});
        hn::StoreU(value, kFloats, out + i);
    }
}

// --- Cellular noise -----------------------------------------------------------------------------

struct Nearest {
    FloatVector first, second;
};

// The keys of the lattice rows about a row of voxels, [dz + 2][dy + 2].
struct RowKeys {
    RowKey key[5][5];
};

RowKeys keys_about(const CellField& field, std::size_t row, std::size_t slice) {
    RowKeys keys;
    for (int dz = -2; dz <= 2; ++dz) {
        for (int dy = -2; dy <= 2; ++dy) {
            keys.key[dz + 2][dy + 2] =
                row_key(field.key, wrapped_cell(field.cells[1].cell[row] + dy, field.frequency[1]),
                        wrapped_cell(field.cells[2].cell[slice] + dz, field.frequency[2]));
        }
    }
    return keys;
}

// Adds the points of the cells within `rings` rings that are beyond `done` rings.
HWY_INLINE void look_at(const CellField& field, const RowKeys& keys, std::size_t voxel,
                        std::size_t row, std::size_t slice, int done, int rings, Nearest& nearest) {
    const auto x = hn::LoadU(kFloats, field.cells[0].fraction.data() + voxel);
    const auto y = hn::Set(kFloats, field.cells[1].fraction[row]);
    const auto z = hn::Set(kFloats, field.cells[2].fraction[slice]);
    const auto cell = hn::LoadU(Integers(), field.cells[0].cell.data() + voxel);
    for (int dz = -rings; dz <= rings; ++dz) {
        for (int dy = -rings; dy <= rings; ++dy) {
            const RowKey key = keys.key[dz + 2][dy + 2];
            for (int dx = -rings; dx <= rings; ++dx) {
                if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) <= done) continue;
                const CellPointVector point =
                    cell_point(key, scaled_neighbours(cell, dx, field.frequency[0]), field.shift);
                const auto along = [](FloatVector a, FloatVector b, int offset) HWY_ATTR {
                    const auto distance =
                        hn::Sub(hn::Sub(a, b), hn::Set(kFloats, static_cast<float>(offset)));
                    return hn::Mul(distance, distance);
                };
                const auto squared = hn::Add(hn::Add(along(x, point.x, dx), along(y, point.y, dy)),
                                             along(z, point.z, dz));
                nearest.second = hn::Min(nearest.second, hn::Max(nearest.first, squared));
                nearest.first = hn::Min(nearest.first, squared);
            }
        }
    }
}

void cell_row(const CellField& field, int first_voxel, int size, std::size_t row, std::size_t slice,
              float* out) {
    const bool second = field.feature != config::WorleyFeature::f1;
    const auto infinity = hn::Set(kFloats, std::numeric_limits<float>::infinity());
    const RowKeys keys = keys_about(field, row, slice);
    // Points beyond one ring of cells are at least a cell away.
    const auto safe = hn::Set(kFloats, 0.9999f);
    for (std::size_t i = 0; i < static_cast<std::size_t>(size); i += kLanes) {
        const std::size_t voxel = static_cast<std::size_t>(first_voxel) + i;
        Nearest nearest{infinity, infinity};
        look_at(field, keys, voxel, row, slice, -1, 1, nearest);
        if (!hn::AllTrue(kFloats, hn::Le(second ? nearest.second : nearest.first, safe))) {
            look_at(field, keys, voxel, row, slice, 1, 2, nearest);
        }
        hn::StoreU(cell_value(field.feature, field.value_form, nearest.first, nearest.second),
                   kFloats, out + i);
    }
}

template <class FillRow>
HWY_INLINE void for_each_row(const VoxelBox& chunk, std::size_t row_stride, float* out,
                             const FillRow& fill_row) {
    for (int z = 0; z < chunk.size[2]; ++z) {
        for (int y = 0; y < chunk.size[1]; ++y) {
            fill_row(static_cast<std::size_t>(chunk.origin[1] + y),
                     static_cast<std::size_t>(chunk.origin[2] + z),
                     out + static_cast<std::size_t>(z * chunk.size[1] + y) * row_stride);
        }
    }
}

}  // namespace

void gradient_pointwise(const GradientOctave& octave, const VoxelBox& chunk, std::size_t row_stride,
                        float* out) {
    for_each_row(chunk, row_stride, out, [&](std::size_t row, std::size_t slice, float* target) {
        const auto fill = octave.time ? gradient_row<MovingRow> : gradient_row<StillRow>;
        fill(octave, chunk.origin[0], chunk.size[0], row, slice, target);
    });
}

void cells_pointwise(const CellField& field, const VoxelBox& chunk, std::size_t row_stride,
                     float* out) {
    for_each_row(chunk, row_stride, out, [&](std::size_t row, std::size_t slice, float* target) {
        cell_row(field, chunk.origin[0], chunk.size[0], row, slice, target);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::noise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(gradient_pointwise);
HWY_EXPORT(cells_pointwise);

void fill_gradient_octave_pointwise(const GradientOctave& octave, const VoxelBox& chunk,
                                    std::size_t row_stride, float* out) {
    HWY_DYNAMIC_DISPATCH(gradient_pointwise)(octave, chunk, row_stride, out);
}

void fill_cell_field_pointwise(const CellField& field, const VoxelBox& chunk,
                               std::size_t row_stride, float* out) {
    HWY_DYNAMIC_DISPATCH(cells_pointwise)(field, chunk, row_stride, out);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
