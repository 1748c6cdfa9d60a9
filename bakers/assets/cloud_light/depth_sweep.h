// Optical depths from a grid of places in a cloud's layer towards suns, for many places at once.
//
// Along x and y places are whole numbers of voxels apart, so that a ray stencil holds for all of a
// height. Rows of voxels are stored by phases, x modulo the distance of places, each with a copy of
// itself behind it: then a block of places takes consecutive floats of each row and nothing wraps.
//
// Rows that the occupancy of cells knows to be empty over a block are left out. They would add 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/ray_stencil.h"
#include "bakers/math/memory.h"
#include "bakers/math/vectors.h"

namespace skybake::cloud_light {

// The places of an axis of `voxels` voxels whose light is computed: place i is at
// (i + 1/2) * voxels / count.
struct PlaceGrid {
    std::array<int, 3> voxels{};
    std::array<int, 3> count{};
    bool at_base = false;  // a single height: z = 0

    glm::dvec3 place(int x, int y, int z) const;
};

// Returns places at most `apart` voxels from each other; along x and y a divisor of the size.
PlaceGrid place_grid(const std::array<int, 3>& voxels, int apart, bool at_base);

// The rays towards one sun from one height, in terms of rows of phases.
struct SweepRays {
    // A voxel that all places of a row need, relative to the place of the row's first voxel.
    struct Along {
        std::size_t phase = 0;  // where the row of its phase begins
        int index = 0;          // in that row, within the tile
    };
    struct Voxel {
        Along at;
        float weight = 0;
    };
    // Voxels that lie in one row.
    struct Run {
        int dy = 0;
        int z = 0;
        int first_dx = 0;
        int last_dx = 0;
        std::size_t end = 0;  // of its voxels; they begin where those of the run before end
    };
    struct Point {
        std::array<Along, 2> at;
        FilteredPoint point;
    };
    std::vector<Run> runs;
    std::vector<Voxel> voxels;
    std::vector<Point> points;
};

class DepthSweep {
  public:
    DepthSweep(const CloudLayer& layer, const PlaceGrid& places, int threads);

    // The rays towards one sun, from each height of the places. `direction` is a unit vector that
    // rises.
    std::vector<SweepRays> rays(const glm::dvec3& direction) const;

    // Writes the optical depths of the places of row y: places.count[0] numbers.
    void row(const SweepRays& rays, int y, float* depths) const;

  private:
    SweepRays arranged(const RayStencil& stencil) const;
    SweepRays::Along along(int dx) const;
    void sort_phases(int threads);
    void count_cells(int threads);

    std::size_t row_of(int y, int z) const;
    const float* values_at(std::size_t row, const SweepRays::Along& at, int first) const;
    bool is_empty(int first_x, int width, int y, int z) const;
    // Write the sums of `width` places of row y, from `first` on; at most one block.
    void sum_voxels(const SweepRays& rays, int first, int width, int y, float* sums) const;
    void sum_points(const SweepRays& rays, int first, int width, int y, float* sums) const;

    const CloudLayer& layer_;
    PlaceGrid places_;
    int apart_x_ = 1;
    int apart_y_ = 1;
    std::size_t phase_length_ = 0;  // of a row of one phase, with what a block needs behind it
    AlignedFloats phases_;
    std::array<int, 3> cells_{};
    std::vector<std::int32_t> occupied_before_;  // cells of a row before each one, over two tiles
};

}  // namespace skybake::cloud_light
