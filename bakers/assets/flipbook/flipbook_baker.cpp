// The baker of asset = "flipbook".
#include <fmt/format.h>

#include <utility>
#include <vector>

#include "bakers/assets/flipbook/flipbook_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "config/assets/flipbook.h"

namespace skybake {

using config::FlipbookBake;
using config::Outcome;
using config::Parameters;

namespace {

Outcome<Baked> bake(const Parameters& parameters, const FlipbookBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_flipbook(parameters, asset, options, labelled_volume(std::move(label)));
}

Estimate estimate(const Parameters& parameters, const FlipbookBake& asset) {
    constexpr std::size_t kMostChannels = 4;
    const config::Bake& first = config::first_frame(parameters, asset);
    const auto [width, height, depth] = config::frame_size(first);
    Estimate result = estimate_volume(asset, {width, height, asset.length}, kMostChannels, 1e-9);
    result.seconds += asset.length * baker_of(first).estimate(parameters, first).seconds;
    return result;
}

AssetPlaces places(const Parameters&, const FlipbookBake& asset, const StoredTexels&) {
    return single_lookup({"u", "v", "frame"}, [frames = asset.length](const Place& at) {
        return Uvw{at[0].second, at[1].second, (at[2].second + 0.5) / frames};
    });
}

AssetLookup lookup(const Parameters&, const FlipbookBake& asset, const StoredTexels& stored) {
    const bool are_layers = asset.mapping == config::FlipbookMapping::layers;
    GlslFunction function;
    function.comment =
        "Returns the channels at u and v of a frame, counted from 0; between two numbers the two "
        "frames are blended. All may be any numbers, as frames repeat.";
    function.arguments = fmt::format("{} table, float u, float v, float frame",
                                     are_layers ? "sampler2DArray" : "sampler3D");
    function.value =
        fmt::format("flipbook{}(table, vec2(u, v), frame)", are_layers ? "_layers" : "");
    return {"flipbook", {with_channels(stored.channels, 4, std::move(function))}};
}

std::vector<InputFile> inputs(const Parameters& parameters, const FlipbookBake& asset) {
    const config::Bake& first = config::first_frame(parameters, asset);
    return baker_of(first).inputs(parameters, first);
}

}  // namespace

const Baker<FlipbookBake>& baker(BakerTag<FlipbookBake>) {
    static const Baker<FlipbookBake> row = {.version = 1,
                                            .bake = bake,
                                            .estimate = estimate,
                                            .places = places,
                                            .lookup = lookup,
                                            .inputs = inputs};
    return row;
}

}  // namespace skybake
