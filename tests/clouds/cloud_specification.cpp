#include "tests/clouds/cloud_specification.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "bakers/clouds/column_field.h"

namespace skybake::cloud {
namespace {

float density(const CloudPlan& plan, float value) {
    const float inside = plan.inverse_full > 0 ? std::min(value * plan.inverse_full, 1.0f) : value;
    if (plan.inverse_softness == 0) return value > plan.threshold ? inside : 0.0f;
    const float x =
        std::min(std::max((value - plan.threshold) * plan.inverse_softness, 0.0f), 1.0f);
    return inside * ((x * x) * (3.0f - 2.0f * x));
}

std::array<int, 3> within_tile(const CloudPlan& plan, const noise::Voxel& voxel) {
    std::array<int, 3> within{};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto size = std::int64_t{plan.size[i]};
        within[i] = static_cast<int>((voxel[i] % size + size) % size);
    }
    within[2] = static_cast<int>(voxel[2]);
    return within;
}

// The voxel whose noise a voxel has.
noise::Voxel head_of(const CloudPlan& plan, const noise::Voxel& voxel) {
    if (plan.fall.empty()) return voxel;
    return {voxel[0] + plan.fall[static_cast<std::size_t>(voxel[2])], voxel[1], plan.size[2] - 1};
}

// n, in all channels. A voxel outside the tile has that of its image within.
std::vector<float> shape_at(const CloudPlan& plan, const noise::Voxel& voxel) {
    if (!plan.volume) return noise_at(plan.base->plan(), head_of(plan, voxel));
    std::vector<float> values(static_cast<std::size_t>(plan.channels));
    std::vector<float*> channels;
    for (float& value : values) channels.push_back(&value);
    plan.fill_shape({within_tile(plan, voxel), {1, 1, 1}}, channels);
    return values;
}

float shaped(const CloudPlan& plan, const SliceShape& slice, const Columns& column, float noise,
             float detail) {
    float profile = slice.profile[0];
    if (plan.type_map) {
        const float second = column.second_type[0] * (slice.profile[1] - slice.profile[0]);
        const float third = column.third_type[0] * (slice.profile[2] - slice.profile[1]);
        profile = (profile + second) + third;
    }
    const float base = noise * std::max(profile + column.towers[0], 0.0f) + column.offset[0];
    if (!(base > plan.level())) return 0;
    float value = base;
    if (plan.detail) {
        const float d = std::min(std::max(detail, 0.0f), 1.0f);
        const float erosion = slice.erosion * (d + slice.billow * (1.0f - 2.0f * d));
        value = std::max((base - erosion) / (1.0f - erosion), 0.0f);
    }
    return plan.threshold_in_file ? density(plan, value) * slice.water : value;
}

}  // namespace

std::vector<float> cloud_at(const CloudPlan& plan, const noise::Voxel& voxel) {
    const Columns column =
        make_columns(plan, static_cast<int>(voxel[0]), 1, static_cast<int>(voxel[1]), 1);
    const SliceShape& slice = plan.slices[static_cast<std::size_t>(voxel[2])];
    std::vector<float> values = shape_at(plan, voxel);
    const float detail =
        plan.detail ? noise_at(plan.detail->plan(), head_of(plan, voxel))[0] : 0.0f;
    for (int i = 0; i < plan.shaped_channels; ++i) {
        float& value = values[static_cast<std::size_t>(i)];
        value = shaped(plan, slice, column, value, detail);
    }
    if (plan.flow && !(values.front() > 0)) values.assign(values.size(), 0.0f);
    return values;
}

}  // namespace skybake::cloud
