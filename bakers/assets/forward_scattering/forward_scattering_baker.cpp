// The baker of asset = "forward_scattering".

#include <utility>

#include "bakers/assets/forward_scattering/forward_table.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/baked.h"
#include "config/assets/forward_scattering.h"

namespace skybake {

using config::ForwardScatteringBake;

namespace {

Outcome<Baked> bake(const Parameters&, const ForwardScatteringBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    Baked table = labelled_volume(std::move(label));
    table.channel_names = names_of_channels(1);
    return forward_scattering::bake_forward_scattering(asset, options, std::move(table));
}

Estimate estimate(const Parameters&, const ForwardScatteringBake& asset) {
    constexpr double kSecondsPerTexel = 1e-5;
    return estimate_table(asset, 1, kSecondsPerTexel, 0.5);
}

AssetPlaces places(const Parameters&, const ForwardScatteringBake&, const StoredTexels& stored) {
    return single_lookup({"scattering_angle_deg", "optical_depth"}, [=](const Place& at) {
        constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
        const double x = forward_scattering::angle_coordinate(at[0].second);
        const double y = forward_scattering::depth_coordinate(at[1].second);
        return Uvw{texture_coordinate(kConvention, x, stored.size[0]),
                   texture_coordinate(kConvention, y, stored.size[1]), 0.5};
    });
}

AssetLookup lookup(const Parameters&, const ForwardScatteringBake&, const StoredTexels& stored) {
    GlslFunction function;
    function.comment =
        "Returns the factor of the sunlight that is scattered once. `offset` is 1 - cosine of the "
        "scattering angle, `depth` the optical depth to the sun.";
    function.result = "float";
    function.arguments = "sampler2D table, float offset, float depth";
    function.value = "forward_scattering(table, " + glsl_size(stored.size) + ", offset, depth)";
    return {"forward_scattering", {std::move(function)}};
}

}  // namespace

Baker<ForwardScatteringBake> baker(BakerTag<ForwardScatteringBake>) {
    return {.version = 2,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .variants = {{"size"}, {"pixel_type"}}};
}

}  // namespace skybake
