// Marches the rays of one picture of a scene, in blocks of samples.
#pragma once

#include <span>
#include <vector>

#include "bakers/render/scene_march.h"

namespace skybake {

// One sample of a pixel.
struct PixelSample {
    int x = -1;  // -1: no ray
    int y = 0;
    int sample = 0;
};

// The march of one picture.
class FrameMarch {
  public:
    // `layers` and `frame` must outlive it. `far_sunlight` is the share of sunlight on ground that is
    // farther away than the reach of every layer.
    FrameMarch(const std::vector<SceneLayer>& layers, const SunDirection& sun,
               std::vector<CloudMarch> marches, const SceneFrame& frame, float far_sunlight);

    int channels() const {
        return MarchedScene::kLayerChannels * static_cast<int>(layers_.size()) + 2;
    }

    // Marches one ray for each sample, at most RayBlock::kCount, and adds `weight` times its results to
    // its pixel.
    FetchCounts march(std::span<const PixelSample> samples, float weight,
                      Image2<float>& image) const;

  private:
    glm::dvec3 direction_through(const PixelSample& sample) const;
    void set_ray(std::vector<RayBlock>& blocks, std::size_t i, const PixelSample& sample) const;
    // Returns the share of sunlight at the ground behind each ray.
    std::vector<float> sunlight_on_ground(std::span<const PixelSample> samples,
                                          FetchCounts& counts) const;

    const std::vector<SceneLayer>& layers_;
    std::vector<CloudMarch> marches_;
    const SceneFrame& frame_;
    CameraRays rays_;
    glm::dvec3 sun_;
    float far_sunlight_;
    double farthest_m_ = 0;
};

}  // namespace skybake
