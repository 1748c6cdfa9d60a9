#include "bakers/field/stored_source.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "bakers/math/tiles.h"

namespace skybake {

StoredSource::StoredSource(const VoxelSource& source, const std::array<int, 3>& size, int channels,
                           const BakeOptions& options, std::string_view step)
    : size_(size) {
    const auto slice = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    values_.assign(static_cast<std::size_t>(channels),
                   std::vector<float>(slice * static_cast<std::size_t>(size[2])));
    constexpr int kDepth = 8;
    for_each_tile((size[2] + kDepth - 1) / kDepth, options, step, [&](int tile) {
        const int z = tile * kDepth;
        std::vector<float*> targets;
        for (auto& values : values_) {
            targets.push_back(values.data() + static_cast<std::size_t>(z) * slice);
        }
        source.fill({{0, 0, z}, {size_[0], size_[1], std::min(kDepth, size_[2] - z)}}, targets);
    });
}

void StoredSource::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    const auto width = static_cast<std::size_t>(box.size[0]);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        float* target = channels[c];
        if (target == nullptr) continue;
        for (int z = 0; z < box.size[2]; ++z) {
            for (int y = 0; y < box.size[1]; ++y) {
                const std::size_t row = static_cast<std::size_t>(box.origin[2] + z) *
                                            static_cast<std::size_t>(size_[1]) +
                                        static_cast<std::size_t>(box.origin[1] + y);
                const float* from = values_[c].data() + row * static_cast<std::size_t>(size_[0]) +
                                    static_cast<std::size_t>(box.origin[0]);
                std::memcpy(target, from, width * sizeof(float));
                target += width;
            }
        }
    }
}

}  // namespace skybake
