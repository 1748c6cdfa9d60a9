// The baker of asset = "transmittance".
#include <fmt/format.h>

#include <utility>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/registry/draft_size.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/field/baked.h"
#include "config/assets/transmittance.h"

namespace skybake {

using config::Outcome;
using config::Parameters;

namespace {

Outcome<Baked> bake(const Parameters& parameters, const config::TransmittanceBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_transmittance(make_medium(parameters.atmosphere), asset, options,
                              labelled_table(parameters, std::move(label)));
}

Estimate estimate(const Parameters&, const config::TransmittanceBake& asset) {
    return estimate_table(asset, 2e-7, 0.05);
}

AssetPlaces places(const Parameters& parameters, const config::TransmittanceBake& asset,
                   const StoredTexels& stored) {
    const auto convention = asset.mapping == config::TransmittanceMapping::ue
                                ? TexelConvention::end_points_on_edges
                                : TexelConvention::end_points_on_texel_centres;
    const Shell shell = shell_of(parameters.atmosphere);
    return single_lookup({"altitude_km", "cos_zenith"}, [=](const Place& at) {
        const UnitCoordinates x = transmittance_coordinates(shell, at[0].second, at[1].second);
        return Uvw{texture_coordinate(convention, x.x_mu, stored.size[0]),
                   texture_coordinate(convention, x.x_r, stored.size[1]), 0.5};
    });
}

AssetLookup lookup(const Parameters& parameters, const config::TransmittanceBake& asset,
                   const StoredTexels& stored) {
    const bool is_depth = asset.content == config::TransmittanceContent::optical_depth;
    const Shell shell = shell_of(parameters.atmosphere);
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the {} from an altitude of 0 to {} km to the top of the air, along a ray of this "
        "zenith angle that does not meet the ground.",
        is_depth ? "optical depth" : "transmittance", glsl_number(shell.thickness_km));
    function.arguments = "sampler2D table, float altitude_km, float cos_zenith";
    function.value = fmt::format("transmittance_to_top{}{}(table, {}, altitude_km, cos_zenith)",
                                 asset.mapping == config::TransmittanceMapping::ue ? "_ue" : "",
                                 of_4(stored.channels), glsl_shell(shell));
    return {"transmittance", {with_wavelengths(stored.channels, std::move(function))}};
}

void draft(config::TransmittanceBake& asset, int) { reduce_table(asset, {256, 64}); }

}  // namespace

Baker<config::TransmittanceBake> baker(BakerTag<config::TransmittanceBake>) {
    return {.version = 8,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .variants = {{"size"}, {"pixel_type"}, {"content"}, {"mapping"}}};
}

}  // namespace skybake
