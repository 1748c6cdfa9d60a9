#include "bakers/assets/sources/voxel_blocks.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

#include "bakers/field/baked.h"

namespace skybake {

void place_blocks(const Baked& of, const occupancy::CellGrid& grid, const BlockWords& words,
                  Baked& volume) {
    const std::array<int, 3> blocks = grid.size();
    volume.mapping = of.mapping;
    volume.axes = of.axes;
    for (std::size_t i = 0; i < 3; ++i) {
        const double edge = of.voxel_size_m[i] * grid.cell;
        AxisMapping& axis = volume.axes[i];
        axis.last = axis.first + edge * blocks[i];
        const double extent = axis.last - axis.first;
        axis.formula =
            fmt::format("{} = ({} - {}) / {}", "uvw"[i], axis.quantity, axis.first, extent);
        axis.convention = fmt::format("{}; {}", i < 2 ? "repeats" : "clamped", words.place);
        axis.filter = words.filter;
        axis.constants = {{"first_m", axis.first},
                          {"extent_m", extent},
                          {fmt::format("{}_m", words.block), edge},
                          {fmt::format("{}_voxels", words.block), static_cast<double>(grid.cell)}};
        volume.voxel_size_m[i] = edge;
    }
    volume.minimum_m = of.minimum_m;
    volume.up_axis = of.up_axis;
    volume.conventions = of.conventions;
}

}  // namespace skybake
