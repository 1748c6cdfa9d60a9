// Volumes for tests of what is done with voxels: values are simple functions of the indices.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "tests/support/loops.h"

namespace skybake::testing {

// Calls a function of (x, y, z, channel) for each voxel.
class FunctionVoxels : public VoxelSource {
  public:
    using Function = std::function<float(int x, int y, int z, int channel)>;
    explicit FunctionVoxels(Function function) : function_(std::move(function)) {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        fill_rows(box, channels, [&](std::size_t c, int y, int z, float* out) {
            for (int x = 0; x < box.size[0]; ++x) {
                out[x] = function_(box.origin[0] + x, y, z, static_cast<int>(c));
            }
        });
    }

  private:
    Function function_;
};

// In [0, 1], different for neighbours and channels, no half and no unorm.
inline float sample_voxel(int x, int y, int z, int channel) {
    const unsigned mixed =
        static_cast<unsigned>(x) * 2654435761U + static_cast<unsigned>(y) * 2246822519U +
        static_cast<unsigned>(z) * 3266489917U + static_cast<unsigned>(channel) * 668265263U;
    return static_cast<float>(mixed >> 8) / 16777215.0F;
}

inline std::vector<std::string> channel_names(int channels) {
    if (channels == 1) return {"Y"};
    if (channels == 3) return {"R", "G", "B"};
    return {"R", "G", "B", "A"};
}

// Returns the values of each channel in a box.
inline std::vector<std::vector<float>> planes_of(const VoxelSource& source, const VoxelBox& box,
                                                 std::size_t channels) {
    std::vector<std::vector<float>> planes(
        channels, std::vector<float>(static_cast<std::size_t>(box.count())));
    std::vector<float*> targets;
    for (std::vector<float>& plane : planes) targets.push_back(plane.data());
    source.fill(box, targets);
    return planes;
}

// Returns those of a whole level.
inline std::vector<std::vector<float>> planes_of(const Baked& volume) {
    const Level& level = volume.levels.front();
    return planes_of(*level.voxels, {{}, level.size}, volume.channel_names.size());
}

// Whether the voxels of a box are those of the whole volume of this size, channel by channel.
inline bool is_part_of(const std::vector<std::vector<float>>& whole, const VoxelSource& source,
                       const std::array<int, 3>& size, const VoxelBox& box) {
    const std::vector<std::vector<float>> part = planes_of(source, box, whole.size());
    std::size_t i = 0;
    bool is_equal = true;
    for_each_voxel(box.size, [&](int x, int y, int z) {
        const int row = (box.origin[2] + z) * size[1] + box.origin[1] + y;
        const auto at = static_cast<std::size_t>(row * size[0] + box.origin[0] + x);
        for (std::size_t c = 0; c < whole.size(); ++c) {
            is_equal = is_equal && part[c][i] == whole[c][at];
        }
        ++i;
    });
    return is_equal;
}

// Returns the values of one channel of level 0, without asking for the others.
inline std::vector<float> voxels_of(const Baked& volume, std::size_t channel) {
    const Level& level = volume.levels.front();
    const VoxelBox whole{{}, level.size};
    std::vector<float> values(static_cast<std::size_t>(whole.count()));
    std::vector<float*> targets(volume.channel_names.size(), nullptr);
    targets.at(channel) = values.data();
    level.voxels->fill(whole, targets);
    return values;
}

// A volume of one level that has not been surveyed.
inline Baked plain_volume(const std::array<int, 3>& size, int channels, config::PixelType type,
                          FunctionVoxels::Function function = sample_voxel) {
    Baked volume;
    volume.axes.resize(3);
    volume.name = "shape";
    volume.kind = "noise_volume";
    volume.content = "noise, without unit";
    volume.mapping = "tile";
    volume.axes[0] = {"x", "u = x", "voxel centres at (i + 1/2) / N", 0, 1};
    volume.axes[1] = {"y", "v = y", "voxel centres at (i + 1/2) / N", 0, 1};
    volume.axes[2] = {"z", "w = z", "voxel centres at (i + 1/2) / N", 0, 1};
    volume.channel_names = channel_names(channels);
    volume.pixel_type = type;
    volume.formats = {config::FileFormat::exr};
    volume.voxel_size_m = {25, 25, 25};
    volume.up_axis = "+z";
    volume.levels.resize(1);
    volume.levels[0].size = size;
    volume.levels[0].voxels = std::make_shared<FunctionVoxels>(std::move(function));
    volume.parameters = "[noise.shape]\nseed = 7\n";
    for (AxisMapping& axis : volume.axes) {
        axis.end_points = TexelConvention::end_points_on_edges;
        axis.wrap = AxisWrap::repeat;
    }
    volume.conventions.up_axis = "+z";
    volume.details = {{"baker_version", 1.0}};
    return volume;
}

}  // namespace skybake::testing
