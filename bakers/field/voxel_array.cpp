#include "bakers/field/voxel_array.h"

#include <algorithm>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"

namespace skybake {

VoxelArray::VoxelArray(const std::array<int, 3>& size, std::size_t channels)
    : size_(size),
      values_(channels, std::vector<float>(static_cast<std::size_t>(VoxelBox{{}, size}.count()))) {}

std::size_t VoxelArray::offset(int x, int y, int z) const {
    const auto width = static_cast<std::size_t>(size_[0]);
    const auto height = static_cast<std::size_t>(size_[1]);
    return (static_cast<std::size_t>(z) * height + static_cast<std::size_t>(y)) * width +
           static_cast<std::size_t>(x);
}

void VoxelArray::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    fill_rows(box, channels, [&](std::size_t c, int y, int z, float* out) {
        std::copy_n(values_[c].data() + offset(box.origin[0], y, z), box.size[0], out);
    });
}

double VoxelArray::largest(std::size_t channel) const {
    return *std::ranges::max_element(values_[channel]);
}

std::vector<std::array<double, 2>> VoxelArray::ranges() const {
    std::vector<std::array<double, 2>> ranges;
    for (std::size_t c = 0; c < channels(); ++c) {
        ranges.push_back({0, largest(c) > 0 ? largest(c) : 1});
    }
    return ranges;
}

VoxelArray read_voxels(const VoxelSource& source, const std::array<int, 3>& size, int channels,
                       const BakeOptions& options, std::string_view step) {
    VoxelArray array(size, static_cast<std::size_t>(channels));
    // One after the other, the voxels of these boxes are those of the volume.
    const BoxSequence boxes(size, channels);
    for_each_tile(boxes.count(), options, step, [&](int tile) {
        const VoxelBox box = boxes[tile];
        const std::size_t first = array.offset(box.origin[0], box.origin[1], box.origin[2]);
        std::vector<float*> targets;
        for (std::size_t c = 0; c < array.channels(); ++c) {
            targets.push_back(array.channel(c).data() + first);
        }
        source.fill(box, targets);
    });
    return array;
}

void read_channel(const Baked& volume, std::size_t channel, const BakeOptions& options, float* to) {
    const Level& level = volume.levels.front();
    const VoxelBox slice = {{}, {level.size[0], level.size[1], 1}};
    for_each_tile(level.size[2], options, "voxels", [&](int z) {
        float* const out = to + z * slice.count();
        std::vector<float*> channels(volume.channel_names.size(), nullptr);
        channels[channel] = out;
        level.voxels->fill({{0, 0, z}, slice.size}, channels);
        round_values(out, static_cast<std::size_t>(slice.count()), volume.pixel_type);
    });
}

}  // namespace skybake
