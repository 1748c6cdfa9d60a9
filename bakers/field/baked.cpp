#include "bakers/field/baked.h"

#include <cassert>
#include <cstddef>

namespace skybake {

void HeldTexels::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    for (std::size_t c = 0; c < channels.size(); ++c) {
        float* out = channels[c];
        if (out == nullptr) continue;
        for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) {
            for (int x = box.origin[0]; x < box.origin[0] + box.size[0]; ++x) {
                *out++ = image_.texel(x, y)[c];
            }
        }
    }
}

const Image2<float>& Baked::image() const {
    assert(is_table() && !levels.empty());
    return static_cast<const HeldTexels&>(*levels.front().voxels).image();
}

void set_files(const config::AssetFiles& files, Baked& baked) {
    static_cast<config::AssetFiles&>(baked) = files;
}

void set_image(Image2<float> image, Baked& table) {
    Level level;
    level.size = {image.width, image.height, 1};
    level.repeats = repeating_axes(table.axes);
    level.nearest = is_looked_up_nearest(table.axes);
    level.voxels = std::make_shared<HeldTexels>(std::move(image));
    table.levels = {std::move(level)};
}

std::array<bool, 3> repeating_axes(const std::vector<AxisMapping>& axes) {
    std::array<bool, 3> repeats{};
    for (std::size_t i = 0; i < axes.size(); ++i) repeats[i] = axes[i].wrap == AxisWrap::repeat;
    return repeats;
}

bool is_looked_up_nearest(const std::vector<AxisMapping>& axes) {
    return !axes.empty() && axes.front().filter == AxisFilter::nearest;
}

}  // namespace skybake
