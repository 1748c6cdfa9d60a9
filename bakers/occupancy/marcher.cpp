#include "bakers/occupancy/marcher.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {

namespace {

// An infinite axis of cells: tile after tile of `cells` cells, the last of each smaller.
struct EndlessAxis {
    int voxels = 1;
    int cell = 1;
    int cells = 1;

    // The cell at `position`, in voxels.
    std::int64_t cell_at(double position) const {
        const auto voxel = static_cast<std::int64_t>(std::floor(position));
        const std::int64_t tile = floor_divided(voxel, voxels);
        return tile * cells + (voxel - tile * voxels) / cell;
    }
    // The lower face of a cell, in voxels.
    double lower_face(std::int64_t index) const {
        const std::int64_t tile = floor_divided(index, cells);
        return static_cast<double>(tile * voxels + (index - tile * cells) * cell);
    }
    int wrapped_cell(std::int64_t index) const {
        return static_cast<int>(index - floor_divided(index, cells) * cells);
    }
    static std::int64_t floor_divided(std::int64_t a, std::int64_t b) {
        return a / b - (a % b < 0 ? 1 : 0);
    }
};

using CellIndex = std::array<std::int64_t, 3>;

double edge(const MarchedVolume& volume, float value) {
    if (!(value > volume.threshold)) return 0;
    if (!volume.has_edge) return double{value};
    if (volume.edge_softness == 0) return double{value};  // a step, and above it
    const double above = (double{value} - double{volume.threshold}) / volume.edge_softness;
    const double x = std::min(above, 1.0);
    return double{value} * (x * x * (3 - 2 * x));
}

class March {
  public:
    March(const MarchedVolume& volume, const Ray& ray, double length, double step)
        : volume_(volume),
          ray_(ray),
          step_(step),
          samples_(static_cast<std::int64_t>(std::floor(length / step)) + 1) {
        const std::array<int, 3> cells = volume.grid.size();
        for (std::size_t a = 0; a < 3; ++a) {
            axes_[a] = {volume.grid.voxels[a], volume.grid.cell, cells[a]};
            voxels_per_unit_[a] = volume.grid.voxels[a] / volume.extent[a];
        }
    }

    MarchResult straight() {
        sample_until(0, samples_);
        return result();
    }

    MarchResult skipping(Skipping how, const OccupiedCells& cells,
                         const std::vector<std::uint8_t>& leaps) {
        std::int64_t k = 0;
        while (k < samples_) {
            if (!within_height(k)) {
                ++k;
                continue;
            }
            const CellIndex cell = cell_of(k);
            const std::size_t index =
                index_of(cells.size, axes_[0].wrapped_cell(cell[0]), axes_[1].wrapped_cell(cell[1]),
                         static_cast<int>(cell[2]));
            ++structure_fetches_;
            const bool leap = how == Skipping::leaps;
            const bool empty = leap ? leaps[index] > 0 : cells.occupied[index] == 0;
            const std::int64_t reach = leap && empty ? leaps[index] - 1 : 0;
            const std::int64_t end = first_beyond(k, cell, reach);
            if (!empty) sample_until(k, end);
            k = end;
        }
        return result();
    }

  private:
    double position(std::size_t axis, std::int64_t k) const {
        const double t = static_cast<double>(k) * step_;
        return (ray_.origin[axis] + t * ray_.direction[axis]) * voxels_per_unit_[axis];
    }

    // The top belongs to the highest cell.
    bool within_height(std::int64_t k) const {
        const double height = position(2, k);
        return height >= 0 && height <= volume_.grid.voxels[2];
    }

    CellIndex cell_of(std::int64_t k) const {
        CellIndex cell{};
        for (std::size_t a = 0; a < 3; ++a) cell[a] = axes_[a].cell_at(position(a, k));
        if (position(2, k) == volume_.grid.voxels[2]) cell[2] = axes_[2].cells - 1;
        return cell;
    }

    bool within(std::int64_t k, const CellIndex& cell, std::int64_t reach) const {
        if (!within_height(k)) return false;
        const CellIndex other = cell_of(k);
        for (std::size_t a = 0; a < 3; ++a) {
            if (std::abs(other[a] - cell[a]) > reach) return false;
        }
        return true;
    }

    // Returns the first sample after k that is beyond the box of cells within `reach` of the cell
    // of k, or beyond the ray. Positions, even rounded, change in one direction along each axis, so
    // that samples within the box follow each other. Geometry gives their approximate end, cells
    // the exact one.
    std::int64_t first_beyond(std::int64_t k, const CellIndex& cell, std::int64_t reach) const {
        double exit = std::numeric_limits<double>::infinity();
        for (std::size_t a = 0; a < 3; ++a) {
            const double direction = ray_.direction[a];
            if (direction == 0) continue;
            const double face =
                axes_[a].lower_face(direction > 0 ? cell[a] + reach + 1 : cell[a] - reach);
            exit = std::min(exit, (face / voxels_per_unit_[a] - ray_.origin[a]) / direction);
        }
        const double guess = std::clamp(std::ceil(exit / step_), static_cast<double>(k + 1),
                                        static_cast<double>(samples_));
        auto end = static_cast<std::int64_t>(guess);
        while (end > k + 1 && !within(end - 1, cell, reach)) --end;
        while (end < samples_ && within(end, cell, reach)) ++end;
        return end;
    }

    void sample_until(std::int64_t first, std::int64_t end) {
        for (std::int64_t k = first; k < end; ++k) {
            if (!within_height(k)) continue;
            std::array<AxisTaps, 3> taps;
            for (std::size_t a = 0; a < 3; ++a) {
                taps[a] = filter_taps(config::OccupancyFilter::trilinear, position(a, k),
                                      volume_.grid.voxels[a], a < 2);
            }
            const float value = filtered_value(taps, [&](int x, int y, int z) {
                return volume_.voxels[index_of(volume_.grid.voxels, x, y, z)];
            });
            ++density_fetches_;
            sum_ += edge(volume_, value);
        }
    }

    MarchResult result() const { return {step_ * sum_, density_fetches_, structure_fetches_}; }

    const MarchedVolume& volume_;
    const Ray& ray_;
    const double step_;
    const std::int64_t samples_;
    std::array<EndlessAxis, 3> axes_;
    std::array<double, 3> voxels_per_unit_{};
    double sum_ = 0;
    int density_fetches_ = 0;
    int structure_fetches_ = 0;
};

}  // namespace

MarchResult march(const MarchedVolume& volume, const Ray& ray, double length, double step,
                  Skipping skipping, const OccupiedCells& cells,
                  const std::vector<std::uint8_t>& leaps) {
    assert(step > 0 && length >= 0);
    [[maybe_unused]] const auto& d = ray.direction;
    assert(std::fabs(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1) < 2e-6);
    March march(volume, ray, length, step);
    if (skipping == Skipping::none) return march.straight();
    return march.skipping(skipping, cells, leaps);
}

}  // namespace skybake::occupancy
