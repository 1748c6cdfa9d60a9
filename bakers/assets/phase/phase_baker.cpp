// The baker of asset = "phase".
#include <fmt/format.h>

#include <utility>

#include "bakers/assets/phase/phase_fit.h"
#include "bakers/assets/phase/phase_table.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/baked.h"
#include "bakers/math/transcendental.h"
#include "config/assets/phase.h"

namespace skybake {

using config::Outcome;
using config::Parameters;

namespace {

Outcome<Baked> bake(const Parameters& parameters, const config::PhaseBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_phase(parameters, asset, options, labelled_table(parameters, std::move(label)));
}

Estimate estimate(const Parameters&, const config::PhaseBake& asset) {
    return estimate_texels(asset, {asset.max_error ? 0 : asset.size, 1}, 1e-6, 1);
}

// Returns the place in a table by the spacing that its file names; none names shares of the light.
double share_of_table(std::optional<config::PhaseSpacing> spacing, double at) {
    if (!spacing) return at;  // a share of the light
    if (*spacing == config::PhaseSpacing::angle) return at / 180;
    const double half_sine = cosine_of_pi(0.5 - at / 360);
    const double half_cosine = cosine_of_pi(at / 360);
    const ScatteringAngle angle = {2 * half_sine * half_sine, 2 * half_cosine * half_cosine};
    return phase_coordinate(*spacing, angle);
}

AssetPlaces places(const Parameters&, const config::PhaseBake& asset, const StoredTexels& stored) {
    const bool inverse = asset.content == config::PhaseContent::inverse_cumulative;
    return single_lookup({inverse ? "share" : "scattering_angle_deg"}, [=](const Place& at) {
        const double x = share_of_table(spacing_named(stored.mapping), at[0].second);
        return Uvw{
            texture_coordinate(TexelConvention::end_points_on_texel_centres, x, stored.size[0]),
            0.5, 0.5};
    });
}

AssetLookup lookup(const Parameters&, const config::PhaseBake& asset, const StoredTexels& stored) {
    const std::string_view suffix = of_4(stored.channels);
    GlslFunction function;
    if (asset.content == config::PhaseContent::inverse_cumulative) {
        function.comment =
            "Returns 1 - cos(angle). For shares that are uniform in [0, 1] the angles are "
            "distributed as the phase function.";
        function.arguments = "sampler2D table, float share";
        function.value = fmt::format("sampled_angle{}(table, share)", suffix);
    } else {
        function.comment =
            "Returns the phase function in 1/sr. The unit vectors point along the view ray and to "
            "the sun.";
        function.arguments = "sampler2D table, vec3 view, vec3 sun";
        function.value = fmt::format("phase_function{}(table, phase_by_{}(half_angle(view, sun)))",
                                     suffix, stored.mapping);
    }
    return {"phase", {with_wavelengths(stored.channels, std::move(function))}};
}

}  // namespace

Baker<config::PhaseBake> baker(BakerTag<config::PhaseBake>) {
    return {.version = 7,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .variants = {{"size"}, {"pixel_type"}, {"spacing"}}};
}

}  // namespace skybake
