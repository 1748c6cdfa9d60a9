// The vector kernels of cell_range, which process one row of cells along x.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/math/memory.h"

namespace skybake::occupancy {

// The smallest and largest magnitude of values, as the bits of floats, which have the same order.
struct Magnitudes {
    std::uint32_t smallest = ~0U;  // smallest magnitude that is not 0
    std::uint32_t largest = 0;

    bool all_zero() const { return largest == 0; }
    void add(const Magnitudes& other) {
        smallest = std::min(smallest, other.smallest);
        largest = std::max(largest, other.largest);
    }
};
// Returns the magnitudes of `count` values. `next` points to as many values that are processed
// later; they are prefetched into the cache.
Magnitudes magnitudes_of(const float* values, std::size_t count, const float* next);

// True if means of up to eight such values are exact in double. Values from 2^s up are multiples of
// 2^(s - 23). Sums of eight values below 2^(l + 1) are below 2^(l + 4) and are multiples of the
// same number: 53 bits hold them if l + 4 - (s - 23) <= 53. Halving is exact, as floats are far
// from the denormals of double.
bool means_are_exact(const Magnitudes& magnitudes);

// Computes the filter's values where a row of voxels along x meets the lower faces of its cells:
// the means of two voxels, one per cell, in `means`. The voxel before the first face is the row's
// last one.
void face_means(const float* voxels, std::size_t length, int cell, double* means);

struct VoxelRow {
    const float* voxels = nullptr;
    const double* faces = nullptr;  // face_means
};

// The rows of voxels of a row of cells and of its halo: rows[z * height + y].
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

// The extremes of the filter over some nodes along y and z, at each voxel along x and at the lower
// face of each cell.
struct NodeExtremes {
    Extremes<double> voxels;
    Extremes<double> faces;
};

// Buffers that are reused from call to call.
struct RowScratch {
    std::vector<const float*> voxel_rows;
    std::vector<const double*> face_rows;
    Extremes<float> voxels;
    NodeExtremes within;
    NodeExtremes all;
};

// For the trilinear filter the nodes of a row of cells are its voxels, the nodes on its two faces
// along y at voxels along z, and the nodes on its two faces along z, edges included. Neighbouring
// cells share faces. All values are double, which is exact where means_are_exact. The bundle has a
// halo of one row and one plane.
enum class Face { lower, upper };
void y_face_extremes(const RowBundle& bundle, Face face, RowScratch& scratch, NodeExtremes& nodes);
void z_face_extremes(const RowBundle& bundle, Face face, RowScratch& scratch, NodeExtremes& nodes);

// Computes the extremes of each cell over its voxels and its four faces along y and z.
void trilinear_row(const RowBundle& bundle, const std::array<const NodeExtremes*, 4>& faces,
                   RowScratch& scratch, Extremes<double>& cells);

// Computes the extremes of the voxels of each cell and `halo` voxels around it. The bundle must
// have the same halo.
void footprint_row(const RowBundle& bundle, int halo, RowScratch& scratch, float* least,
                   float* most);

}  // namespace skybake::occupancy
