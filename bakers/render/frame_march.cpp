#include "bakers/render/frame_march.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// The places of a pixel's samples, in pixels from its middle: there, and on a triangle about it.
struct Offset {
    double x;
    double y;
};
constexpr std::array<Offset, kSamples> kOffsets = {
    {{0, 0}, {0.35, 0}, {-0.175, 0.303}, {-0.175, -0.303}}};

// The noise of a pixel is (q + n) / 4, with n the gradient noise and q a number that differs among each
// two by two pixels. The samples of a pixel are a quarter apart, so together they are (0 + n) / 4 to
// (3 + n) / 4: what is left of the noise in their mean is the fine pattern of n. With gradient noise
// alone it would be that of the fraction of 4 n, whose waves are three pixels long and show as hatching.
float jitter_of(const PixelSample& sample, int pattern) {
    static_assert(kSamples == 4);
    constexpr std::array<std::array<int, 4>, 2> quarters = {{{0, 2, 3, 1}, {2, 3, 1, 0}}};
    const auto place = static_cast<std::size_t>((sample.x & 1) + 2 * (sample.y & 1));
    const int quarter = quarters[static_cast<std::size_t>(pattern)][place] + sample.sample;
    return (static_cast<float>(quarter % kSamples) + gradient_noise(sample.x, sample.y, pattern)) /
           kSamples;
}

}  // namespace

FrameMarch::FrameMarch(const std::vector<SceneLayer>& layers, const SunDirection& sun,
                       std::vector<CloudMarch> marches, const SceneFrame& frame, float far_sunlight)
    : layers_(layers),
      marches_(std::move(marches)),
      frame_(frame),
      rays_(frame.camera, frame.width, frame.height),
      sun_(direction_of(sun.elevation_degrees, sun.azimuth_degrees)),
      far_sunlight_(far_sunlight) {
    for (std::size_t l = 0; l < layers_.size(); ++l) {
        set_origin(frame.camera.position_m, marches_[l]);
        marches_[l].growth = static_cast<float>(frame.step_growth * rays_.pixel());
        farthest_m_ = std::max(farthest_m_, layers_[l].reach_m);
        // The shadow of a tile that stands alone falls wherever the sun throws it.
        if (!marches_[l].medium->repeats) farthest_m_ = std::numeric_limits<double>::infinity();
    }
}

FetchCounts FrameMarch::march(std::span<const PixelSample> samples, float weight,
                              Image2<float>& image) const {
    std::vector<RayBlock> blocks(layers_.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].x >= 0) set_ray(blocks, i, samples[i]);
    }
    std::vector<RayResults> results(layers_.size());
    FetchCounts counts;
    march_cloud_rays(marches_, blocks, results, counts);
    const std::vector<float> ground = sunlight_on_ground(samples, counts);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].x < 0) continue;
        float* out = image.texel(samples[i].x, samples[i].y);
        for (const RayResults& seen : results) {
            for (const float value : {seen.sun_at_base[i], seen.sun_at_top[i], seen.from_sky[i],
                                      seen.from_ground[i], seen.opacity[i], seen.distance_m[i]}) {
                *out++ += weight * value;
            }
        }
        *out++ += weight * results.front().transmittance[i];
        *out += weight * ground[i];
    }
    return counts;
}

glm::dvec3 FrameMarch::direction_through(const PixelSample& sample) const {
    const Offset& offset = kOffsets[static_cast<std::size_t>(sample.sample)];
    return rays_.through(sample.x + offset.x, sample.y + offset.y);
}

void FrameMarch::set_ray(std::vector<RayBlock>& blocks, std::size_t i,
                         const PixelSample& sample) const {
    const glm::dvec3 direction = direction_through(sample);
    const LayerRay ray = {frame_.camera.position_m, direction, one_minus_cosine(direction, sun_),
                          jitter_of(sample, 0), jitter_of(sample, 1)};
    for (std::size_t l = 0; l < layers_.size(); ++l) {
        set_layer_ray(marches_[l], ray, layers_[l].reach_m, blocks[l], i);
    }
}

std::vector<float> FrameMarch::sunlight_on_ground(std::span<const PixelSample> samples,
                                                  FetchCounts& counts) const {
    std::vector<float> shares(samples.size(), 1.0F);
    if (!frame_.ground) return shares;
    std::vector<SunlitPoint> points;
    std::vector<std::size_t> rays;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].x < 0) continue;
        const glm::dvec3 direction = direction_through(samples[i]);
        const glm::dvec3& eye = frame_.camera.position_m;
        if (!(direction.z < 0)) continue;
        if (eye.z > -direction.z * farthest_m_) {
            shares[i] = far_sunlight_;
            continue;
        }
        const glm::dvec3 at = eye - eye.z / direction.z * direction;
        points.push_back(
            {static_cast<float>(at.x), static_cast<float>(at.y), 0, jitter_of(samples[i], 1)});
        rays.push_back(i);
    }
    const std::vector<float> depths = depths_towards_sun(marches_, points, counts);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        shares[rays[i]] = static_cast<float>(exponential(-double{depths[i]}));
    }
    return shares;
}

}  // namespace skybake
