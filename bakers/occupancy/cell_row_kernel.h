// One row of cells along x: the vector kernels of cell_range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/core/aligned_floats.h"

namespace skybake::occupancy {

// The magnitudes of values, as the bits of floats, which order as they do.
struct Magnitudes {
    std::uint32_t smallest = ~0U;  // that is not 0
    std::uint32_t largest = 0;

    bool all_zero() const { return largest == 0; }
    void add(const Magnitudes& other);
};
Magnitudes magnitudes_of(const float* values, std::size_t count);

// Whether means of up to eight such values are exact in double. Values from 2^s up are multiples of
// 2^(s - 23). Sums of eight below 2^(l + 1) are below 2^(l + 4), and multiples of the same: 53 bits
// hold them if l + 4 - (s - 23) <= 53. Halving is exact, as floats are far from double's denormals.
bool means_are_exact(const Magnitudes& magnitudes);

// The filter's values where a row of voxels along x meets the lower faces of its cells: means of
// two voxels, in `means` one per cell. The voxel before the first face is the row's last.
void face_means(const float* voxels, std::size_t length, int cell, double* means);

struct VoxelRow {
    const float* voxels = nullptr;
    const double* faces = nullptr;  // face_means
};

// The rows about a row of cells, those of its halo too: rows[z * height + y].
struct RowBundle {
    std::vector<VoxelRow> rows;
    int height = 0;
    int depth = 0;
    std::size_t length = 0;  // voxels of a row
    int cell = 1;

    const VoxelRow& at(int y, int z) const {
        return rows[static_cast<std::size_t>(z * height + y)];
    }
    std::size_t cells() const { return (length - 1) / static_cast<std::size_t>(cell) + 1; }
};

// The least and the greatest values, element by element.
template <class Value>
struct Extremes {
    using Array = std::vector<Value, CacheLineAllocator<Value>>;
    Array least;
    Array most;

    void resize(std::size_t count) {
        least.resize(count);
        most.resize(count);
    }
};

// Memory that one call leaves to the next.
struct RowScratch {
    // Indices of rows of a bundle of this height and depth whose means are the nodes along y and z:
    // one, two or four a node, as 0, 1 or 2 of its coordinates are on faces.
    int height = 0;
    int depth = 0;
    std::array<std::vector<std::size_t>, 3> node_rows;
    std::vector<const float*> voxel_rows;
    std::vector<const double*> face_rows;
    Extremes<float> voxels;
    Extremes<double> along;  // over nodes along y and z, at each voxel along x
    Extremes<double> faces;  // the same at the lower face of each cell
};

// The extremes over the nodes of the trilinear filter of each cell, in double: exact where
// means_are_exact. The bundle has a halo of one row and one plane.
void trilinear_row(const RowBundle& bundle, RowScratch& scratch, Extremes<double>& cells);

// The extremes of the voxels of each cell and `halo` about it; the bundle has the same halo.
void footprint_row(const RowBundle& bundle, int halo, RowScratch& scratch, float* least,
                   float* most);

}  // namespace skybake::occupancy
