// Where the voxels of a tile lie on a lattice, in integers: tiling is exact by construction for any
// size and frequency.
//
//   position of voxel i = (2 i + o) f / (2 N) cells,   o = 1: voxel centres, o = 0: lower corners
//
// i may be any integer: voxel i + N is voxel i.
#pragma once

#include <array>
#include <cstdint>

#include "config/sections/noise.h"

namespace skybake::noise {

// One axis of a tile: how many voxels, and where in them the samples are.
struct TileAxis {
    int size = 0;
    int offset = 0;  // of the sample within its voxel, in half voxels: 0 or 1
};

std::array<TileAxis, 3> tile_axes(const std::array<int, 3>& size, config::NoiseSampling sampling);

// A sample on a lattice: cell + numerator / denominator cells, 0 <= numerator < denominator.
struct LatticePosition {
    std::int64_t cell = 0;  // not wrapped
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;
};

inline std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
    const std::int64_t quotient = a / b;
    return quotient - (a % b < 0 ? 1 : 0);
}

inline LatticePosition lattice_position(const TileAxis& axis, int frequency, std::int64_t voxel) {
    const std::int64_t denominator = std::int64_t{2} * axis.size;
    const std::int64_t scaled = (2 * voxel + axis.offset) * frequency;
    const std::int64_t cell = floor_divide(scaled, denominator);
    return {cell, scaled - cell * denominator, denominator};
}

// Whether the lattice has at most one cell a voxel along every axis of more than one voxel: then
// neighbours share lattice points, and the kernels that share their work apply.
bool is_resolved(const std::array<TileAxis, 3>& axes, const std::array<int, 3>& frequency);

// The position in the cell, in [0, 1), as the kernels for cells take it: rounded to float.
inline float cell_fraction(const LatticePosition& position) {
    return static_cast<float>(static_cast<double>(position.numerator) /
                              static_cast<double>(position.denominator));
}

// The lattice repeats after `frequency` cells.
inline std::uint32_t wrapped_cell(std::int64_t cell, int frequency) {
    return static_cast<std::uint32_t>(cell - floor_divide(cell, frequency) * frequency);
}

}  // namespace skybake::noise
