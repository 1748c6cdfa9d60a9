#include "bakers/assets/cloud_volume/frame_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/clouds/cloud_field.h"
#include "bakers/math/quadrature.h"
#include "config/sections/cloud.h"
#include "config/sections/frames.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

constexpr int kBoxes = 512;
constexpr int kEdge = 8;  // of a box, in voxels

VoxelBox box_number(int number, const std::array<int, 3>& size) {
    const std::array<double, 3> place = low_discrepancy_point(number);
    VoxelBox box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.size[i] = std::min(kEdge, size[i]);
        box.origin[i] = static_cast<int>(place[i] * (size[i] - box.size[i] + 1));
    }
    return box;
}

// Returns the first channel of all boxes.
std::vector<float> sampled(const Cloud& cloud, const CloudVolumeBake& bake,
                           const CloudInputs& inputs) {
    const cloud::CloudField field(plan_of_cloud(cloud, inputs, bake.size));
    const auto channels = config::cloud_channel_names(inputs.base, cloud.channels).size();
    std::vector<float> values;
    for (int number = 0; number < kBoxes; ++number) {
        const VoxelBox box = box_number(number, bake.size);
        const auto count = static_cast<std::size_t>(box.count());
        std::vector<float> all(channels * count);
        std::vector<float*> channel;
        for (std::size_t c = 0; c < channels; ++c) channel.push_back(all.data() + c * count);
        field.fill(box, channel);
        values.insert(values.end(), all.begin(), all.begin() + box.count());
    }
    return values;
}

}  // namespace

std::optional<FrameChange> change_to_next_frame(const Parameters& parameters,
                                                const CloudVolumeBake& bake,
                                                const CloudInputs& inputs,
                                                const BakeOptions& options) {
    const Parameters next = config::at_frame(parameters, 2);
    CloudVolumeBake covered = bake;
    covered.cover.reset();
    Facts details;
    Outcome<CloudInputs> following = cloud_inputs(next, covered, details, options);
    if (!following.value) return std::nullopt;
    following.value->coverage = inputs.coverage;
    const Cloud& cloud = cloud_named(parameters, bake.cloud);
    const std::vector<float> before = sampled(cloud, bake, inputs);
    const std::vector<float> after =
        sampled(cloud_named(next, bake.cloud), bake, *following.value);
    const float threshold = filtered_threshold(cloud);
    double cloudy = 0, flips = 0, squares = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const bool was = before[i] > threshold, is = after[i] > threshold;
        if (!was && !is) continue;
        ++cloudy;
        flips += was == is ? 0 : 1;
        const double change = double{after[i]} - double{before[i]};
        squares += change * change;
    }
    if (cloudy == 0) return FrameChange{};
    return FrameChange{flips / cloudy, std::sqrt(squares / cloudy)};
}

}  // namespace skybake
