// A volume whose voxels are all in memory.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"

namespace skybake {

struct Baked;

class VoxelArray : public VoxelSource {
  public:
    // All voxels are 0.
    VoxelArray(const std::array<int, 3>& size, std::size_t channels);
    // `values` are [channel][z][y][x].
    VoxelArray(const std::array<int, 3>& size, std::vector<std::vector<float>> values)
        : size_(size), values_(std::move(values)) {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

    const std::array<int, 3>& size() const { return size_; }
    std::size_t channels() const { return values_.size(); }
    std::size_t offset(int x, int y, int z) const;
    std::vector<float>& channel(std::size_t c) { return values_[c]; }
    const std::vector<float>& channel(std::size_t c) const { return values_[c]; }
    double largest(std::size_t channel) const;
    // Returns from 0 to the largest value of each channel, or to 1 where none is above 0.
    std::vector<std::array<double, 2>> ranges() const;

  private:
    std::array<int, 3> size_;
    std::vector<std::vector<float>> values_;  // per channel, [z][y][x]
};

// Reads all voxels of `source`. Progress reports call this `step`. Once options.progress is cancelled,
// the voxels are incomplete, so callers must check it.
VoxelArray read_voxels(const VoxelSource& source, const std::array<int, 3>& size, int channels,
                       const BakeOptions& options, std::string_view step);

// Writes a channel of a volume's finest voxels, x fastest, rounded to its pixel type. They are
// incomplete after an interruption.
void read_channel(const Baked& volume, std::size_t channel, const BakeOptions& options, float* to);

}  // namespace skybake
