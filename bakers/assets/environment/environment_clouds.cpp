#include "bakers/assets/environment/environment_clouds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/field/block_voxels.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "config/assets/cloud_volume.h"

namespace skybake {

using config::EnvironmentBake;
using config::Outcome;

namespace {

constexpr int kChannelsSeen = 6;
constexpr int kReferenceEdge = 8;
// Cells of voxels that rays leap over.
constexpr int kLeapCell = 4;

// Returns the voxels of the first channel of a volume, as files of its pixel type hold them.
std::vector<float> first_channel_of(const Baked& volume, const BakeOptions& options) {
    const Level& level = volume.levels.front();
    const auto plane =
        static_cast<std::size_t>(level.size[0]) * static_cast<std::size_t>(level.size[1]);
    std::vector<float> voxels(plane * static_cast<std::size_t>(level.size[2]));
    for_each_tile(level.size[2], options, "voxels of clouds", [&](int z) {
        float* slice = voxels.data() + static_cast<std::size_t>(z) * plane;
        std::vector<float*> channels(volume.channel_names.size(), nullptr);
        channels.front() = slice;
        level.voxels->fill({{0, 0, z}, {level.size[0], level.size[1], 1}}, channels);
        if (!is_block_coded(volume.pixel_type)) round_values(slice, plane, volume.pixel_type);
    });
    return voxels;
}

SunDirection sun_direction_of(const EnvironmentBake& bake) {
    return {bake.sun_elevation.radians * kDegreesPerRadian,
            -bake.sun_azimuth.radians * kDegreesPerRadian};
}

glm::dvec3 position_of(const EnvironmentBake& bake) {
    return {bake.camera_x.meters, bake.camera_y.meters, bake.altitude.meters};
}

MarchSteps march_steps_of(const CloudMedium& medium, const EnvironmentBake& bake, bool sunlit,
                          double finer) {
    MarchSteps steps = usual_steps(medium, sun_direction_of(bake));
    steps.step_m /= finer;
    steps.light_step_m /= finer;
    steps.sunlit = sunlit;
    return steps;
}

// Adds what a ray saw, with a weight.
void add(const RayResults& results, std::size_t ray, double weight, SeenClouds& sum) {
    sum.sun_at_base += weight * double{results.sun_at_base[ray]};
    sum.sun_at_top += weight * double{results.sun_at_top[ray]};
    sum.from_sky += weight * double{results.from_sky[ray]};
    sum.from_ground += weight * double{results.from_ground[ray]};
    sum.transmittance += weight * double{results.transmittance[ray]};
    sum.distance_m += weight * double{results.distance_m[ray]};
}

// The mean of some rays.
struct SeenMean {
    SeenClouds sum{0, 0, 0, 0, 0, 0};
    double weights = 0;

    void add_ray(const RayResults& results, std::size_t ray, double weight) {
        add(results, ray, weight, sum);
        weights += weight;
    }
    // A texel that straddles no solid angle has no weight: it shows the sky.
    SeenClouds mean() const {
        if (!(weights > 0)) return {};
        return {sum.sun_at_base / weights, sum.sun_at_top / weights,    sum.from_sky / weights,
                sum.from_ground / weights, sum.transmittance / weights, sum.distance_m / weights};
    }
};

double fraction_of(double value) { return value - std::floor(value); }

}  // namespace

Outcome<CloudMedium> clouds_of_environment(const config::Parameters& parameters,
                                           const EnvironmentBake& bake, const BakeOptions& options,
                                           Facts& details) {
    const auto& of = bake_named(parameters, bake.clouds).as<config::CloudVolumeBake>();
    const Outcome<CloudInputs> inputs =
        cloud_inputs(parameters, of, details, options.intermediates);
    if (!inputs.value) return {{}, inputs.diagnostics};
    Baked volume =
        hold_cloud_volume(cloud_named(parameters, of.cloud), of, *inputs.value, options, {});
    if (options.cancelled()) return {};
    code_levels(volume);
    const std::vector<float> voxels = first_channel_of(volume, options);
    if (options.cancelled()) return {};
    CloudMedium medium =
        cloud_medium(spanned_cloud(parameters, of), voxels.data(), of.size, 1, options.threads);
    medium.leaps = leaps_of_voxels(medium, kLeapCell, options.threads);
    return {std::move(medium), {}};
}

CloudsAround::CloudsAround(const CloudMedium& medium, const EnvironmentBake& bake,
                           const EnvironmentLayout& layout, bool sunlit, const BakeOptions& options)
    : medium_(medium),
      layout_(layout),
      samples_(bake.samples),
      steps_(march_steps_of(medium, bake, sunlit, 1)),
      march_(medium, position_of(bake), sun_direction_of(bake), steps_, options.threads),
      finer_(medium, position_of(bake), sun_direction_of(bake),
             march_steps_of(medium, bake, sunlit, 2), options.threads) {
    const auto size = layout.part_size();  // Clang captures no structured bindings
    const int columns = size[0];
    const int rows = size[1];
    seen_ = Image2<float>(columns, rows * layout.parts(), kChannelsSeen);
    const int at_a_time = std::max(RayBlock::kCount / (samples_ * samples_), 1);
    for_each_tile(seen_.height, options, "marching", [&](int line) {
        for (int first = 0; first < columns; first += at_a_time) {
            march_texels(line / rows, line % rows, first, std::min(at_a_time, columns - first));
        }
    });
}

void CloudsAround::march_texels(int part, int row, int first, int count) {
    const auto [columns, rows] = layout_.part_size();
    const int edge = samples_;
    RayBlock block;
    std::array<double, RayBlock::kCount> weights{};
    std::size_t ray = 0;
    for (int texel = first; texel < first + count; ++texel) {
        for (int j = 0; j < edge; ++j) {
            for (int i = 0; i < edge; ++i, ++ray) {
                const int column = texel * edge + i;
                const int line = row * edge + j;
                const double x = (column + 0.5) / (columns * edge);
                const double y = (line + 0.5) / (rows * edge);
                const int noise_row = part * rows * edge + line;
                march_.set_ray(block, ray, in_layer(layout_.direction(part, x, y)),
                               gradient_noise(column, noise_row, 0),
                               gradient_noise(column, noise_row, 1));
                weights[ray] = layout_.density(x, y);
            }
        }
    }
    RayResults results;
    FetchCounts counts;
    march_.march(block, results, counts);
    for (int texel = 0; texel < count; ++texel) {
        SeenMean mean;
        for (int i = 0; i < edge * edge; ++i) {
            const auto at = static_cast<std::size_t>(texel * edge * edge + i);
            mean.add_ray(results, at, weights[at]);
        }
        const SeenClouds seen = mean.mean();
        const double values[] = {seen.sun_at_base, seen.sun_at_top,    seen.from_sky,
                                 seen.from_ground, seen.transmittance, seen.distance_m};
        std::copy(std::begin(values), std::end(values),
                  seen_.texel(first + texel, part * rows + row));
    }
}

SeenClouds CloudsAround::texel(int part, int column, int row) const {
    const float* values = seen_.texel(column, part * layout_.part_size()[1] + row);
    return {values[0], values[1], values[2], values[3], values[4], values[5]};
}

SeenClouds CloudsAround::around(int part, double x, double y) const {
    const auto [columns, rows] = layout_.part_size();
    RayBlock block;
    std::array<double, RayBlock::kCount> weights{};
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
        finer_.set_ray(block, ray, in_layer(layout_.direction(part, at_x, at_y)),
                       static_cast<float>(fraction_of(begin + k * 0.6180339887498949)),
                       static_cast<float>(fraction_of(begin + k * 0.4142135623730950)));
        weights[ray] = layout_.density(at_x, at_y);
    }
    RayResults results;
    FetchCounts counts;
    finer_.march(block, results, counts);
    SeenMean mean;
    for (std::size_t ray = 0; ray < kRays; ++ray) mean.add_ray(results, ray, weights[ray]);
    return mean.mean();
}

// A march ends where hardly any light is left (kOpaque), so the ray is marched in pieces, and it finds
// a cloud's edges to a step, so that is done with four jitters.
double CloudsAround::transmittance(const glm::dvec3& direction) const {
    constexpr int kJitters = 4;
    constexpr int kPieces = RayBlock::kCount / kJitters;
    RayBlock block;
    for (int ray = 0; ray < RayBlock::kCount; ++ray) {
        const auto at = static_cast<std::size_t>(ray);
        const float jitter = (static_cast<float>(ray / kPieces) + 0.5F) / kJitters;
        finer_.set_ray(block, at, in_layer(direction), jitter, jitter);
        const float first = block.first[at];
        const float count = block.end[at] - first;
        const auto edge = [&](int piece) {
            return first + std::floor(count * static_cast<float>(piece) / kPieces);
        };
        block.end[at] = edge(ray % kPieces + 1);
        block.first[at] = edge(ray % kPieces);
    }
    RayResults results;
    FetchCounts counts;
    finer_.march(block, results, counts);
    double depth = 0;
    for (const float through : results.transmittance) {
        if (through < std::numeric_limits<float>::min()) return 0;
        depth -= logarithm(double{through}) / kJitters;
    }
    return exponential(-depth);
}

}  // namespace skybake
