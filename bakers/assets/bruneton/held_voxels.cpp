#include "bakers/assets/bruneton/held_voxels.h"

#include <algorithm>

namespace skybake {

HeldVoxels::HeldVoxels(const std::array<int, 3>& size, std::size_t channels)
    : size_(size),
      values_(channels, std::vector<float>(static_cast<std::size_t>(VoxelBox{{}, size}.count()))) {}

std::size_t HeldVoxels::offset(int x, int y, int z) const {
    const auto width = static_cast<std::size_t>(size_[0]);
    const auto height = static_cast<std::size_t>(size_[1]);
    return (static_cast<std::size_t>(z) * height + static_cast<std::size_t>(y)) * width +
           static_cast<std::size_t>(x);
}

void HeldVoxels::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    for (std::size_t c = 0; c < channels.size(); ++c) {
        float* target = channels[c];
        if (target == nullptr) continue;
        for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
            for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) {
                target = std::copy_n(values_[c].data() + offset(box.origin[0], y, z), box.size[0],
                                     target);
            }
        }
    }
}

double HeldVoxels::largest(std::size_t channel) const {
    return *std::max_element(values_[channel].begin(), values_[channel].end());
}

}  // namespace skybake
