// The baker of asset = "noise_volume".
#include <array>
#include <cstddef>
#include <utility>

#include "bakers/assets/baker.h"
#include "bakers/assets/draft_size.h"
#include "bakers/assets/noise_volume/noise_volume.h"
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

AssetPlaces places(const Parameters& parameters, const NoiseVolumeBake& asset,
                   const StoredTexels&) {
    const config::NoiseSampling sampling = noise_named(parameters, asset.noise).sampling;
    const bool across = sampling != config::NoiseSampling::corners;
    const std::array<bool, 3> centered = {across, across,
                                          sampling == config::NoiseSampling::centers};
    return single_lookup({"x_tile", "y_tile", "z_tile"},
                         [centered, size = asset.size](const Place& at) {
                             Uvw uvw;
                             for (std::size_t i = 0; i < 3; ++i) {
                                 uvw[i] = at[i].second + (centered[i] ? 0.0 : 0.5 / size[i]);
                             }
                             return uvw;
                         });
}

void draft(NoiseVolumeBake& asset, int most_voxels) {
    asset.size = reduced(asset.size, most_voxels);
    asset.mips = 1;
}

}  // namespace

const Baker<config::NoiseVolumeBake>& baker(BakerTag<config::NoiseVolumeBake>) {
    static const Baker<config::NoiseVolumeBake> row = {
        .version = 2, .bake = bake, .estimate = estimate, .places = places, .draft = draft};
    return row;
}

}  // namespace skybake
