#include "bakers/clouds/cloud_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "bakers/clouds/height_profile.h"
#include "bakers/noise/noise_bounds.h"
#include "config/sections/cloud_channels.h"

namespace skybake::cloud {

namespace {

using config::Cloud;
using config::CloudChannels;
using config::HeightProfileType;
using config::Noise;
using config::NoiseChannel;
using config::NoiseOctaves;

// R and G of a cloud of several channels carry shape and profile; B and A are for detail (Olajos
// 2016).
constexpr int kShapedChannels = 2;

void scale_frequencies(NoiseOctaves& octaves, const std::array<int, 3>& scale) {
    for (std::array<int, 3>& frequency : octaves.frequencies) {
        for (std::size_t axis = 0; axis < 3; ++axis) frequency[axis] *= scale[axis];
    }
}

SliceShape slice_shape(const Cloud& cloud, bool by_map, double h) {
    SliceShape shape;
    if (by_map) {
        const std::array<double, 3> profiles = classic_profiles(h);
        for (std::size_t i = 0; i < 3; ++i) shape.profile[i] = static_cast<float>(profiles[i]);
    } else {
        shape.profile[0] = static_cast<float>(height_profile(cloud.height_profile, h));
    }
    shape.erosion = static_cast<float>(cloud.erosion[0] * (1 - h) + cloud.erosion[1] * h);
    shape.billow = static_cast<float>(h < cloud.wisp_height ? h / cloud.wisp_height : 1);
    return shape;
}

std::vector<config::Tower> all_towers(const Cloud& cloud) {
    std::vector<config::Tower> towers = cloud.towers;
    const std::vector<config::Tower> scattered = scattered_towers(cloud.scatter);
    towers.insert(towers.end(), scattered.begin(), scattered.end());
    return towers;
}

// The noise's bound as a real number, and room for a kernel's float: the kernels stay within 2e-7
// of their values, shares of 1.
float bound_of(const Noise& base, int shaped_channels) {
    constexpr double kRoom = 1e-5;
    double bound = 0;
    for (int i = 0; i < shaped_channels; ++i) {
        bound = std::max(bound, noise::value_bounds(base, static_cast<std::size_t>(i))[1]);
    }
    return static_cast<float>(bound + kRoom * std::max(1.0, bound));
}

}  // namespace

Noise cloud_noise(const Noise& noise, const std::array<int, 3>& scale, CloudChannels channels) {
    Noise result = noise;
    result.sampling = config::NoiseSampling::centers;
    const auto used = config::used_channels(noise, channels);
    result.channels.assign(used.begin(), used.end());
    for (NoiseChannel& channel : result.channels) {
        scale_frequencies(channel.octaves, scale);
        scale_frequencies(channel.worley_octaves, scale);
    }
    return result;
}

CloudPlan make_cloud_plan(const Cloud& cloud, const Noise& base, const Noise* detail,
                          const std::array<int, 3>& size, CloudMaps maps) {
    using noise::make_noise_plan;
    using noise::NoiseField;
    const Noise shape = cloud_noise(base, cloud.noise_scale, cloud.channels);
    CloudPlan plan;
    plan.size = size;
    plan.towers = TowerField(all_towers(cloud));
    plan.base = std::make_shared<const NoiseField>(make_noise_plan(shape, size));
    plan.channels = plan.base->plan().output_channels();
    plan.shaped_channels = std::min(plan.channels, kShapedChannels);
    plan.noise_bound = bound_of(shape, plan.shaped_channels);
    if (detail != nullptr) {
        const Noise frays = cloud_noise(*detail, cloud.detail_scale, CloudChannels::density);
        plan.detail = std::make_shared<const NoiseField>(make_noise_plan(frays, size));
    }
    plan.coverage = cloud.coverage;
    plan.coverage_map = std::move(maps.coverage);
    plan.type_map = std::move(maps.type);
    for (int z = 0; z < size[2]; ++z) {
        plan.slices.push_back(slice_shape(cloud, plan.type_map.has_value(), (z + 0.5) / size[2]));
    }
    plan.threshold = static_cast<float>(cloud.threshold);
    plan.threshold_in_file = cloud.threshold_at == config::ThresholdAt::bake;
    if (cloud.edge_softness > 0) {
        plan.inverse_softness = static_cast<float>(1 / cloud.edge_softness);
    }
    if (cloud.full_at) plan.inverse_full = static_cast<float>(1 / *cloud.full_at);
    return plan;
}

}  // namespace skybake::cloud
