#include "bakers/clouds/cloud_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bakers/clouds/tile_pieces.h"
#include "bakers/math/transcendental.h"
#include "bakers/noise/noise_bounds.h"

namespace skybake::cloud {
namespace {

using config::CloudChannels;
using config::HeightProfileType;

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
    if (cloud.noise.empty()) {
        shape.profile[0] = 1;
    } else if (by_map) {
        const std::array<double, 3> profiles = classic_profiles(h);
        for (std::size_t i = 0; i < 3; ++i) shape.profile[i] = static_cast<float>(profiles[i]);
    } else {
        shape.profile[0] = static_cast<float>(height_profile(cloud.height_profile, h));
    }
    shape.erosion = static_cast<float>(cloud.erosion[0] * (1 - h) + cloud.erosion[1] * h);
    shape.billow = static_cast<float>(h < cloud.wisp_height ? h / cloud.wisp_height : 1);
    if (cloud.water == config::CloudWater::rising) {
        shape.water = static_cast<float>(exponential(2.0 / 3 * logarithm(h)));
    }
    return shape;
}

// A margin for what kernels round.
float with_room(double bound) {
    constexpr double kRoom = 1e-5;
    return static_cast<float>(bound + kRoom * std::max(1.0, bound));
}

// The noise's bound in exact arithmetic, plus a margin for a kernel's float: kernels are within
// 2e-7 of their values, as a share of 1.
float bound_of(const Noise& base, int shaped_channels) {
    double bound = 0;
    for (int i = 0; i < shaped_channels; ++i) {
        bound = std::max(bound, noise::value_bounds(base, static_cast<std::size_t>(i))[1]);
    }
    return with_room(bound);
}

// Fills in all of a plan but what gives its n.
void plan_shape(const Cloud& cloud, const Noise* detail, CloudMaps maps, CloudPlan& plan) {
    plan.towers = TowerField(living_towers(cloud));
    if (detail != nullptr && std::max(cloud.erosion[0], cloud.erosion[1]) > 0) {
        const Noise frays = cloud_noise(*detail, cloud.detail_scale, CloudChannels::density);
        plan.detail =
            std::make_shared<const noise::NoiseField>(noise::make_noise_plan(frays, plan.size));
    }
    plan.coverage = cloud.coverage;
    plan.coverage_map = std::move(maps.coverage);
    plan.type_map = std::move(maps.type);
    for (int z = 0; z < plan.size[2]; ++z) {
        plan.slices.push_back(
            slice_shape(cloud, plan.type_map.has_value(), (z + 0.5) / plan.size[2]));
    }
    plan.threshold = static_cast<float>(cloud.threshold);
    plan.threshold_in_file = cloud.threshold_at == config::ThresholdAt::bake;
    if (cloud.edge_softness > 0) {
        plan.inverse_softness = static_cast<float>(1 / cloud.edge_softness);
    }
    if (cloud.full_at) plan.inverse_full = static_cast<float>(1 / *cloud.full_at);
}

// Fills a box with the noise of its voxels' heads, slice by slice.
void fill_fallen(const CloudPlan& plan, const noise::NoiseField& noise, const VoxelBox& box,
                 const std::vector<float*>& channels) {
    if (plan.fall.empty()) return noise.fill(box, channels);
    const AxisPiece rows{0, box.origin[1], box.size[1]};
    std::vector<std::vector<float>> values(channels.size());
    for (int z = 0; z < box.size[2]; ++z) {
        const VoxelBox slice{box.origin, {box.size[0], box.size[1], 1}};
        const std::int64_t place = slice.count() * z;
        const int first = box.origin[0] + plan.fall[static_cast<std::size_t>(box.origin[2] + z)];
        for (const AxisPiece& columns : wrapped_pieces(first, box.size[0], plan.size[0])) {
            const VoxelBox heads{{columns.source, rows.source, plan.size[2] - 1},
                                 {columns.size, rows.size, 1}};
            std::vector<float*> targets(channels.size(), nullptr);
            for (std::size_t c = 0; c < channels.size(); ++c) {
                values[c].resize(static_cast<std::size_t>(heads.count()));
                if (channels[c] != nullptr) targets[c] = values[c].data();
            }
            noise.fill(heads, targets);
            for (std::size_t c = 0; c < channels.size(); ++c) {
                if (channels[c] == nullptr) continue;
                copy_piece(slice, columns, rows, targets[c], channels[c] + place);
            }
        }
    }
}

std::vector<int> fall_of(const Cloud& cloud, const std::array<int, 3>& size) {
    std::vector<int> fall;
    if (cloud.streaks.meters == 0) return fall;
    const double voxels = cloud.streaks.meters / cloud.extent[0].meters * size[0];
    for (int z = 0; z < size[2]; ++z) {
        const double below = 1 - (z + 0.5) / size[2];
        fall.push_back(static_cast<int>(std::llround(voxels * below * below) % size[0]));
    }
    return fall;
}

using config::HeightPoint;

// The heights at which a type begins, is full, begins to thin, and ends.
struct Heights {
    double begin, full, thin, end;
};
constexpr std::array<Heights, 3> kClassicHeights = {
    {{0.02, 0.05, 0.09, 0.11}, {0.02, 0.2, 0.48, 0.625}, {0.01, 0.0625, 0.78, 1.0}}};

double smooth_ramp(double from, double to, double h) {
    const double x = std::clamp((h - from) / (to - from), 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

double classic_profile(const Heights& heights, double h) {
    return smooth_ramp(heights.begin, heights.full, h) *
           (1 - smooth_ramp(heights.thin, heights.end, h));
}

// Returns 1 - e^-x for x >= 0 without cancellation: the rounding errors of e^-x = u and of ln u are
// the same and cancel (Kahan's method; Higham 2002, Accuracy and Stability of Numerical Algorithms,
// section 1.14.1).
double one_minus_exponential(double x) {
    const double u = exponential(-x);
    if (u == 1) return x;
    if (u < 0.5) return 1 - u;
    return (1 - u) * x / -logarithm(u);
}

double tabulated(const std::vector<HeightPoint>& table, double h) {
    const auto above = std::ranges::upper_bound(table, h, {}, &HeightPoint::height);
    if (above == table.begin()) return table.front().value;
    if (above == table.end()) return table.back().value;
    const HeightPoint& low = *(above - 1);
    const double t = (h - low.height) / (above->height - low.height);
    return low.value * (1 - t) + above->value * t;
}

using config::MapFilter;
using config::MapWrap;

// The coordinate within the picture.
double wrapped(double coordinate, MapWrap wrap) {
    if (wrap == MapWrap::clamp) return std::clamp(coordinate, 0.0, 1.0);
    return coordinate - std::floor(coordinate);  // [0, 1]: 1 - 1e-20 rounds to 1
}

// `within` as of wrapped(): 1 is the far edge of the last pixel.
int nearest_pixel(double within, int size) {
    return std::min(static_cast<int>(within * size), size - 1);
}

// The two pixels around a place on one axis, and the place's distance from the first, in [0, 1) of
// the distance to the second.
struct Neighbours {
    int first = 0;
    int second = 0;
    double fraction = 0;
};

Neighbours neighbours(double within, int size, MapWrap wrap) {
    const double position = within * size - 0.5;
    const double below = std::floor(position);
    const int first = static_cast<int>(below);  // -1 to size - 1
    const int second = first + 1;
    const double fraction = position - below;
    if (wrap == MapWrap::clamp) return {std::max(first, 0), std::min(second, size - 1), fraction};
    return {first < 0 ? size - 1 : first, second == size ? 0 : second, fraction};
}

// In this form equal ends give exactly their value, and rounding leads beyond neither end: b - a
// may round up by half an ulp, but its product with a fraction below 1 is then rounded to less than
// b - a itself.
double mixed(double a, double b, double fraction) { return a + (b - a) * fraction; }

}  // namespace

void CloudPlan::fill_shape(const VoxelBox& box, const std::vector<float*>& values) const {
    if (volume) {
        if (values.front() != nullptr) volume->fill(box, {values.front()});
        if (flow) flow->fill(box, {values.begin() + 1, values.end()});
        return;
    }
    fill_fallen(*this, *base, box, values);
}

void CloudPlan::fill_detail(const VoxelBox& box, float* values) const {
    fill_fallen(*this, *detail, box, {values});
}

Noise cloud_noise(const Noise& noise, const std::array<int, 3>& scale, CloudChannels channels) {
    Noise result = noise;
    result.sampling = config::NoiseSampling::centers;
    result.repeats = scale;
    const auto used = config::used_channels(noise, channels);
    result.channels.assign(used.begin(), used.end());
    for (NoiseChannel& channel : result.channels) {
        scale_frequencies(channel.octaves, scale);
        scale_frequencies(channel.worley_octaves, scale);
        scale_frequencies(channel.warp_octaves, scale);
    }
    return result;
}

CloudPlan make_cloud_plan(const Cloud& cloud, const Noise& base, const Noise* detail,
                          const std::array<int, 3>& size, CloudMaps maps) {
    assert(size[0] >= 1 && size[1] >= 1 && size[2] >= 1);
    const Noise shape = cloud_noise(base, cloud.noise_scale, cloud.channels);
    CloudPlan plan;
    plan.size = size;
    plan.base = std::make_shared<const noise::NoiseField>(noise::make_noise_plan(shape, size));
    plan.fall = fall_of(cloud, size);
    plan.channels = plan.base->plan().output_channels();
    plan.shaped_channels = std::min(plan.channels, kShapedChannels);
    plan.noise_bound = bound_of(shape, plan.shaped_channels);
    plan_shape(cloud, detail, std::move(maps), plan);
    return plan;
}

CloudPlan make_cloud_plan(const Cloud& cloud, const CloudVolume& volume, const Noise* detail,
                          const std::array<int, 3>& size, CloudMaps maps) {
    assert(size[0] >= 1 && size[1] >= 1 && size[2] >= 1);
    CloudPlan plan;
    plan.size = size;
    plan.volume = std::make_shared<const ResampledVolume>(volume, size);
    plan.noise_bound = with_room(double{plan.volume->largest()});
    if (volume.flow) {
        plan.flow = std::make_shared<const FlowField>(volume.flow, size);
        plan.channels = 4;
    }
    plan_shape(cloud, detail, std::move(maps), plan);
    return plan;
}

std::array<double, 3> classic_profiles(double h) {
    std::array<double, 3> values;
    for (std::size_t i = 0; i < 3; ++i) values[i] = classic_profile(kClassicHeights[i], h);
    return values;
}

std::array<double, 3> type_weights(double cloud_type) {
    const double to_second = std::min(2 * cloud_type, 1.0);
    const double to_third = std::max(2 * cloud_type - 1, 0.0);
    return {1 - to_second, to_second - to_third, to_third};
}

double height_profile(const config::HeightProfile& profile, double h) {
    const auto classic = [&](std::size_t type) { return classic_profiles(h)[type]; };
    switch (profile.type) {
        case HeightProfileType::thesis:
            return one_minus_exponential(profile.bottom_sharpness * h) *
                   exponential(-profile.top_falloff * h);
        case HeightProfileType::stratus:
            return classic(0);
        case HeightProfileType::stratocumulus:
            return classic(1);
        case HeightProfileType::cumulus:
            return classic(2);
        case HeightProfileType::tabulated:
            return tabulated(profile.table, h);
        case HeightProfileType::blended:
            break;
    }
    const std::array<double, 3> values = classic_profiles(h);
    const std::array<double, 3> weights = type_weights(profile.cloud_type);
    return values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2];
}

MapLookup::MapLookup(MapImage image, MapWrap wrap, MapFilter filter)
    : image_(std::make_shared<const MapImage>(std::move(image))), wrap_(wrap), filter_(filter) {}

double MapLookup::pixel(int x, int y) const {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(image_->width);
    return double{image_->values[row + static_cast<std::size_t>(x)]};
}

double MapLookup::at(double u, double v) const {
    const double x = wrapped(u, wrap_);
    const double y = wrapped(v, wrap_);
    if (filter_ == MapFilter::nearest) {
        return pixel(nearest_pixel(x, image_->width), nearest_pixel(y, image_->height));
    }
    const Neighbours columns = neighbours(x, image_->width, wrap_);
    const Neighbours rows = neighbours(y, image_->height, wrap_);
    const double upper = mixed(pixel(columns.first, rows.first), pixel(columns.second, rows.first),
                               columns.fraction);
    const double lower = mixed(pixel(columns.first, rows.second),
                               pixel(columns.second, rows.second), columns.fraction);
    return mixed(upper, lower, rows.fraction);
}

}  // namespace skybake::cloud
