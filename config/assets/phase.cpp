#include "config/assets/phase.h"

#include <fmt/format.h>

#include <span>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/layer.h"
#include "config/sections/particles.h"

namespace skybake::config {
namespace {

constexpr Choice phase_content_choices[] = {
    {PhaseContent::phase, "phase", "the phase function, 1/sr"},
    {PhaseContent::inverse_cumulative, "inverse_cumulative",
     "1 - cosine of the angle below which a share u of light goes"},
};

constexpr Choice spacing_choices[] = {
    {PhaseSpacing::best, "best",
     "the most accurate of angle, cosine and peaks, or the smallest with max_error"},
    {PhaseSpacing::angle, "angle", "uniform in the scattering angle"},
    {PhaseSpacing::cosine, "cosine", "uniform in its cosine"},
    {PhaseSpacing::peaks, "peaks", "closer together towards 0 and 180 deg"},
    {PhaseSpacing::cosine_from_back, "cosine_from_back",
     "uniform in the cosine, from 180 deg to 0, as Bevy reads it"},
};

const Row<PhaseBake> phase_table[] = {
    {"particles", Kind::text, &PhaseBake::particles, "NAME of the [particles.NAME] that scatter",
     Exclusive{"of"}},
    {"layer", Kind::text, &PhaseBake::layer, "NAME of the [atmosphere.layers.NAME] that scatters",
     Exclusive{"of"}},
    {"size", Kind::integer, &PhaseBake::size, "texels", Range{2, 16384}, Default{"1024"},
     Exclusive{"size"}},
    {max_error_field, &PhaseBake::max_error},
    {"content", Kind::choice, &PhaseBake::content, "what the texels hold", phase_content_choices,
     Default{R"("phase")"}},
    {"spacing", Kind::choice, &PhaseBake::spacing, "which angle a texel stands for",
     spacing_choices, Default{R"("best")"}, When{"content", "phase"}},
    {"degree", Kind::integer, &PhaseBake::degree,
     "Legendre moments up to this degree go into the manifest", Range{1, 256}, Default{"16"}},
};

// Finds the particles or the layer of the atmosphere that the bake names. Exactly one of the two
// must be given. Reports E0138, E0140 and E0141.
void resolve_phase(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const DecodedField& particles = bake.at("particles");
    const DecodedField& layer = bake.at("layer");
    if (!particles.source && !layer.source) {
        if (!decoder.complete) return;
        decoder.diagnostics.error(
            "E0141", bake.place,
            fmt::format("[{}] does not say whose phase function to bake", bake.path),
            "name `particles` or a `layer`");
        return;
    }
    if (particles.value) {
        find_named(bake, "particles", std::span<const Particles>(recipe.parameters.particles),
                   particles_reference, decoder);
    }
    if (layer.value) {
        find_named(bake, "layer", std::span<const Layer>(recipe.parameters.atmosphere.layers),
                   layer_reference, decoder);
    }
}

// Lists the values of the particles, or of the layer and the atmosphere's own section. Other layers
// are not listed.
std::vector<Read> reads_of(const Parameters& parameters, const PhaseBake& bake) {
    std::vector<Read> reads = {{""}};
    if (!bake.particles.empty()) {
        append(reads_of_particles(bake.particles), reads);
        return reads;
    }
    reads.push_back({"atmosphere", Roles::all()});
    for (const Layer& layer : parameters.atmosphere.layers) {
        if (layer.name == bake.layer) append(reads_of_layer(layer, Roles::all()), reads);
    }
    return reads;
}

}  // namespace

AssetKind asset_kind(Tag<PhaseBake>) {
    return make_asset_kind<PhaseBake>(
        {.name = "phase",
         .documentation = "how particles or a layer scatter, by angle",
         .is_table = true,
         .use_of_light = UseOfLight::factors},
        with_file_fields(phase_table, table_files), reads_of, resolve_phase);
}

}  // namespace skybake::config
