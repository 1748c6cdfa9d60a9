#include "bakers/render/scene_march.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/render/frame_march.h"
#include "bakers/render/stage_progress.h"

namespace skybake {
namespace {

// A block of rays is a square of pixels, ordered in groups of four by four, so that the rays of one
// vector have similar directions.
constexpr int kTile = 16;
static_assert(kTile * kTile == RayBlock::kCount);

PixelSample tile_pixel(int i) {
    return {(i & 3) | ((i >> 2) & 12), ((i >> 2) & 3) | ((i >> 4) & 12), 0};
}

// Points per edge of a tile for the mean of its direct light.
constexpr int kDirectPoints = 32;

CloudMarch march_of(const SceneLayer& layer, const DiffuseShare& diffuse, const SunDirection& sun,
                    bool sunlit, bool leaping, int threads) {
    return march_through(*layer.medium,
                         {layer.step_m, layer.light_step_m, layer.reach_m, leaping, sunlit},
                         diffuse, layer.solved, sun, threads);
}

std::vector<PixelSample> all_pixels(const Image2<float>& image) {
    std::vector<PixelSample> pixels;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) pixels.push_back({x, y, 0});
    }
    return pixels;
}

// The need for more samples follows from these: the transmittance, and the light of the sun, whose grain
// shows where a cloud is dense.
struct PixelState {
    float transmittance = 1;
    float sunlight = 0;
};
PixelState state_of(const float* texel, int channels) {
    PixelState state;
    for (int c = 0; c + 2 < channels; c += MarchedScene::kLayerChannels) {
        state.sunlight += texel[c] + texel[c + 1];
    }
    state.transmittance = texel[channels - 2];
    return state;
}

// Light that rises or falls evenly from pixel to pixel is right with one sample. So a pixel is compared
// with the mean of the two beside it, from which it differs by half of a step's height. Jitters of neighbours
// differ by half a step, so thin cloud whose steps are too long stands out, too.
bool stands_out(const PixelState& before, const PixelState& here, const PixelState& after) {
    constexpr float kEdge = 1.0F / 16;   // of transmittance
    constexpr float kGrain = 1.0F / 32;  // of transmittance and of sunlight
    const float sunlight = 0.5F * (before.sunlight + after.sunlight);
    const float through = 0.5F * (before.transmittance + after.transmittance);
    return std::fabs(here.transmittance - before.transmittance) > kEdge ||
           std::fabs(here.transmittance - after.transmittance) > kEdge ||
           std::fabs(here.transmittance - through) > 0.5F * kGrain ||
           std::fabs(here.sunlight - sunlight) > kGrain * std::max(here.sunlight, sunlight);
}

// Returns the pixels that stand out from their neighbours.
std::vector<PixelSample> grainy_pixels(const Image2<float>& image) {
    const auto state = [&](int x, int y) {
        return state_of(
            image.texel(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1)),
            image.channels);
    };
    std::vector<PixelSample> pixels;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const PixelState here = state(x, y);
            if (stands_out(state(x - 1, y), here, state(x + 1, y)) ||
                stands_out(state(x, y - 1), here, state(x, y + 1))) {
                pixels.push_back({x, y, 0});
            }
        }
    }
    return pixels;
}

void add(const std::vector<FetchCounts>& counts, FetchCounts& sum) {
    for (const FetchCounts& count : counts) {
        sum.samples += count.samples;
        sum.light_samples += count.light_samples;
        sum.cells += count.cells;
    }
}

// The share of a picture's time that the first sample of all pixels takes, by experience, if others
// follow.
constexpr double kFirstShare = 0.35;

// Takes the other samples of the pixels that need them.
void refine(const FrameMarch& march, Refinement refinement, int threads, Progress* progress,
            MarchedScene& scene) {
    const std::vector<PixelSample> pixels =
        refinement == Refinement::all ? all_pixels(scene.results) : grainy_pixels(scene.results);
    constexpr std::size_t others = kSamples - 1;
    constexpr std::size_t in_block = RayBlock::kCount / others;
    constexpr float weight = 1.0F / kSamples;
    for (const PixelSample& pixel : pixels) {
        float* texel = scene.results.texel(pixel.x, pixel.y);
        for (int c = 0; c < scene.results.channels; ++c) texel[c] *= weight;
    }
    const std::size_t blocks = (pixels.size() + in_block - 1) / in_block;
    std::vector<FetchCounts> counts(blocks);
    ProgressPart part(progress, "marching", kFirstShare, 1 - kFirstShare);
    const BakeOptions options{threads, Certification::off, &part};
    for_each_tile(static_cast<int>(blocks), options, "marching", [&](int index) {
        const auto block = static_cast<std::size_t>(index);
        std::vector<PixelSample> samples;
        for (std::size_t i = block * in_block; i < std::min((block + 1) * in_block, pixels.size());
             ++i) {
            for (int sample = 1; sample < kSamples; ++sample) {
                samples.push_back({pixels[i].x, pixels[i].y, sample});
            }
        }
        counts[block] = march.march(samples, weight, scene.results);
    });
    add(counts, scene.fetches);
    scene.refined_pixels = static_cast<int>(pixels.size());
}

}  // namespace

SceneMarch::SceneMarch(const std::vector<SceneLayer>& layers, const SunDirection& sun, bool sunlit,
                       bool leaping, int threads)
    : layers_(layers), sun_(sun) {
    diffuse_.reserve(layers.size());  // marches point to them
    for (const SceneLayer& layer : layers_) {
        diffuse_.push_back(diffuse_share(*layer.medium, 4, threads));
        marches_.push_back(march_of(layer, diffuse_.back(), sun, sunlit, leaping, threads));
        if (sunlit && layer.light_growth > 1) {
            add_far_light(layer, sun_march_length_m(*layer.medium, sun), threads, marches_.back());
        }
    }
    for (std::size_t l = 0; l < layers_.size(); ++l) direct_.push_back(mean_direct(l));
}

void SceneMarch::add_far_light(const SceneLayer& layer, double length_m, int threads,
                               CloudMarch& march) {
    double begin_m = kNearLight * layer.light_step_m;
    double step_m = layer.light_step_m;
    if (begin_m >= length_m) return;
    march.own_samples = static_cast<float>(layer.solved != nullptr ? kNearSolvedLight : kNearLight);
    const CloudMedium* finer = layer.medium;
    std::array<float, 3> direction = march.light_direction;
    while (begin_m < length_m) {
        step_m *= layer.light_growth;
        std::array<int, 3> block{};
        for (std::size_t a = 0; a < 3; ++a) {
            const double voxels = step_m * std::fabs(double{direction[a]});
            block[a] = std::clamp(static_cast<int>(voxels), 1, finer->volume.size[a]);
        }
        coarse_.push_back(coarse_medium(*finer, block, threads));
        CloudMarch far;
        far.medium = &coarse_.back();
        for (std::size_t a = 0; a < 3; ++a) {
            direction[a] = static_cast<float>(double{direction[a]} * finer->meters_per_voxel(a) /
                                              far.medium->meters_per_voxel(a));
        }
        far.light_direction = direction;
        finer = far.medium;
        far.light_step_m = static_cast<float>(step_m);
        far.light_samples = static_cast<float>(std::ceil(length_m / step_m));
        far.own_begin_m = static_cast<float>(begin_m);
        far.own_samples = static_cast<float>(
            std::min(std::ceil((length_m - begin_m) / step_m), double{kNearLight}));
        far.leaping = false;
        begin_m += double{far.own_samples} * step_m;
        march.far_light.push_back(std::move(far));
    }
}

double SceneMarch::mean_direct(std::size_t layer) const {
    const CloudMedium& medium = *layers_[layer].medium;
    std::vector<SunlitPoint> points;
    for (int y = 0; y < kDirectPoints; ++y) {
        for (int x = 0; x < kDirectPoints; ++x) {
            points.push_back({static_cast<float>((x + 0.5) / kDirectPoints * medium.extent_m[0]),
                              static_cast<float>((y + 0.5) / kDirectPoints * medium.extent_m[1]),
                              static_cast<float>(medium.base_m), 0.5F});
        }
    }
    FetchCounts counts;
    double sum = 0;
    for (const float depth : depths_towards_sun({&marches_[layer], 1}, points, counts)) {
        sum += exponential(-double{depth});
    }
    return sum / static_cast<double>(points.size());
}

double SceneMarch::direct() const {
    double product = 1;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
        if (layers_[l].medium->repeats) product *= direct_[l];
    }
    return product;
}

MarchedScene SceneMarch::march(const SceneFrame& frame, int threads, Progress* progress) const {
    const FrameMarch march(layers_, sun_, marches_, frame, static_cast<float>(direct()));
    MarchedScene scene;
    scene.results = Image2<float>(frame.width, frame.height, march.channels());
    const int across = (frame.width + kTile - 1) / kTile;
    const int down = (frame.height + kTile - 1) / kTile;
    std::vector<FetchCounts> counts(static_cast<std::size_t>(across * down));
    const bool refined = frame.refinement != Refinement::none;
    ProgressPart part(progress, "marching", 0, refined ? kFirstShare : 1);
    const BakeOptions options{threads, Certification::off, &part};
    for_each_tile(across * down, options, "marching", [&](int tile) {
        std::array<PixelSample, RayBlock::kCount> samples;
        for (int i = 0; i < RayBlock::kCount; ++i) {
            PixelSample pixel = tile_pixel(i);
            pixel.x += tile % across * kTile;
            pixel.y += tile / across * kTile;
            const bool inside = pixel.x < frame.width && pixel.y < frame.height;
            samples[static_cast<std::size_t>(i)] = inside ? pixel : PixelSample();
        }
        counts[static_cast<std::size_t>(tile)] = march.march(samples, 1, scene.results);
    });
    add(counts, scene.fetches);
    if (refined && !is_cancelled(progress)) {
        refine(march, frame.refinement, threads, progress, scene);
    }
    return scene;
}

}  // namespace skybake
