#include "bakers/field/baked.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "bakers/math/parallel.h"

namespace skybake {

void DenseTexels::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    fill_rows(box, channels, [&](std::size_t c, int y, int, float* out) {
        for (int x = 0; x < box.size[0]; ++x) out[x] = image_.texel(box.origin[0] + x, y)[c];
    });
}

const Image2<float>& Baked::image() const {
    assert(is_table() && !levels.empty());
    return static_cast<const DenseTexels&>(*levels.front().voxels).image();
}

void set_files(const config::AssetFiles& files, Baked& baked) {
    static_cast<config::AssetFiles&>(baked) = files;
}

void set_image(Image2<float> image, Baked& table) {
    Level level;
    level.size = {image.width, image.height, 1};
    level.repeats = repeating_axes(table.axes);
    level.nearest = is_looked_up_nearest(table.axes);
    level.voxels = std::make_shared<DenseTexels>(std::move(image));
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

namespace {

std::int64_t divided_up(std::int64_t count, std::int64_t by) { return (count + by - 1) / by; }

}  // namespace

BoxSequence::BoxSequence(std::array<int, 3> size, int channels, int columns) : size_(size) {
    const std::int64_t row = std::int64_t{size[0]} * channels * columns;
    const std::int64_t group = row * size[1];
    // There are about sixteen boxes or more for the threads to share, but no box is so small that
    // its set-up would cost noticeable time.
    constexpr std::int64_t kFewestFloats = 1 << 18;
    const std::int64_t floats = row / columns * size[1] * size[2];
    const std::int64_t budget = std::clamp(floats / 16, kFewestFloats, kFloats);
    depth_ = columns;
    rows_ = size[1];
    if (group <= budget) {
        const std::int64_t wanted = budget / group * columns;
        depth_ = static_cast<int>(
            std::min<std::int64_t>(wanted, divided_up(size[2], columns) * columns));
    } else {
        rows_ = static_cast<int>(std::max<std::int64_t>(1, budget / row));
    }
    groups_ = static_cast<int>(divided_up(size[2], depth_));
    parts_ = static_cast<int>(divided_up(size[1], rows_));
}

VoxelBox BoxSequence::operator[](int index) const {
    const int y = index % parts_ * rows_;
    const int z = index / parts_ * depth_;
    return {{0, y, z}, {size_[0], std::min(rows_, size_[1] - y), std::min(depth_, size_[2] - z)}};
}

std::int64_t BoxSequence::largest_count() const {
    return std::int64_t{size_[0]} * rows_ * std::min(depth_, size_[2]);
}

int box_slots(int threads) {
    constexpr int kMost = 24;
    return std::min(thread_count(threads) + 2, kMost);
}

}  // namespace skybake
