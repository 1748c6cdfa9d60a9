// The random vectors of the lattice points that a box of voxels needs, hashed a plane at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/aligned_floats.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// A ring of lattice planes, [slot][y][x]. What filling a box in chunks keeps from chunk to chunk,
// one thread at a time; lattice_planes-inl.h fills it.
struct LatticePlanes {
    std::array<int, 3> frequency{};
    std::uint64_t key = 0;
    std::array<std::int64_t, 3> first{};  // lattice coordinates of the first point along x and y
    std::array<int, 3> count{};           // points along x and y; planes held along z
    std::size_t stride = 0;               // floats from row to row, with a vector to spare
    std::vector<std::uint32_t> scaled_x;  // of each point along x, wrapped, for its hash
    AlignedFloats x, y, z;
    std::vector<std::int64_t> plane_of_slot;

    std::size_t row(std::size_t slot, std::size_t line) const {
        return (slot * static_cast<std::size_t>(count[1]) + line) * stride;
    }
};

// For chunks within `box` of at most `chunk_depth` slices: the points of their cells, `before` more
// below and `after` more above them.
LatticePlanes make_lattice_planes(const std::array<int, 3>& frequency, std::uint64_t key,
                                  const std::array<AxisCells, 3>& cells, const VoxelBox& box,
                                  int chunk_depth, int before, int after);

}  // namespace skybake::noise
