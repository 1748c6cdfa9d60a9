// The baker of asset = "blue_noise".
#include <algorithm>
#include <utility>

#include "bakers/assets/blue_noise/blue_noise_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/baked.h"
#include "config/assets/blue_noise.h"

namespace skybake {

using config::BlueNoiseBake;
using config::Outcome;
using config::Parameters;

namespace {

Outcome<Baked> bake(const Parameters&, const BlueNoiseBake& asset, const BakeOptions& options,
                    AssetLabel label) {
    return bake_blue_noise(asset, options, labelled_volume(std::move(label)));
}

Estimate estimate(const Parameters&, const BlueNoiseBake& asset) {
    constexpr double kSecondsPerVoxel = 6e-6;
    constexpr double kBytesPerVoxel = 22;  // energies and choices, twice, and ranks
    Estimate result = estimate_volume(asset, asset.voxels(), 1, kSecondsPerVoxel);
    result.memory_mib += voxels_of(asset.voxels(), 1) * kBytesPerVoxel / kMebibyte;
    return result;
}

AssetPlaces places(const Parameters&, const BlueNoiseBake& asset, const StoredTexels&) {
    return single_lookup({"x_px", "y_px", "frame"}, [size = asset.voxels()](const Place& at) {
        Uvw uvw;
        for (std::size_t i = 0; i < 3; ++i) uvw[i] = at[i].second / size[i];
        return uvw;
    });
}

AssetLookup lookup(const Parameters&, const BlueNoiseBake&, const StoredTexels& stored) {
    GlslFunction function;
    function.comment =
        "Returns the value of a pixel, such as gl_FragCoord.xy, in a frame: the number of the "
        "frame "
        "or any number between that and the next. Both may be beyond the mask, which repeats.";
    function.arguments = "sampler3D table, vec2 pixel, float frame";
    function.value = "blue_noise(table, pixel, frame)";
    return {"blue_noise", {with_channels(stored.channels, 4, std::move(function))}};
}

// A mask of 64 x 64 pixels and 8 frames takes a fifth of a second.
void draft(BlueNoiseBake& asset, int) {
    for (int& edge : asset.size) edge = std::min(edge, 64);
    asset.frames = std::min(asset.frames, 8);
}

}  // namespace

Baker<BlueNoiseBake> baker(BakerTag<BlueNoiseBake>) {
    return {.version = 1,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .draft = draft};
}

}  // namespace skybake
