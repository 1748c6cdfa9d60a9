#include "bakers/clouds/flow_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bakers/field/interpolation.h"
#include "bakers/math/wrapped.h"

namespace skybake::cloud {
namespace {

// Returns a cell of an axis, which repeats but along z.
std::size_t cell_within(std::size_t axis, int cell, int cells) {
    return static_cast<std::size_t>(axis == 2 ? std::clamp(cell, 0, cells - 1)
                                              : skybake::wrapped(cell, cells));
}

}  // namespace

FlowField::FlowField(std::shared_ptr<const convection::GrownCloud> cloud,
                     const std::array<int, 3>& size)
    : cloud_(std::move(cloud)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int cells = cloud_->cells[axis];
        for (int i = 0; i < size[axis]; ++i) {
            const double at = (i + 0.5) * cells / size[axis] - 0.5;
            const int below = static_cast<int>(std::floor(at));
            taps_[axis].push_back({cell_within(axis, below, cells),
                                   cell_within(axis, below + 1, cells),
                                   static_cast<float>(at - below)});
        }
    }
}

void FlowField::fill_row(const float* velocity, int first, int y, int z, int count,
                         float* out) const {
    const auto width = static_cast<std::size_t>(cloud_->cells[0]);
    const std::size_t plane = width * static_cast<std::size_t>(cloud_->cells[1]);
    const Taps& along_y = taps_at(1, y);
    const Taps& along_z = taps_at(2, z);
    const float* lower = velocity + along_z.first * plane;
    const float* upper = velocity + along_z.second * plane;
    const auto between = [](float a, float b, float fraction) { return a + (b - a) * fraction; };
    for (int i = 0; i < count; ++i) {
        const Taps& along_x = taps_at(0, first + i);
        const auto at_row = [&](const float* row) {
            return between(row[along_x.first], row[along_x.second], along_x.fraction);
        };
        const auto at_level = [&](const float* level) {
            return between(at_row(level + along_y.first * width),
                           at_row(level + along_y.second * width), along_y.fraction);
        };
        out[i] = between(at_level(lower), at_level(upper), along_z.fraction);
    }
}

void FlowField::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    const auto [first_x, first_y, first_z] = box.origin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (channels[axis] == nullptr) continue;
        const float* velocity = cloud_->velocity.data() + axis * cloud_->water.size();
        float* out = channels[axis];
        for (int z = first_z; z < first_z + box.size[2]; ++z) {
            for (int y = first_y; y < first_y + box.size[1]; ++y, out += box.size[0]) {
                fill_row(velocity, first_x, y, z, box.size[0], out);
            }
        }
    }
}

std::array<double, 3> flow_reference(const convection::GrownCloud& cloud,
                                     const std::array<double, 3>& place) {
    std::array<double, 3> velocity{};
    for (const auto& [voxel, weight] : trilinear_taps(cloud.cells, place, {true, true, false})) {
        const std::int64_t row = std::int64_t{voxel[2]} * cloud.cells[1] + voxel[1];
        const auto cell = static_cast<std::size_t>(row * cloud.cells[0] + voxel[0]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            velocity[axis] += weight * double{cloud.velocity[axis * cloud.water.size() + cell]};
        }
    }
    return velocity;
}

}  // namespace skybake::cloud
