// Marches the rays of a picture through cloud layers at their altitudes, in the order of depth. The
// results do not depend on the colours of light.
//
// A layer may hold several tiles' worth of samples, and layers may overlap in altitude. The samples
// of a ray are `step_m` apart in each layer, shifted for each pixel sample by interleaved gradient
// noise (Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH
// 2014) in quarters (frame_march.cpp), which turns bands into fine grain. Samples towards the sun
// are shifted by another noise. Where clouds have grain or edges, that of one sample per pixel
// shows; there, a refined picture takes kSamples samples, whose shifts are evenly apart.
#pragma once

#include <deque>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/march/cloud_light.h"
#include "bakers/march/cloud_rays.h"
#include "bakers/math/bake_options.h"
#include "bakers/render/cloud_camera.h"

namespace skybake {

// A layer of a scene.
struct SceneLayer {
    const CloudMedium* medium = nullptr;  // repeats, if the scene has other layers
    double step_m = 1;                    // along rays
    double light_step_m = 1;              // towards the sun
    double reach_m = 1;                   // of rays from the camera
    // Marches towards the sun from within the layer have kNearLight steps of light_step_m; then their steps are so
    // many times longer, through means over boxes as long as the steps (coarse_medium), and after as many again so
    // many times longer. 1: all steps are equal.
    int light_growth = 1;
    // The light within the layer; null: that of octaves.
    const LightInCloud* solved = nullptr;
};

// Marches towards the sun of pictures for people.
inline constexpr int kLightGrowth = 2;
inline constexpr int kNearLight = 24;
// The same where the rest is looked up in the cells of solved light.
inline constexpr int kNearSolvedLight = 6;

// The pixels that have kSamples samples and not one: those with grain or edges of clouds, or all.
enum class Refinement { none, thin, all };

// The view that a picture shows, and the care that is taken with it.
struct SceneFrame {
    int width = 0;
    int height = 0;
    CloudCamera camera;
    Refinement refinement = Refinement::none;
    bool ground = false;  // with the shadows of clouds on the ground
    // Steps along rays grow with the distance t, to step_m sqrt(1 + 4 step_growth w / step_m), where w = t times
    // the angle of a pixel is what the pixel covers there. 0: they are equal.
    double step_growth = 0;
};

// Steps of pictures for people. Those of altocumulus and of an evening differ by an RMS of about 1 of 255
// from pictures of equal steps of half the length.
inline constexpr double kStepGrowth = 1;

inline constexpr int kSamples = 4;

// One texel per pixel, row 0 at the top. Each layer has kLayerChannels channels, the members of
// RayResults without the transmittance. Two channels follow: the transmittance of all clouds, and
// the share of sunlight that reaches the ground behind (1 where there is none, and the mean beyond
// the reach).
struct MarchedScene {
    static constexpr int kLayerChannels = 6;
    Image2<float> results;
    FetchCounts fetches;
    int refined_pixels = 0;
};

class SceneMarch {
  public:
    // `sunlit` false: no marches towards the sun. `leaping` uses the leaps of media and changes no bit.
    SceneMarch(const std::vector<SceneLayer>& layers, const SunDirection& sun, bool sunlit,
               bool leaping, int threads);

    // The bits are the same for any number of threads and any instruction set.
    MarchedScene march(const SceneFrame& frame, int threads, Progress* progress) const;

    std::size_t layers() const { return layers_.size(); }
    // The share of diffuse light that passes a layer, and the mean share of sunlight that passes it
    // without being scattered.
    double through(std::size_t layer) const { return diffuse_[layer].through; }
    double direct(std::size_t layer) const { return direct_[layer]; }
    // The product of direct() of the layers that repeat.
    double direct() const;

  private:
    // Makes the parts of marches towards the sun, of which all together are `length_m` long, beyond the nearest.
    void add_far_light(const SceneLayer& layer, double length_m, int threads, CloudMarch& march);
    double mean_direct(std::size_t layer) const;

    std::vector<SceneLayer> layers_;
    SunDirection sun_;
    std::vector<DiffuseShare> diffuse_;
    std::deque<CloudMedium> coarse_;
    std::vector<CloudMarch> marches_;  // without origins
    std::vector<double> direct_;
};

}  // namespace skybake
