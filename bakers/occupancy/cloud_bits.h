// Tells which voxels of a volume are above a threshold, one bit each, and which of the cells between
// voxel centres hold cloud.
//
// A trilinear lookup blends the eight voxels about a place. The cell between their centres is
//   touched  if one of them is above the threshold: else no lookup in it is,
//   holed    if one of them is not above it: else every lookup in it is.
// Both follow from the corners, since a trilinear blend lies between the least and the greatest of
// them. Cells repeat along x and y as the volume does. Along z, where lookups are clamped, there is
// one more cell than there are voxels: cell 0 lies between the base and the first centres, the last
// one between the last centres and the top.
//
// The exact distance from any place to the touched and to the holed cells of a volume, found by
// search and not by the passes of distance_transform, which it judges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_range.h"

namespace skybake::occupancy {

inline constexpr int kWordBits = 64;

class VoxelBits {
  public:
    explicit VoxelBits(const std::array<int, 3>& voxels);

    const std::array<int, 3>& voxels() const { return voxels_; }
    std::size_t words() const { return words_; }  // of a row, whose bits beyond the voxels are 0

    // Rows of different y or z may be set on several threads.
    void set_row(int y, int z, const float* values, float threshold);
    // The voxel (x, y, z) is above the threshold.
    void set(int x, int y, int z);

    const std::uint64_t* row(int y, int z) const { return bits_.data() + offset(y, z); }
    bool at(int x, int y, int z) const {
        const auto bit = static_cast<unsigned>(x);
        return ((row(y, z)[bit / kWordBits] >> (bit % kWordBits)) & 1U) != 0;
    }

  private:
    std::size_t offset(int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(voxels_[1]) +
                static_cast<std::size_t>(y)) *
               words_;
    }

    std::array<int, 3> voxels_;
    std::size_t words_;
    std::vector<std::uint64_t> bits_;
};

// Reads the stored voxels of a source. They are all at or below a threshold >= 0 where the source is
// known to be empty. Incomplete once options.progress is cancelled.
VoxelBits voxel_bits(const ChannelSource& source, const CellGrid& grid, float threshold,
                     const BakeOptions& options);

enum class CellKind { touched, holed };

// Writes, for the cells between the voxels y and y + 1 and between z - 1 and z, in bit x whether the
// cell between the voxels x and x + 1 is of the kind: bits.words() words, in which bits beyond the
// row's cells are 0. z is 0 to the number of voxels.
void cells_between(const VoxelBits& bits, CellKind kind, int y, int z, std::uint64_t* cells);

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
