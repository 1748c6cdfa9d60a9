#include "bakers/noise/lattice_hash.h"

#include <cassert>
#include <limits>

namespace skybake::noise {

LatticePlanes make_lattice_planes(const std::array<int, 3>& frequency, std::uint64_t key,
                                  const std::array<AxisCells, 3>& cells, const VoxelBox& box,
                                  int chunk_depth, int before, int after) {
    assert(chunk_depth >= 1 && before >= 0 && after >= 0);
    LatticePlanes planes;
    planes.frequency = frequency;
    planes.key = key;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& cell = cells[axis].cell;
        const auto begin = static_cast<std::size_t>(box.origin[axis]);
        const int length = axis == 2 ? std::min(chunk_depth, box.size[2]) : box.size[axis];
        const auto last = begin + static_cast<std::size_t>(length) - 1;
        planes.first[axis] = cell[begin] - before;
        planes.count[axis] = static_cast<int>(cell[last] - cell[begin]) + 1 + before + after;
    }
    // Planes are a ring: wherever a chunk begins, it meets at most one cell more.
    ++planes.count[2];
    const auto points = static_cast<std::size_t>(planes.count[0]);
    constexpr std::size_t kPadding = kLanePadding;
    // A vector may start at any point and its neighbour.
    planes.stride = (points + kPadding + 1 + kPadding - 1) / kPadding * kPadding;
    planes.scaled_x.resize(points + kPadding);
    for (std::size_t i = 0; i < planes.scaled_x.size(); ++i) {
        planes.scaled_x[i] =
            wrapped_cell(planes.first[0] + static_cast<std::int64_t>(i), frequency[0]) * kGolden32;
    }
    const auto slots = static_cast<std::size_t>(planes.count[2]);
    for (AlignedFloats* values : {&planes.x, &planes.y, &planes.z}) {
        values->resize(planes.row(slots, 0) + kPadding);
    }
    planes.plane_of_slot.assign(slots, std::numeric_limits<std::int64_t>::min());
    return planes;
}

}  // namespace skybake::noise
