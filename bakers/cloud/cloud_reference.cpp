#include "bakers/cloud/cloud_reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bakers/cloud/height_profile.h"
#include "bakers/noise/noise_reference.h"

namespace skybake::cloud {

namespace {

using config::HeightProfileType;
using config::Tower;

// One tower and all its images that are not below e^-40 of it.
double images_of(const Tower& tower, const std::array<double, 2>& place) {
    constexpr double kReach = 9;  // standard deviations; 9^2 / 2 > 40
    const double c = std::cos(tower.rotation.radians);
    const double s = std::sin(tower.rotation.radians);
    const double rho = tower.correlation;
    const double reach = kReach * std::max(tower.sigma[0], tower.sigma[1]);
    const std::array<double, 2> from = {place[0] - tower.center[0], place[1] - tower.center[1]};
    double sum = 0;
    for (double j = std::ceil(from[1] - reach); j <= from[1] + reach; ++j) {
        for (double i = std::ceil(from[0] - reach); i <= from[0] + reach; ++i) {
            const double dx = from[0] - i;
            const double dy = from[1] - j;
            const double a = (c * dx + s * dy) / tower.sigma[0];
            const double b = (c * dy - s * dx) / tower.sigma[1];
            // a^2 - 2 rho a b + b^2 as a sum of squares.
            const double q = b * b + (a - rho * b) * (a - rho * b) / ((1 - rho) * (1 + rho));
            sum += tower.amplitude * std::exp(-q / 2);
        }
    }
    return sum;
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

}  // namespace

double tower_reference(std::span<const Tower> towers, const std::array<double, 2>& place) {
    double sum = 0;
    for (const Tower& tower : towers) sum += images_of(tower, place);
    return sum;
}

double height_profile_reference(const config::HeightProfile& profile, double h) {
    if (profile.type == HeightProfileType::thesis) {
        return -std::expm1(-profile.bottom_sharpness * h) * std::exp(-profile.top_falloff * h);
    }
    if (profile.type == HeightProfileType::blended) return blended(h, profile.cloud_type);
    return height_profile(profile, h);
}

CloudReference::CloudReference(const config::Cloud& cloud, const config::Noise& base,
                               const config::Noise* detail, CloudMaps maps)
    : cloud_(cloud),
      towers_(cloud.towers),
      base_(cloud_noise(base, cloud.noise_scale, cloud.channels)),
      maps_(std::move(maps)) {
    const std::vector<Tower> scattered = scattered_towers(cloud.scatter);
    towers_.insert(towers_.end(), scattered.begin(), scattered.end());
    if (detail != nullptr) {
        detail_ = cloud_noise(*detail, cloud.detail_scale, config::CloudChannels::density);
    }
}

double CloudReference::shaped(const std::array<double, 3>& place, double base_noise) const {
    const auto [x, y, h] = place;
    const double profile = maps_.type ? blended(h, maps_.type->at(x, y))
                                      : height_profile_reference(cloud_.height_profile, h);
    const double coverage = cloud_.coverage * (maps_.coverage ? maps_.coverage->at(x, y) : 1);
    const double base = base_noise * (profile + tower_reference(towers_, {x, y})) - (1 - coverage);
    const bool in_file = cloud_.threshold_at == config::ThresholdAt::bake;
    if (base <= (in_file ? cloud_.threshold : 0)) return 0;
    double value = base;
    if (detail_) {
        const double d = std::clamp(noise::noise_reference(*detail_, place)[0], 0.0, 1.0);
        const double billow = h < cloud_.wisp_height ? h / cloud_.wisp_height : 1;
        const double erosion =
            std::lerp(cloud_.erosion[0], cloud_.erosion[1], h) * std::lerp(d, 1 - d, billow);
        value = std::max(0.0, (base - erosion) / (1 - erosion));
    }
    if (!in_file) return value;
    if (cloud_.edge_softness == 0) return value > cloud_.threshold ? value : 0;
    return value * smooth_step(cloud_.threshold, cloud_.threshold + cloud_.edge_softness, value);
}

std::vector<double> CloudReference::operator()(const std::array<double, 3>& place) const {
    std::vector<double> values = noise::noise_reference(base_, place);
    const std::size_t shaped_channels = std::min<std::size_t>(values.size(), 2);
    for (std::size_t i = 0; i < shaped_channels; ++i) values[i] = shaped(place, values[i]);
    return values;
}

}  // namespace skybake::cloud
