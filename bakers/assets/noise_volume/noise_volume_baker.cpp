// The baker of asset = "noise_volume".
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <utility>

#include "bakers/assets/noise_volume/noise_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/registry/draft_size.h"
#include "bakers/field/baked.h"
#include "config/assets/noise_volume.h"
#include "config/sections/parameters.h"

namespace skybake {

using config::Outcome;
using config::Parameters;

namespace {

using config::Noise;
using config::NoiseVolumeBake;

Outcome<Baked> bake(const Parameters& parameters, const NoiseVolumeBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_noise_volume(noise_named(parameters, asset.noise), asset, options,
                             labelled_volume(std::move(label)));
}

Estimate estimate(const Parameters& parameters, const NoiseVolumeBake& asset) {
    const Noise& noise = noise_named(parameters, asset.noise);
    const std::size_t channels =
        noise.pack == config::NoisePacking::none ? noise.channels.size() : 1;
    return estimate_volume(asset, asset.size, channels, octaves_of(noise) * kSecondsPerOctave);
}

// Along which axes voxel i is at (i + 1/2) / size and not at i / size.
std::array<bool, 3> centered_axes(const Noise& noise) {
    const bool across = noise.sampling != config::NoiseSampling::corners;
    return {across, across, noise.sampling == config::NoiseSampling::centers};
}

AssetPlaces places(const Parameters& parameters, const NoiseVolumeBake& asset,
                   const StoredTexels&) {
    const std::array<bool, 3> centered = centered_axes(noise_named(parameters, asset.noise));
    return single_lookup({"x_tile", "y_tile", "z_tile"},
                         [centered, size = asset.size](const Place& at) {
                             Uvw uvw;
                             for (std::size_t i = 0; i < 3; ++i) {
                                 uvw[i] = at[i].second + (centered[i] ? 0.0 : 0.5 / size[i]);
                             }
                             return uvw;
                         });
}

// Along z a noise may have its voxels elsewhere than along x and y.
AssetLookup lookup(const Parameters& parameters, const NoiseVolumeBake& asset,
                   const StoredTexels& stored) {
    const std::array<bool, 3> centered = centered_axes(noise_named(parameters, asset.noise));
    std::array<double, 3> shift{};
    for (std::size_t i = 0; i < 3; ++i) shift[i] = centered[i] ? 0.0 : 0.5 / asset.size[i];
    GlslFunction function;
    function.comment =
        "Returns the noise. p is a point and `tile` the edges of a tile, in one unit.";
    function.arguments = "sampler3D table, vec3 p, vec3 tile";
    function.value =
        centered == std::array{true, true, true}
            ? "noise_volume(table, p, tile)"
            : fmt::format("noise_volume(table, p + tile * {}, tile)", glsl_vector(shift));
    return {"noise", {with_channels(stored.channels, 4, std::move(function))}};
}

void draft(NoiseVolumeBake& asset, int most_voxels) {
    asset.size = reduced(asset.size, most_voxels);
    asset.mips = 1;
}

}  // namespace

Baker<config::NoiseVolumeBake> baker(BakerTag<config::NoiseVolumeBake>) {
    return {.version = 3,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .variants = {{"size"}, {"pixel_type"}, {"formats"}}};
}

}  // namespace skybake
