#include "bakers/march/layer_march.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/march/sun_leaps.h"

namespace skybake {

// The pattern is that of Jimenez 2014. Other layers are the same pattern, moved by an irrational
// number of pixels.
float gradient_noise(int x, int y, int layer) {
    const auto fraction = [](double v) { return v - std::floor(v); };
    const double moved = 5.588238 * layer;
    const double slope = 0.06711056 * (x + moved) + 0.00583715 * (y + moved);
    return static_cast<float>(fraction(52.9829189 * fraction(slope)));
}

RaySpan span_in_layer(const CloudMedium& medium, const glm::dvec3& position_m,
                      const glm::dvec3& direction, double reach_m) {
    RaySpan span{0, reach_m};
    if (direction.z < 0 && position_m.z >= 0) {  // the ground
        span.last_m = std::min(reach_m, -position_m.z / direction.z);
    }
    for (std::size_t a = medium.repeats ? 2 : 0; a < 3; ++a) {
        const double low = (a == 2 ? medium.base_m : 0) - position_m[a];
        const double high = low + medium.extent_m[a];
        const double slope = direction[a];
        if (slope == 0) {
            if (low > 0 || high < 0) return {1, 0};
            continue;
        }
        span.first_m = std::max(span.first_m, (slope > 0 ? low : high) / slope);
        span.last_m = std::min(span.last_m, (slope > 0 ? high : low) / slope);
    }
    return span;
}

void set_layer_ray(const CloudMarch& march, const LayerRay& ray, double reach_m, RayBlock& block,
                   std::size_t i) {
    const CloudMedium& medium = *march.medium;
    const RaySpan span = span_in_layer(medium, ray.position_m, ray.direction, reach_m);
    for (std::size_t a = 0; a < 3; ++a) {
        block.direction[a][i] = static_cast<float>(ray.direction[a] / medium.meters_per_voxel(a));
    }
    block.sun_offset[i] = static_cast<float>(ray.sun_offset);
    block.jitter[i] = ray.jitter;
    block.light_jitter[i] = ray.light_jitter;
    block.first[i] = 0;
    block.end[i] = 0;
    if (span.first_m > span.last_m) return;  // no samples
    // The u of cloud_rays.h at a distance.
    const auto samples_to = [&](double distance_m) {
        const double even = distance_m / double{march.step_m};
        return 2 * even / (1 + std::sqrt(1 + 4 * double{march.growth} * even));
    };
    // One sample is added on each side; the march checks whether samples are inside.
    block.first[i] = static_cast<float>(std::max(std::floor(samples_to(span.first_m)) - 1, 0.0));
    block.end[i] = static_cast<float>(std::ceil(samples_to(span.last_m)) + 1);
}

double sun_march_length_m(const CloudMedium& medium, const SunDirection& sun) {
    const double x = medium.extent_m[0];
    const double y = medium.extent_m[1];
    const double longest = medium.repeats ? std::max(x, y) : std::sqrt(x * x + y * y);
    const double slope = std::fabs(sine_of_degrees(sun.elevation_degrees));
    return slope * longest > medium.extent_m[2] ? medium.extent_m[2] / slope : longest;
}

double voxel_edge_m(const CloudMedium& medium) {
    return exponential(logarithm(medium.meters_per_voxel(0) * medium.meters_per_voxel(1) *
                                 medium.meters_per_voxel(2)) /
                       3);
}

double farthest_reach_m(const CloudMedium& medium) {
    return 256 * std::max(medium.extent_m[0], medium.extent_m[1]);
}

double reach_m_from(const CloudMedium& medium, double altitude_m) {
    const double height_m = std::fabs(medium.base_m + 0.5 * medium.extent_m[2] - altitude_m);
    return std::max(usual_steps(medium, {}).reach_m,
                    std::min(height_m / sine_of_degrees(kEndElevation), farthest_reach_m(medium)));
}

MarchSteps usual_steps(const CloudMedium& medium, const SunDirection& sun) {
    MarchSteps steps;
    const double edge_m = voxel_edge_m(medium);
    const bool deep = medium.optics.extinction_per_m * edge_m > kDeepVoxel;
    steps.step_m = deep ? edge_m / 2 : edge_m;
    steps.light_step_m = std::max(edge_m, sun_march_length_m(medium, sun) / kSunSamples);
    const double tile = std::max(medium.extent_m[0], medium.extent_m[1]);
    steps.reach_m = std::min(std::max(24 * tile, 40e3), farthest_reach_m(medium));
    return steps;
}

MarchSteps picture_steps(const CloudMedium& medium, const SunDirection& sun) {
    MarchSteps steps = usual_steps(medium, sun);
    const double depth = medium.optics.extinction_per_m * voxel_edge_m(medium);
    const double longer = depth < kThinVoxel / 2 ? 2 : std::max(kThinVoxel / depth, 1.0);
    steps.step_m *= longer;
    steps.light_step_m *= kLongerSunStep * longer;
    return steps;
}

CloudMarch march_through(const CloudMedium& medium, const MarchSteps& steps,
                         const DiffuseShare& diffuse, const LightInCloud* solved,
                         const SunDirection& sun, int threads) {
    CloudMarch march;
    march.medium = &medium;
    march.diffuse = &diffuse;
    march.solved = solved;
    march.octaves = octave_phases(cloud_phase(medium.optics.particles));
    march.step_m = static_cast<float>(steps.step_m);
    march.light_step_m = static_cast<float>(steps.light_step_m);
    if (medium.repeats) {
        march.fade_from_m = static_cast<float>(kFadeFrom * steps.reach_m);
        march.fade_to_m = static_cast<float>(steps.reach_m);
    }
    const glm::dvec3 direction = direction_of(sun.elevation_degrees, sun.azimuth_degrees);
    glm::dvec3 light_step{};  // in voxels
    for (std::size_t a = 0; a < 3; ++a) {
        march.light_direction[a] = static_cast<float>(direction[a] / medium.meters_per_voxel(a));
        light_step[a] = double{march.light_step_m} * double{march.light_direction[a]};
    }
    if (steps.sunlit) {
        march.light_samples =
            static_cast<float>(std::ceil(sun_march_length_m(medium, sun) / steps.light_step_m));
    }
    march.leaping = steps.leaping;
    if (steps.leaping && !medium.variation.varies()) {
        march.sun_leaps = sun_leaps(medium.leaps, medium.volume.size, light_step,
                                    static_cast<int>(march.light_samples), threads);
    }
    return march;
}

void set_origin(const glm::dvec3& position_m, CloudMarch& march) {
    const CloudMedium& medium = *march.medium;
    for (std::size_t a = 0; a < 3; ++a) {
        const double origin = position_m[a] - (a == 2 ? medium.base_m : 0);
        march.origin[a] = static_cast<float>(origin / medium.meters_per_voxel(a));
    }
}

LayerMarch::LayerMarch(std::vector<Layer> layers, const glm::dvec3& position_m,
                       const SunDirection& sun, int threads)
    : layers_(std::move(layers)),
      position_m_(position_m),
      sun_(direction_of(sun.elevation_degrees, sun.azimuth_degrees)) {
    diffuse_.reserve(layers_.size());  // marches point to them
    for (const Layer& layer : layers_) {
        diffuse_.push_back(diffuse_share(*layer.medium, 4, threads));
        marches_.push_back(
            march_through(*layer.medium, layer.steps, diffuse_.back(), layer.solved, sun, threads));
        set_origin(position_m, marches_.back());
    }
}

void LayerMarch::set_ray(std::span<RayBlock> blocks, std::size_t i, const glm::dvec3& direction,
                         float jitter, float light_jitter) const {
    const LayerRay ray = {position_m_, direction, one_minus_cosine(direction, sun_), jitter,
                          light_jitter};
    for (std::size_t l = 0; l < layers_.size(); ++l) {
        set_layer_ray(marches_[l], ray, layers_[l].steps.reach_m, blocks[l], i);
    }
}

}  // namespace skybake
