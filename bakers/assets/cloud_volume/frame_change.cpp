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
    std::vector<float*> channels(
        config::cloud_channel_names(inputs.base, cloud.channels).size());  // null: not wanted
    std::vector<float> values;
    for (int number = 0; number < kBoxes; ++number) {
        const VoxelBox box = box_number(number, bake.size);
        values.resize(values.size() + static_cast<std::size_t>(box.count()));
        channels.front() = values.data() + values.size() - box.count();
        field.fill(box, channels);
    }
    return values;
}

}  // namespace

std::optional<FrameChange> change_to_next_frame(const Parameters& parameters,
                                                const CloudVolumeBake& bake,
                                                const CloudInputs& inputs,
                                                const BakeOptions& options) {
    const Parameters next = config::at_frame(parameters, 2);
    CloudInputs following = inputs;
    if (Facts facts; !take_shape(next, bake, following, facts, options)) return std::nullopt;
    const Cloud& cloud = cloud_named(parameters, bake.cloud);
    const std::vector<float> before = sampled(cloud, bake, inputs);
    const std::vector<float> after = sampled(cloud_named(next, bake.cloud), bake, following);
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
    cloudy = std::max(cloudy, 1.0);  // nothing flips where there is no cloud
    return FrameChange{flips / cloudy, std::sqrt(squares / cloudy)};
}

}  // namespace skybake
