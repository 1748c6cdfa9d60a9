#include "bakers/assets/cloud_light/depth_sweep.h"

#include <algorithm>
#include <cassert>

#include "bakers/assets/cloud_light/depth_kernel.h"
#include "bakers/math/parallel.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::cloud_light {

using occupancy::wrapped;

namespace {

constexpr int kCell = 8;  // voxels along the edge of a cell of the occupancy

int divisor_up_to(int most, int size) {
    int divisor = std::min(most, size);
    while (size % divisor != 0) --divisor;
    return divisor;
}

}  // namespace

glm::dvec3 PlaceGrid::place(int x, int y, int z) const {
    const auto along = [&](std::size_t a, int i) {
        return (i + 0.5) * voxels[a] / static_cast<double>(count[a]);
    };
    return {along(0, x), along(1, y), at_base ? 0 : along(2, z)};
}

PlaceGrid place_grid(const std::array<int, 3>& voxels, int apart, bool at_base) {
    PlaceGrid grid;
    grid.voxels = voxels;
    grid.at_base = at_base;
    for (std::size_t a = 0; a < 2; ++a) {
        grid.count[a] = voxels[a] / divisor_up_to(apart, voxels[a]);
    }
    grid.count[2] = at_base ? 1 : (voxels[2] + apart - 1) / apart;
    return grid;
}

DepthSweep::DepthSweep(const CloudLayer& layer, const PlaceGrid& places, int threads)
    : layer_(layer),
      places_(places),
      apart_x_(layer.size[0] / places.count[0]),
      apart_y_(layer.size[1] / places.count[1]),
      phase_length_(static_cast<std::size_t>(places.count[0]) + kDepthBlock) {
    assert(places.voxels == layer.size);
    sort_phases(threads);
    count_cells(threads);
}

void DepthSweep::sort_phases(int threads) {
    const auto of_row = static_cast<std::size_t>(places_.count[0]);
    const std::size_t plane = static_cast<std::size_t>(layer_.size[1]) *
                              static_cast<std::size_t>(apart_x_) * phase_length_;
    phases_.resize(static_cast<std::size_t>(layer_.size[2]) * plane);
    parallel_for(layer_.size[2], threads, [&](int z) {
        float* out = phases_.data() + static_cast<std::size_t>(z) * plane;
        for (int y = 0; y < layer_.size[1]; ++y) {
            for (int phase = 0; phase < apart_x_; ++phase) {
                for (std::size_t i = 0; i < phase_length_; ++i) {
                    const auto place = static_cast<int>(i % of_row);
                    *out++ = layer_.value(place * apart_x_ + phase, y, z);
                }
            }
        }
    });
}

void DepthSweep::count_cells(int threads) {
    const occupancy::CellGrid grid{layer_.size, kCell};
    const auto ranges = occupancy::cell_ranges(layer_.values.data(), grid,
                                               config::OccupancyFilter::trilinear, threads);
    const std::vector<std::uint8_t> occupied =
        occupancy::occupied_cells(ranges, layer_.threshold()).occupied;
    cells_ = grid.size();
    const auto of_row = static_cast<std::size_t>(cells_[0]);
    for (std::size_t row = 0; row < occupied.size(); row += of_row) {
        std::int32_t before = 0;
        occupied_before_.push_back(before);
        for (std::size_t x = 0; x < 2 * of_row; ++x) {
            before += occupied[row + x % of_row];
            occupied_before_.push_back(before);
        }
    }
}

std::vector<SweepRays> DepthSweep::rays(const glm::dvec3& direction) const {
    std::vector<SweepRays> rays;
    for (int z = 0; z < places_.count[2]; ++z) {
        rays.push_back(arranged(make_stencil(layer_, places_.place(0, 0, z), direction)));
    }
    return rays;
}

SweepRays::Along DepthSweep::along(int dx) const {
    const int inside = wrapped(dx, layer_.size[0]);
    return {static_cast<std::size_t>(inside % apart_x_) * phase_length_, inside / apart_x_};
}

SweepRays DepthSweep::arranged(const RayStencil& stencil) const {
    SweepRays rays;
    for (const VoxelWeight& voxel : stencil.voxels) {
        const bool goes_on =
            !rays.runs.empty() && rays.runs.back().z == voxel.z && rays.runs.back().dy == voxel.dy;
        if (!goes_on) rays.runs.push_back({voxel.dy, voxel.z, voxel.dx, voxel.dx, 0});
        rays.voxels.push_back({along(voxel.dx), voxel.weight});
        rays.runs.back().last_dx = voxel.dx;
        rays.runs.back().end = rays.voxels.size();
    }
    for (const FilteredPoint& point : stencil.points) {
        rays.points.push_back({{along(point.dx), along(point.dx + 1)}, point});
    }
    return rays;
}

std::size_t DepthSweep::row_of(int y, int z) const {
    const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(layer_.size[1]) +
                     static_cast<std::size_t>(wrapped(y, layer_.size[1]));
    return row * static_cast<std::size_t>(apart_x_) * phase_length_;
}

const float* DepthSweep::values_at(std::size_t row, const SweepRays::Along& at, int first) const {
    int index = at.index + first;
    if (index >= places_.count[0]) index -= places_.count[0];
    return phases_.data() + row + at.phase + index;
}

// Whether the voxels first_x to first_x + width - 1 of a row are in empty cells.
bool DepthSweep::is_empty(int first_x, int width, int y, int z) const {
    const int size = layer_.size[0];
    const auto per_row = static_cast<std::size_t>(2 * cells_[0] + 1);
    const auto row = static_cast<std::size_t>(z / kCell) * static_cast<std::size_t>(cells_[1]) +
                     static_cast<std::size_t>(wrapped(y, layer_.size[1]) / kCell);
    const std::int32_t* before = occupied_before_.data() + row * per_row;
    if (width >= size) return before[cells_[0]] == 0;
    const int first = wrapped(first_x, size);
    const int last = first + width - 1;
    const int last_cell = last < size ? last / kCell : cells_[0] + (last - size) / kCell;
    return before[last_cell + 1] == before[first / kCell];
}

void DepthSweep::sum_voxels(const SweepRays& rays, int first, int width, int y, float* sums) const {
    thread_local std::vector<WeightedRow> rows;
    rows.clear();
    const int x = first * apart_x_;
    std::size_t voxel = 0;
    for (const SweepRays::Run& run : rays.runs) {
        const int row_y = y * apart_y_ + run.dy;
        const int voxels = (width - 1) * apart_x_ + 1 + run.last_dx - run.first_dx;
        if (is_empty(x + run.first_dx, voxels, row_y, run.z)) {
            voxel = run.end;
            continue;
        }
        const std::size_t row = row_of(row_y, run.z);
        for (; voxel < run.end; ++voxel) {
            const SweepRays::Voxel& at = rays.voxels[voxel];
            rows.push_back({values_at(row, at.at, first), at.weight});
        }
    }
    add_rows(rows, sums);
}

void DepthSweep::sum_points(const SweepRays& rays, int first, int width, int y, float* sums) const {
    thread_local std::vector<FilteredRow> rows;
    rows.clear();
    const int voxels = (width - 1) * apart_x_ + 2;
    for (const SweepRays::Point& at : rays.points) {
        const int x = first * apart_x_ + at.point.dx;
        const int row_y = y * apart_y_ + at.point.dy;
        const std::array<int, 2> planes = {at.point.z, at.point.above};
        bool empty = true;
        for (const int plane : planes) {
            empty =
                empty && is_empty(x, voxels, row_y, plane) && is_empty(x, voxels, row_y + 1, plane);
        }
        if (empty) continue;
        FilteredRow& out = rows.emplace_back();
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const std::size_t row =
                row_of(row_y + static_cast<int>((corner >> 1) & 1), planes[corner >> 2]);
            out.corners[corner] = values_at(row, at.at[corner & 1], first);
        }
        out.share = at.point.share;
        out.weight = at.point.weight;
    }
    add_filtered_rows(rows, layer_.optics, sums);
}

void DepthSweep::row(const SweepRays& rays, int y, float* depths) const {
    constexpr int kBlock = kDepthBlock;
    std::array<float, kDepthBlock> sums;
    for (int first = 0; first < places_.count[0]; first += kBlock) {
        const int width = std::min(kBlock, places_.count[0] - first);
        if (layer_.optics.has_edge) {
            sum_points(rays, first, width, y, sums.data());
        } else {
            sum_voxels(rays, first, width, y, sums.data());
        }
        std::copy_n(sums.data(), width, depths + first);
    }
}

}  // namespace skybake::cloud_light
