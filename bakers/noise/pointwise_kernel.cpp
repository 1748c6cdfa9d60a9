#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/pointwise_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "bakers/noise/cell_tile-inl.h"
#include "bakers/noise/gradient_blend-inl.h"
#include "bakers/noise/lattice_hash-inl.h"
#include "bakers/noise/scattered_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {
namespace {

// --- Gradient noise -----------------------------------------------------------------------------

template <class Row>
void gradient_row(const GradientOctave& octave, int first_voxel, int size, std::size_t row,
                  std::size_t slice, float* out) {
    Row rows[2][2];
    for (int dy = 0; dy < 2; ++dy) {
        for (int dz = 0; dz < 2; ++dz) {
            rows[dy][dz] = Row::of(octave, [&](std::uint64_t key) HWY_ATTR {
                return in_all_lanes(
                    row_key(key, wrapped_cell(octave.cells[1].cell[row] + dy, octave.frequency[1]),
                            wrapped_cell(octave.cells[2].cell[slice] + dz, octave.frequency[2])));
            });
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

// The cells about a voxel along an axis, nearest first: its own, its neighbours, and those beyond.
struct NearCells {
    float fraction = 0;
    float to_face = 0;  // of the voxel's cell
    std::array<int, 5> offset{};
    std::array<std::uint32_t, 5> cell{};
    std::array<float, 5> squared{};  // no point of the cell has a lower squared distance
};

NearCells cells_about(const AxisCells& axis, std::size_t voxel, int frequency) {
    NearCells cells;
    cells.fraction = axis.fraction[voxel];
    const int nearer = cells.fraction < 0.5f ? -1 : 1;
    const float to_face = std::min(cells.fraction, 1 - cells.fraction);
    cells.to_face = to_face;
    cells.offset = {0, nearer, -nearer, 2 * nearer, -2 * nearer};
    const std::array<float, 5> distance = {0, to_face, 1 - to_face, 1 + to_face, 2 - to_face};
    for (std::size_t i = 0; i < cells.cell.size(); ++i) {
        cells.cell[i] = wrapped_cell(axis.cell[voxel] + cells.offset[i], frequency);
        const float least = std::max(0.0f, distance[i] - 1e-5f);  // far below what rounding does
        cells.squared[i] = least * least;
    }
    return cells;
}

// A row of cells along x among those about a voxel.
struct CellRow {
    RowKey key;
    float squared;  // as in NearCells
    int dy, dz;
};

CellRow cell_row(const CellField& field, const NearCells& y, std::size_t i, const NearCells& z,
                 std::size_t k) {
    return {row_key(field.key, y.cell[i], z.cell[k]), y.squared[i] + z.squared[k], y.offset[i],
            z.offset[k]};
}

// Fills a row of voxels. Looks at rows of cells until no further one can hold a nearer point.
template <bool kSecond>
void cells_of_row(const CellField& field, int first_voxel, int size, std::size_t row,
                  std::size_t slice, float* out) {
    const NearCells y = cells_about(field.cells[1], row, field.frequency[1]);
    const NearCells z = cells_about(field.cells[2], slice, field.frequency[2]);
    std::array<CellRow, 9> rows;
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = cell_row(field, y, i % 3, z, i / 3);
    std::ranges::sort(rows, {}, &CellRow::squared);
    const auto to_face = hn::Set(kFloats, std::min(y.to_face, z.to_face));
    for (std::size_t i = 0; i < static_cast<std::size_t>(size); i += kLanes) {
        const std::size_t voxel = static_cast<std::size_t>(first_voxel) + i;
        const auto x = hn::LoadU(kFloats, field.cells[0].fraction.data() + voxel);
        const auto cell = hn::LoadU(Integers(), field.cells[0].cell.data() + voxel);
        CellTile<1, 1, kSecond> tile;
        const auto is_found = [&](const CellRow& cells) HWY_ATTR {
            return hn::AllTrue(kFloats, hn::Le(tile.farthest(), hn::Set(kFloats, cells.squared)));
        };
        const auto take = [&](const CellPointVector& point, int dx, const CellRow& cells) HWY_ATTR {
            const auto along = [](FloatVector at, FloatVector from, int offset) HWY_ATTR {
                return squared_along(at, from, hn::Set(kFloats, -static_cast<float>(offset)));
            };
            const auto across = hn::Add(along(x, point.x, dx),
                                        along(hn::Set(kFloats, y.fraction), point.y, cells.dy));
            const auto squared_z = along(hn::Set(kFloats, z.fraction), point.z, cells.dz);
            tile.take(0, 0, hn::Add(across, squared_z));
        };
        const WordVector scaled_x[] = {scaled_neighbours(cell, -1, field.frequency[0]),
                                       scaled_neighbours(cell, 0, field.frequency[0]),
                                       scaled_neighbours(cell, 1, field.frequency[0])};
        for (auto cells = rows.begin(); cells != rows.end() && !is_found(*cells); ++cells) {
            CellPointVector points[3];
            cell_points(in_all_lanes(cells->key), scaled_x, field.shift, points);
            for (int dx = -1; dx <= 1; ++dx) take(points[dx + 1], dx, *cells);
        }
        const bool is_near =
            is_within_rings(tile.farthest(), 1, hn::Min(to_face, distance_to_face(x)));
        for (std::size_t k = 0; k < 25 && !is_near; ++k) {  // the second ring, too
            const CellRow cells = cell_row(field, y, k % 5, z, k / 5);
            if (is_found(cells)) continue;
            const int step = std::max(k % 5, k / 5) < 3 ? 4 : 1;
            for (int dx = -2; dx <= 2; dx += step) {
                const auto beside = scaled_neighbours(cell, dx, field.frequency[0]);
                take(cell_point(in_all_lanes(cells.key), beside, field.shift), dx, cells);
            }
        }
        tile.store(field, [&](std::size_t, std::size_t) { return out + i; });
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
        const auto fill =
            field.feature == config::WorleyFeature::f1 ? cells_of_row<false> : cells_of_row<true>;
        fill(field, chunk.origin[0], chunk.size[0], row, slice, target);
    });
}

}  // namespace skybake::noise::HWY_NAMESPACE
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
