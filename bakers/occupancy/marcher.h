// A ray marcher with fixed steps, as runtimes have it, with and without skipping. It counts what an
// occupancy grid saves, and shows that the exact rule does not change anything that a ray sees.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/occupied_cells.h"

namespace skybake::occupancy {

// A volume in memory, which repeats along x and y and is 0 below and above, and the function that
// turns its values into extinction.
struct MarchedVolume {
    const float* voxels = nullptr;  // x fastest
    CellGrid grid;
    std::array<double, 3> extent{};  // of the tile, in the units of rays
    // The extinction of value v is v * smoothstep(threshold, threshold + edge_softness, v) where
    // the threshold is applied after filtering, else v. It is 0 where v is not greater than the
    // threshold.
    bool has_edge = false;
    float threshold = 0;
    double edge_softness = 0;
};

struct Ray {
    std::array<double, 3> origin{};
    std::array<double, 3> direction{};  // of length 1; z is up
};

enum class Skipping {
    none,
    cells,  // from an empty cell to the next cell
    leaps   // from an empty cell over all cells within its skip distance - 1
};

struct MarchResult {
    double optical_depth = 0;
    int density_fetches = 0;    // without skipping, one for every sample within the volume's height
    int structure_fetches = 0;  // one for each cell that is looked at
};

// Samples the volume at k * step for k = 0, 1, ... up to `length` where that is within its height,
// by trilinear interpolation in double, rounded to float as a texture unit does. A point on a face
// belongs to the cell above it. The optical depth is the step times the sum of extinctions in the
// order of k.
//
// Skipping never misses a sample in an occupied cell, as the cells of samples are compared as
// integers. With cells of the exact rule and the volume's threshold, and with values >= 0 or a
// threshold > 0, all three kinds of skipping therefore give the same bits. `leaps` are the skip
// distances of `cells`; neither is read without skipping.
MarchResult march(const MarchedVolume& volume, const Ray& ray, double length, double step,
                  Skipping skipping, const OccupiedCells& cells,
                  const std::vector<std::uint8_t>& leaps);

}  // namespace skybake::occupancy
