// The exact distance from any place to the touched and to the holed cells of a volume, found by
// search and not by the passes of distance_transform, which it judges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/occupancy/cloud_bits.h"

namespace skybake::occupancy {

// Cells that touch a voxel reach from the centre of the voxel to one voxel on either side, within the
// base and the top. So the touched cells are these boxes about the voxels above the threshold, and the
// holed ones those about the others. The search descends blocks of 4, 8, 16 ... voxels each way, the
// nearer ones first, and leaves out blocks that are farther than what it has found.
class NearestVoxel {
  public:
    // `bits` must outlive it. Memory: a byte for every 64 voxels, and a seventh of that.
    NearestVoxel(const VoxelBits& bits, const std::array<double, 3>& voxel_m);

    // Return the distance in metres from a place in voxels, voxel i from i to i + 1. x and y lie in
    // the tile, which repeats; z is any. Infinite: there is no such cell. Holes lie below the base
    // and above the top, too.
    double to_cloud(const std::array<double, 3>& place) const;
    double to_hole(const std::array<double, 3>& place) const;

  private:
    struct Blocks {
        int edge = 0;  // in voxels
        std::array<int, 3> size{};
        std::vector<std::uint8_t> holds;  // bit 0: a voxel that is not above the threshold; 1: one
                                          // that is
    };
    struct Search;
    struct Block {
        std::array<int, 3> at{};
        double square = 0;
    };

    void add_level();
    unsigned contents_of_voxels(const std::array<int, 3>& first) const;
    unsigned contents_of_blocks(const std::array<int, 3>& first) const;
    double least_square(const std::array<double, 3>& place, bool above) const;
    double square_to(const Search& search, const std::array<int, 3>& first, int edge) const;
    void search_block(std::size_t level, const std::array<int, 3>& at, Search& search) const;
    void search_voxels(const std::array<int, 3>& at, Search& search) const;

    const VoxelBits& bits_;
    std::array<double, 3> voxel_m_;
    std::vector<Blocks> levels_;
};

}  // namespace skybake::occupancy
