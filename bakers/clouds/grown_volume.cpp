#include "bakers/clouds/grown_volume.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/math/transcendental.h"
#include "bakers/math/wrapped.h"

namespace skybake::cloud {
namespace {

std::array<float, 4> cubic_weights(double t) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    return {
        static_cast<float>(-0.5 * t + t2 - 0.5 * t3), static_cast<float>(1 - 2.5 * t2 + 1.5 * t3),
        static_cast<float>(0.5 * t + 2 * t2 - 1.5 * t3), static_cast<float>(-0.5 * t2 + 0.5 * t3)};
}

float cubic_between(const std::array<float, 4>& weights, float a, float b, float c, float d) {
    const float value = (weights[0] * a + weights[1] * b) + (weights[2] * c + weights[3] * d);
    return std::clamp(value, std::min(b, c), std::max(b, c));
}

float density_of_water(float water, float full) {
    if (water <= 0) return 0;
    if (water >= full) return 1;
    return static_cast<float>(exponential(2.0 / 3.0 * logarithm(double{water / full})));
}

VoxelBox part_within(const VoxelBox& box, int depth) {
    VoxelBox inside = box;
    inside.origin[2] = std::clamp(box.origin[2], 0, depth);
    inside.size[2] = std::clamp(box.origin[2] + box.size[2], 0, depth) - inside.origin[2];
    return inside;
}

}  // namespace

GrownVolume::GrownVolume(std::shared_ptr<const convection::GrownCloud> cloud,
                         const std::array<int, 3>& size)
    : cloud_(std::move(cloud)), size_(size) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < size[axis]; ++i) {
            const double at = (i + 0.5) * cloud_->cells[axis] / size[axis] - 0.5;
            const double cell = std::floor(at);
            taps_[axis].push_back({static_cast<int>(cell) - 1, cubic_weights(at - cell)});
        }
    }
}

GrownVolume::Cells GrownVolume::cells_of(std::size_t axis, const VoxelBox& box) const {
    const int first = taps_at(axis, box.origin[axis]).first;
    return {first, taps_at(axis, box.origin[axis] + box.size[axis] - 1).first + 4 - first};
}

// Below the base and above the top it goes on as the outermost cells are.
const float* GrownVolume::row(int y, int z) const {
    const auto& cells = cloud_->cells;
    const auto at = static_cast<std::size_t>(std::clamp(z, 0, cells[2] - 1)) *
                        static_cast<std::size_t>(cells[1]) +
                    static_cast<std::size_t>(skybake::wrapped(y, cells[1]));
    return cloud_->water.data() + at * static_cast<std::size_t>(cells[0]);
}

void GrownVolume::along_x(const VoxelBox& box, const float* cells, float* out) const {
    for (int x = 0; x < box.size[0]; ++x) {
        const Taps& taps = taps_at(0, box.origin[0] + x);
        std::array<float, 4> taken;
        for (std::size_t i = 0; i < 4; ++i) {
            taken[i] = cells[skybake::wrapped(taps.first + static_cast<int>(i), cloud_->cells[0])];
        }
        out[x] = cubic_between(taps.weights, taken[0], taken[1], taken[2], taken[3]);
    }
}

void GrownVolume::along(std::size_t axis, const VoxelBox& box, std::size_t width, const float* from,
                        float* out) const {
    const int first = cells_of(axis, box).first;
    for (int i = 0; i < box.size[axis]; ++i) {
        const Taps& taps = taps_at(axis, box.origin[axis] + i);
        const float* a = from + static_cast<std::size_t>(taps.first - first) * width;
        for (std::size_t k = 0; k < width; ++k) {
            *out++ =
                cubic_between(taps.weights, a[k], a[width + k], a[2 * width + k], a[3 * width + k]);
        }
    }
}

void GrownVolume::fill(const VoxelBox& asked, const std::vector<float*>& channels) const {
    float* out = channels.front();
    if (out == nullptr) return;
    std::fill_n(out, asked.count(), 0.0F);
    const VoxelBox box = part_within(asked, size_[2]);
    if (box.count() == 0) return;
    const auto width = static_cast<std::size_t>(box.size[0]);
    const std::size_t plane = width * static_cast<std::size_t>(box.size[1]);
    const Cells rows = cells_of(1, box);
    const Cells slices = cells_of(2, box);
    std::vector<float> slice(width * static_cast<std::size_t>(rows.count));
    std::vector<float> made(plane * static_cast<std::size_t>(slices.count));
    for (int z = 0; z < slices.count; ++z) {
        for (int y = 0; y < rows.count; ++y) {
            along_x(box, row(rows.first + y, slices.first + z),
                    slice.data() + static_cast<std::size_t>(y) * width);
        }
        along(1, box, width, slice.data(), made.data() + static_cast<std::size_t>(z) * plane);
    }
    float* first = out + static_cast<std::size_t>(box.origin[2] - asked.origin[2]) * plane;
    along(2, box, plane, made.data(), first);
    for (std::int64_t i = 0; i < box.count(); ++i) {
        first[i] = density_of_water(first[i], cloud_->full_water);
    }
}

bool GrownVolume::is_empty(const VoxelBox& asked) const {
    const VoxelBox box = part_within(asked, size_[2]);
    if (box.count() == 0) return true;
    const std::array<Cells, 3> cells = {cells_of(0, box), cells_of(1, box), cells_of(2, box)};
    for (int z = 1; z + 1 < cells[2].count; ++z) {  // the outermost cells add no water of their own
        for (int y = 1; y + 1 < cells[1].count; ++y) {
            const float* water = row(cells[1].first + y, cells[2].first + z);
            for (int x = 1; x + 1 < cells[0].count; ++x) {
                if (water[skybake::wrapped(cells[0].first + x, cloud_->cells[0])] > 0) return false;
            }
        }
    }
    return true;
}

CloudVolume volume_of_grown(const std::shared_ptr<const convection::GrownCloud>& grown,
                            const Cloud& cloud, const std::array<int, 3>& size) {
    CloudVolume volume;
    SourceVoxels& source = volume.source;
    for (std::size_t i = 0; i < 3; ++i) {
        source.size[i] = std::max(size[i], grown->cells[i]);
        source.voxel_size_m[i] = cloud.extent[i].meters / source.size[i];
    }
    source.voxels = std::make_shared<const GrownVolume>(grown, source.size);
    source.largest = 1;
    volume.wrap = config::VolumeWrap::repeat;
    return volume;
}

}  // namespace skybake::cloud
