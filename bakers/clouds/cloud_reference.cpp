#include "bakers/clouds/cloud_reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "bakers/clouds/flow_field.h"
#include "bakers/clouds/resampled_volume.h"
#include "bakers/clouds/tower_field.h"
#include "bakers/math/transcendental.h"
#include "bakers/noise/noise_reference.h"

namespace skybake::cloud {
namespace {

// A voxel of the source along an axis, and its share.
struct Share {
    int voxel = 0;
    double weight = 0;
};

// `at` is the place in voxels of the source, of which an axis has `from`, and its result `to`.
std::vector<Share> shares_of(double at, int from, int to) {
    if (to >= from) {
        const double below = std::floor(at - 0.5);
        const double fraction = at - 0.5 - below;
        const int voxel = static_cast<int>(below);
        return {{voxel, 1 - fraction}, {voxel + 1, fraction}};
    }
    const double width = static_cast<double>(from) / to;
    const double begin = at - width / 2;
    const double end = at + width / 2;
    std::vector<Share> shares;
    for (double voxel = std::floor(begin); voxel < end; ++voxel) {
        const double shared = std::min(end, voxel + 1) - std::max(begin, voxel);
        shares.push_back({static_cast<int>(voxel), shared / width});
    }
    return shares;
}

int modulo(int voxel, int period) { return (voxel % period + period) % period; }

}  // namespace

VolumeReference::VolumeReference(CloudVolume volume, const std::array<int, 3>& size)
    : volume_(std::move(volume)), size_(size) {}

bool VolumeReference::is_expensive() const {
    constexpr double most_voxels = 4000;
    double voxels = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        voxels *= std::max(1.0, static_cast<double>(volume_.source.size[i]) / size_[i]);
    }
    return voxels > most_voxels;
}

double VolumeReference::operator()(const std::array<double, 3>& place) const {
    const std::array<int, 3>& size = volume_.source.size;
    std::array<std::vector<Share>, 3> shares;
    for (std::size_t i = 0; i < 3; ++i) {
        shares[i] = shares_of(place[i] * size[i], size[i], size_[i]);
        if (i == 2 || volume_.wrap == config::VolumeWrap::empty) continue;
        for (Share& share : shares[i]) share.voxel = modulo(share.voxel, size[i]);
    }
    double sum = 0;
    for (const Share& z : shares[2]) {
        for (const Share& y : shares[1]) {
            for (const Share& x : shares[0]) {
                float value = 0;
                volume_.source.voxels->fill({{x.voxel, y.voxel, z.voxel}, {1, 1, 1}}, {&value});
                sum += x.weight * y.weight * z.weight * double{value};
            }
        }
    }
    return sum;
}

namespace {

using config::HeightProfileType;
using config::Tower;

// How far sums go: terms beyond are below e^-40 of the greatest.
constexpr double kReach = 9;  // standard deviations; 9^2 / 2 > 40

// The covariance of a tower's Gaussian along x and y.
struct Covariance {
    double xx = 0, xy = 0, yy = 0;
    double determinant = 0;
};

Covariance covariance_of(const Tower& tower) {
    const auto [s, c] = sine_and_cosine(tower.rotation.radians);
    const double rho = tower.correlation;
    const double u = tower.sigma[0];
    const double v = tower.sigma[1];
    return {c * c * u * u - 2 * c * s * rho * u * v + s * s * v * v,
            c * s * (u * u - v * v) + (c * c - s * s) * rho * u * v,
            s * s * u * u + 2 * c * s * rho * u * v + c * c * v * v,
            u * u * v * v * (1 - rho) * (1 + rho)};
}

// Calls term(i, j) for the integers i, j within `reach` standard deviations of `center` by a
// covariance.
template <class Term>
double sum_within(const Covariance& c, double reach, const std::array<double, 2>& center,
                  const Term& term) {
    double sum = 0;
    const double rows = reach * std::sqrt(c.yy);
    const double columns = reach * std::sqrt(c.determinant / c.yy);
    for (double j = std::ceil(center[1] - rows); j <= center[1] + rows; ++j) {
        const double middle = center[0] + c.xy / c.yy * (j - center[1]);
        for (double i = std::ceil(middle - columns); i <= middle + columns; ++i) sum += term(i, j);
    }
    return sum;
}

// One tower and its images: the field of tower_field.h. Few images make up a narrow tower, few
// waves a wide one: where the covariance's determinant is 1, both are an area of 81 pi.
double images_of(const Tower& tower, const std::array<double, 2>& place) {
    const Covariance c = covariance_of(tower);
    const std::array<double, 2> from = {place[0] - tower.center[0], place[1] - tower.center[1]};
    if (c.determinant < 1) {
        return sum_within(c, kReach, from, [&](double i, double j) {
            const double x = from[0] - i;
            const double y = from[1] - j;
            const double across = x - c.xy / c.yy * y;
            return tower.amplitude *
                   exponential(-(y * y / c.yy + across * across * c.yy / c.determinant) / 2);
        });
    }
    // Waves have the inverse of the covariance, over (2 pi)^2.
    const double pi = std::numbers::pi;
    const double square = 4 * pi * pi;
    const Covariance waves = {c.yy / c.determinant / square, -c.xy / c.determinant / square,
                              c.xx / c.determinant / square, 1 / (c.determinant * square * square)};
    const double scale = 2 * pi * std::sqrt(c.determinant) * tower.amplitude;
    return sum_within(waves, kReach, {0, 0}, [&](double i, double j) {
        const double q = c.xx * i * i + 2 * c.xy * i * j + c.yy * j * j;
        return scale * exponential(-2 * pi * pi * q) * cosine_of_turns(i * from[0] + j * from[1]);
    });
}

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double blended(double h, double type) {
    const std::array<double, 3> profiles = classic_profiles(h);
    return type < 0.5 ? std::lerp(profiles[0], profiles[1], 2 * type)
                      : std::lerp(profiles[1], profiles[2], 2 * type - 1);
}

// The towers' field at a place of the ground plan, in units of tiles.
double tower_reference(const std::vector<Tower>& towers, const std::array<double, 2>& place) {
    double sum = 0;
    for (const Tower& tower : towers) sum += images_of(tower, place);
    return sum;
}

}  // namespace

double height_profile_reference(const config::HeightProfile& profile, double h) {
    if (profile.type == HeightProfileType::thesis) {
        return (1 - exponential(-profile.bottom_sharpness * h)) *
               exponential(-profile.top_falloff * h);
    }
    if (profile.type == HeightProfileType::blended) return blended(h, profile.cloud_type);
    return height_profile(profile, h);
}

CloudReference::CloudReference(const Cloud& cloud, const Noise& base, const Noise* detail,
                               const std::array<int, 3>& size, CloudMaps maps)
    : CloudReference(cloud, detail, size, std::move(maps)) {
    base_ = cloud_noise(base, cloud.noise_scale, cloud.channels);
}

CloudReference::CloudReference(const Cloud& cloud, const CloudVolume& volume, const Noise* detail,
                               const std::array<int, 3>& size, CloudMaps maps)
    : CloudReference(cloud, detail, size, std::move(maps)) {
    volume_.emplace(volume, size);
    flow_ = volume.flow;
}

CloudReference::CloudReference(const Cloud& cloud, const Noise* detail,
                               const std::array<int, 3>& size, CloudMaps maps)
    : cloud_(cloud), size_(size), towers_(living_towers(cloud)), maps_(std::move(maps)) {
    if (detail != nullptr) {
        detail_ = cloud_noise(*detail, cloud.detail_scale, config::CloudChannels::density);
    }
}

// The place of the head from which ice has fallen to a place, in whole voxels.
std::array<double, 3> CloudReference::noise_place(const std::array<double, 3>& place) const {
    const double streaks = cloud_.streaks.meters / cloud_.extent[0].meters;
    if (streaks == 0) return place;
    const double trailed = std::round(streaks * size_[0] * (1 - place[2]) * (1 - place[2]));
    return {place[0] + trailed / size_[0], place[1], 1 - 0.5 / size_[2]};
}

double CloudReference::profile_at(double x, double y, double h) const {
    if (volume_) return 1;
    return maps_.type ? blended(h, maps_.type->at(x, y))
                      : height_profile_reference(cloud_.height_profile, h);
}

double CloudReference::shaped(const std::array<double, 3>& place, double base_noise) const {
    const auto [x, y, h] = place;
    const double profile = profile_at(x, y, h);
    const double coverage = cloud_.coverage * (maps_.coverage ? maps_.coverage->at(x, y) : 1);
    const double towers = tower_reference(towers_, {x, y});
    const double base = base_noise * std::fmax(profile + towers, 0) - (1 - coverage);
    const bool in_file = cloud_.threshold_at == config::ThresholdAt::bake;
    if (base <= (in_file ? cloud_.threshold : 0)) return 0;
    double value = base;
    if (detail_) {
        const double d =
            std::clamp(noise::noise_reference(*detail_, noise_place(place))[0], 0.0, 1.0);
        const double billow = h < cloud_.wisp_height ? h / cloud_.wisp_height : 1;
        const double erosion =
            std::lerp(cloud_.erosion[0], cloud_.erosion[1], h) * std::lerp(d, 1 - d, billow);
        value = std::max(0.0, (base - erosion) / (1 - erosion));
    }
    if (!in_file) return value;
    const double full = cloud_.full_at ? std::fmin(value / *cloud_.full_at, 1) : value;
    const bool is_even = cloud_.water == config::CloudWater::even;
    const double water = h > 0 ? exponential(2.0 / 3 * logarithm(h)) : 0;
    const double inside = is_even ? full : full * water;
    if (cloud_.edge_softness == 0) return value > cloud_.threshold ? inside : 0;
    return inside * smooth_step(cloud_.threshold, cloud_.threshold + cloud_.edge_softness, value);
}

bool CloudReference::is_expensive() const {
    constexpr std::size_t kTowers = 300;  // take some microseconds each
    return towers_.size() > kTowers || (volume_ && volume_->is_expensive());
}

std::vector<double> CloudReference::operator()(const std::array<double, 3>& place) const {
    std::vector<double> values = base_ ? noise::noise_reference(*base_, noise_place(place))
                                       : std::vector<double>{(*volume_)(place)};
    const std::size_t shaped_channels = std::min<std::size_t>(values.size(), 2);
    for (std::size_t i = 0; i < shaped_channels; ++i) values[i] = shaped(place, values[i]);
    if (!flow_) return values;
    // The rounding of the place lets a voxel take so much of its neighbour.
    constexpr double kRounding = 1e-12;
    const bool is_cloud = values.front() > kRounding;
    for (const double velocity : flow_reference(*flow_, place)) {
        values.push_back(is_cloud ? velocity : 0);
    }
    return values;
}

}  // namespace skybake::cloud
