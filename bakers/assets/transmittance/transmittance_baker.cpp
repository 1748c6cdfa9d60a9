// The baker of asset = "transmittance".
#include <array>
#include <utility>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/baker.h"
#include "bakers/assets/draft_size.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/field/image.h"
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

void draft(config::TransmittanceBake& asset, int) { reduce_table(asset, {256, 64}); }

}  // namespace

const Baker<config::TransmittanceBake>& baker(BakerTag<config::TransmittanceBake>) {
    static const Baker<config::TransmittanceBake> row = {
        .version = 2, .bake = bake, .estimate = estimate, .places = places, .draft = draft};
    return row;
}

}  // namespace skybake
