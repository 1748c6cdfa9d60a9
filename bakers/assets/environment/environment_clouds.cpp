#include "bakers/assets/environment/environment_clouds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "bakers/assets/cloud_light/march_light.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "bakers/field/voxel_array.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/environment.h"

namespace skybake {

using config::EnvironmentBake;

namespace {

constexpr int kChannelsOfLayer = 6;
constexpr int kReferenceEdge = 8;
// Cells of voxels that rays leap over.
constexpr int kLeapCell = 4;

SunDirection sun_direction_of(const EnvironmentBake& bake) {
    return {bake.sun_elevation.radians * kDegreesPerRadian,
            -bake.sun_azimuth.radians * kDegreesPerRadian};
}

glm::dvec3 position_of(const EnvironmentBake& bake) {
    return {bake.camera_x.meters, bake.camera_y.meters, bake.altitude.meters};
}

// Returns layers in an order that no list of them changes: samples of two layers at the same distance
// are taken in this order.
std::vector<const CloudMedium*> downwards(std::span<const CloudMedium> media) {
    std::vector<const CloudMedium*> sorted;
    for (const CloudMedium& medium : media) sorted.push_back(&medium);
    const auto middle_m = [](const CloudMedium* medium) {
        return medium->base_m + 0.5 * medium->extent_m[2];
    };
    std::ranges::stable_sort(sorted, [&](const CloudMedium* a, const CloudMedium* b) {
        return middle_m(a) > middle_m(b);
    });
    return sorted;
}

// Returns the light within each layer, if it can be solved for.
std::vector<std::optional<LightInCloud>> lights_within(std::span<const CloudMedium* const> media,
                                                       const EnvironmentBake& bake, bool sunlit,
                                                       const BakeOptions& options) {
    std::vector<std::optional<LightInCloud>> lights(media.size());
    const SunDirection sun = sun_direction_of(bake);
    if (!sunlit) return lights;
    for (std::size_t l = 0; l < media.size(); ++l) {
        const cloud_light::MarchLight within(*media[l], cloud_light::kCellsOfPicture, options);
        lights[l] = within.under(sun, options);
    }
    return lights;
}

// Returns the layers with their usual steps, or with steps that are so many times shorter.
std::vector<LayerMarch::Layer> layers_of(std::span<const CloudMedium* const> media,
                                         const std::vector<std::optional<LightInCloud>>& lights,
                                         const EnvironmentBake& bake, bool sunlit, double finer) {
    std::vector<LayerMarch::Layer> layers;
    for (std::size_t l = 0; l < media.size(); ++l) {
        const CloudMedium* medium = media[l];
        MarchSteps steps = usual_steps(*medium, sun_direction_of(bake));
        steps.reach_m = reach_m_from(*medium, bake.altitude.meters);
        steps.step_m /= finer;
        steps.light_step_m /= finer;
        steps.sunlit = sunlit;
        layers.push_back({medium, steps, lights[l] ? &*lights[l] : nullptr});
    }
    return layers;
}

// Adds what a ray saw of a layer, with a weight.
void add(const RayResults& results, std::size_t ray, double weight, SeenLayer& sum) {
    sum.sun_at_base += weight * double{results.sun_at_base[ray]};
    sum.sun_at_top += weight * double{results.sun_at_top[ray]};
    sum.from_sky += weight * double{results.from_sky[ray]};
    sum.from_ground += weight * double{results.from_ground[ray]};
    sum.opacity += weight * double{results.opacity[ray]};
    sum.distance_m += weight * double{results.distance_m[ray]};
}

// Rays through all layers, and what they see of each.
struct LayerRays {
    std::vector<RayBlock> blocks;
    std::vector<RayResults> results;
    std::array<double, RayBlock::kCount> weights{};

    explicit LayerRays(std::size_t layers) : blocks(layers), results(layers) {}

    void march(const LayerMarch& march) {
        FetchCounts counts;
        march.march(blocks, results, counts);
    }
    // Returns the mean of some rays. Rays that stand for no solid angle show the sky.
    SeenClouds mean(std::size_t first, std::size_t count) const {
        SeenClouds mean{std::vector<SeenLayer>(blocks.size()), 1};
        double sum = 0;
        for (std::size_t ray = first; ray < first + count; ++ray) sum += weights[ray];
        if (!(sum > 0)) return mean;
        mean.transmittance = 0;
        for (std::size_t ray = first; ray < first + count; ++ray) {
            const double share = weights[ray] / sum;
            for (std::size_t l = 0; l < results.size(); ++l) {
                add(results[l], ray, share, mean.layers[l]);
            }
            mean.transmittance += share * double{results.front().transmittance[ray]};
        }
        return mean;
    }
};

double fraction_of(double value) { return value - std::floor(value); }

Outcome<CloudMedium> medium_of(const config::Parameters& parameters, const std::string& clouds,
                               const BakeOptions& options, Facts& details) {
    const CloudVolumeBake& of = source_volume(parameters, clouds);
    const Outcome<Baked> volume = hold_source_volume(parameters, clouds, options, details);
    if (!volume.value) return {{}, volume.diagnostics};
    std::vector<float> voxels(occupancy::count_of(of.size));
    read_channel(*volume.value, 0, options, voxels.data());
    if (options.cancelled()) return {};
    CloudMedium medium =
        cloud_medium(spanned_cloud(parameters, of), voxels.data(), of.size, 1, options.threads);
    medium.leaps = leaps_of_voxels(medium, kLeapCell, options.threads);
    return {std::move(medium), {}};
}

}  // namespace

Outcome<std::vector<CloudMedium>> clouds_of_environment(const config::Parameters& parameters,
                                                        const EnvironmentBake& bake,
                                                        const BakeOptions& options,
                                                        Facts& details) {
    std::vector<CloudMedium> media;
    for (const std::string& clouds : bake.clouds) {
        Outcome<CloudMedium> medium = medium_of(parameters, clouds, options, details);
        if (!medium.value) return {{}, medium.diagnostics};
        media.push_back(std::move(*medium.value));
    }
    return {std::move(media), {}};
}

CloudsAround::CloudsAround(std::span<const CloudMedium> media, const EnvironmentBake& bake,
                           const EnvironmentLayout& layout, bool sunlit, const BakeOptions& options)
    : media_(downwards(media)),
      layout_(layout),
      samples_(bake.samples),
      lights_(lights_within(media_, bake, sunlit, options)),
      march_(layers_of(media_, lights_, bake, sunlit, 1), position_of(bake), sun_direction_of(bake),
             options.threads),
      finer_(layers_of(media_, lights_, bake, sunlit, 2), position_of(bake), sun_direction_of(bake),
             options.threads) {
    const auto size = layout.part_size();
    const int channels = kChannelsOfLayer * static_cast<int>(media.size()) + 1;
    seen_ = Image2<float>(size.columns, size.rows * layout.parts(), channels);
    const int at_a_time = std::max(RayBlock::kCount / (samples_ * samples_), 1);
    for_each_tile(seen_.height, options, "marching", [&](int line) {
        for (int first = 0; first < size.columns; first += at_a_time) {
            march_texels(line / size.rows, line % size.rows, first,
                         std::min(at_a_time, size.columns - first));
        }
    });
}

double CloudsAround::reach_m(double altitude_m) const {
    double farthest = 0;
    for (const CloudMedium* medium : media_) {
        farthest = std::max(farthest, reach_m_from(*medium, altitude_m));
    }
    return farthest;
}

void CloudsAround::march_texels(int part, int row, int first, int count) {
    const auto [columns, rows] = layout_.part_size();
    const int edge = samples_;
    LayerRays rays(media_.size());
    std::size_t ray = 0;
    for (int texel = first; texel < first + count; ++texel) {
        for (int j = 0; j < edge; ++j) {
            for (int i = 0; i < edge; ++i, ++ray) {
                const int column = texel * edge + i;
                const int line = row * edge + j;
                const double x = (column + 0.5) / (columns * edge);
                const double y = (line + 0.5) / (rows * edge);
                const int noise_row = part * rows * edge + line;
                march_.set_ray(rays.blocks, ray, in_layer(layout_.direction(part, x, y)),
                               gradient_noise(column, noise_row, 0),
                               gradient_noise(column, noise_row, 1));
                rays.weights[ray] = layout_.density(x, y);
            }
        }
    }
    rays.march(march_);
    const auto of_texel = static_cast<std::size_t>(edge * edge);
    for (int texel = 0; texel < count; ++texel) {
        const SeenClouds seen = rays.mean(static_cast<std::size_t>(texel) * of_texel, of_texel);
        float* out = seen_.texel(first + texel, part * rows + row);
        for (const SeenLayer& layer : seen.layers) {
            const double values[] = {layer.sun_at_base, layer.sun_at_top, layer.from_sky,
                                     layer.from_ground, layer.opacity,    layer.distance_m};
            out = std::copy(std::begin(values), std::end(values), out);
        }
        *out = static_cast<float>(seen.transmittance);
    }
}

SeenClouds CloudsAround::texel(int part, int column, int row) const {
    const float* values = seen_.texel(column, part * layout_.part_size().rows + row);
    SeenClouds seen;
    for (std::size_t l = 0; l < media_.size(); ++l, values += kChannelsOfLayer) {
        seen.layers.push_back({values[0], values[1], values[2], values[3], values[4], values[5]});
    }
    seen.transmittance = *values;
    return seen;
}

SeenClouds CloudsAround::around(int part, double x, double y) const {
    const auto [columns, rows] = layout_.part_size();
    LayerRays rays(media_.size());
    constexpr int kRays = kReferenceEdge * kReferenceEdge;
    // Places within their parts, and jitters, are additive sequences of irrational steps, which
    // begin elsewhere at each place.
    const double begin = fraction_of(x * 1e4 * std::numbers::sqrt2 + y * 1e4 * std::numbers::sqrt3);
    for (int k = 0; k < kRays; ++k) {
        const auto ray = static_cast<std::size_t>(k);
        const double across =
            (k % kReferenceEdge + fraction_of(begin + k * 0.7548776662466927)) / kReferenceEdge -
            0.5;
        const double down =
            (k / kReferenceEdge + fraction_of(begin + k * 0.5698402909980532)) / kReferenceEdge -
            0.5;
        const double at_x = x + across / columns;
        const double at_y = y + down / rows;
        finer_.set_ray(rays.blocks, ray, in_layer(layout_.direction(part, at_x, at_y)),
                       static_cast<float>(fraction_of(begin + k * 0.6180339887498949)),
                       static_cast<float>(fraction_of(begin + k * 0.4142135623730950)));
        rays.weights[ray] = layout_.density(at_x, at_y);
    }
    rays.march(finer_);
    return rays.mean(0, kRays);
}

// A march ends where hardly any light is left (kOpaque), so the ray is marched in pieces, layer by
// layer, and it finds the faces of a layer to a step, so that is done with many jitters. Where light is solved,
// rays meet a share of the extinction.
double CloudsAround::transmittance(const glm::dvec3& direction) const {
    constexpr int kJitters = 64;
    constexpr int kPieces = 64;
    constexpr int kAtOnce = RayBlock::kCount / kPieces;
    double depth = 0;
    for (int first_jitter = 0; first_jitter < kJitters; first_jitter += kAtOnce) {
        std::vector<RayBlock> blocks(media_.size());
        for (int ray = 0; ray < RayBlock::kCount; ++ray) {
            const auto at = static_cast<std::size_t>(ray);
            const float jitter =
                (static_cast<float>(first_jitter + ray / kPieces) + 0.5F) / kJitters;
            finer_.set_ray(blocks, at, in_layer(direction), jitter, jitter);
            for (RayBlock& block : blocks) {
                const float first = block.first[at];
                const float count = block.end[at] - first;
                const auto edge = [&](int piece) {
                    return first + std::floor(count * static_cast<float>(piece) / kPieces);
                };
                block.end[at] = edge(ray % kPieces + 1);
                block.first[at] = edge(ray % kPieces);
            }
        }
        for (std::size_t l = 0; l < blocks.size(); ++l) {
            const double share = lights_[l] ? lights_[l]->share : 1;
            RayResults results;
            FetchCounts counts;
            finer_.march_one(l, blocks[l], results, counts);
            for (const float through : results.transmittance) {
                if (through < std::numeric_limits<float>::min()) return 0;
                depth -= logarithm(double{through}) / (kJitters * share);
            }
        }
    }
    return exponential(-depth);
}

}  // namespace skybake
