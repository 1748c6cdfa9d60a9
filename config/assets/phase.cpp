#include "config/assets/phase.h"

#include <fmt/format.h>

#include <span>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

using PhaseField = Row<PhaseBake>;

constexpr Range phase_texel_range{2, 16384};

constexpr Range phase_degree_range{1, 256};

constexpr std::array phase_content_choices = {
    Choice{PhaseContent::phase, "phase", "the phase function, 1/sr"},
    Choice{PhaseContent::inverse_cumulative, "inverse_cumulative",
           "1 - cosine of the angle below which a share u of light goes"},
};

constexpr std::array spacing_choices = {
    Choice{PhaseSpacing::best, "best",
           "the most accurate of angle, cosine and peaks, or the smallest with max_error"},
    Choice{PhaseSpacing::angle, "angle", "uniform in the scattering angle"},
    Choice{PhaseSpacing::cosine, "cosine", "uniform in its cosine"},
    Choice{PhaseSpacing::peaks, "peaks", "closer together towards 0 and 180 deg"},
    Choice{PhaseSpacing::cosine_from_back, "cosine_from_back",
           "uniform in the cosine, from 180 deg to 0, as Bevy reads it"},
};

constexpr std::string_view phase[] = {"phase"};

const std::array phase_table = {
    PhaseField{asset_field, {}},
    PhaseField{{.key = "particles",
                .kind = Kind::text,
                .documentation = "NAME of the [particles.NAME] that scatter",
                .exclusive_group = "of"},
               &PhaseBake::particles},
    PhaseField{{.key = "layer",
                .kind = Kind::text,
                .documentation = "NAME of the [atmosphere.layers.NAME] that scatters",
                .exclusive_group = "of"},
               &PhaseBake::layer},
    PhaseField{{.key = "size",
                .kind = Kind::integer,
                .range = phase_texel_range,
                .fallback = "1024",
                .documentation = "texels",
                .exclusive_group = "size"},
               &PhaseBake::size},
    PhaseField{
        {.key = "max_error",
         .kind = Kind::fraction,
         .range = lookup_error_range,
         .documentation =
             "in place of size, asks for the smallest table whose lookups are within this error",
         .hint = "errors below 0.01 are invisible",
         .exclusive_group = "size"},
        &PhaseBake::max_error},
    PhaseField{{.key = "content",
                .kind = Kind::choice,
                .choices = phase_content_choices,
                .fallback = R"("phase")",
                .documentation = "what the texels hold"},
               &PhaseBake::content},
    PhaseField{{.key = "spacing",
                .kind = Kind::choice,
                .choices = spacing_choices,
                .fallback = R"("best")",
                .documentation = "which angle a texel stands for",
                .selector = "content",
                .selected_by = phase},
               &PhaseBake::spacing},
    PhaseField{{.key = "degree",
                .kind = Kind::integer,
                .range = phase_degree_range,
                .fallback = "16",
                .documentation = "Legendre moments up to this degree go into the manifest"},
               &PhaseBake::degree},
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

const AssetKind& asset_kind(Tag<PhaseBake>) {
    static const auto rows = with_file_fields(phase_table, table_files);
    static const AssetKind kind = make_asset_kind<PhaseBake>(
        {
            .name = "phase",
            .documentation = "how particles or a layer scatter, by angle",
            .is_table = true,
            .use_of_light = UseOfLight::factors,
        },
        std::span<const PhaseField>(rows), reads_of, resolve_phase);
    return kind;
}

}  // namespace skybake::config
