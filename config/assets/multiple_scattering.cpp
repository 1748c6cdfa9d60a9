#include "config/assets/multiple_scattering.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

using MultipleScatteringField = Row<MultipleScatteringBake>;

constexpr Range degree_range{2, 8};

constexpr std::array multiple_scattering_mapping_choices = {
    Choice{MultipleScatteringMapping::hillaire, "hillaire",
           "linear in sun cosine and altitude, with end points on texel centres"},
    Choice{MultipleScatteringMapping::twilight, "twilight", "more texels near sunrise and sunset"},
};

constexpr std::array method_choices = {
    Choice{MultipleScatteringMethod::converged, "converged",
           "Hillaire's closure of the second order, by as many nodes as the error needs"},
    Choice{MultipleScatteringMethod::as_in_paper, "as_in_paper",
           "the same by 64 uniform directions of 20 steps each, for comparison"},
    Choice{MultipleScatteringMethod::solved, "solved",
           "all orders of scattering, each layer with its own phase function"},
};

constexpr std::array solved_content_choices = {
    Choice{MultipleScatteringContent::hillaire, "hillaire",
           "the mean radiance, in place of Hillaire's texture"},
    Choice{MultipleScatteringContent::fitted, "fitted",
           "the value that comes nearest to the sky when light is scattered equally in all "
           "directions"},
    Choice{MultipleScatteringContent::moments, "moments",
           "angular moments of the light, one table each"},
};

constexpr std::string_view solved[] = {"solved"};

constexpr std::string_view unsolved[] = {"converged", "as_in_paper"};

constexpr std::string_view moments[] = {"moments"};

const std::array multiple_scattering_table = {
    MultipleScatteringField{asset_field, {}},
    MultipleScatteringField{{.key = "size",
                             .kind = Kind::size,
                             .range = texel_range,
                             .fallback = "[64, 64]",
                             .documentation = "texels along the sun cosine and along altitude",
                             .citation = hillaire_2020,
                             .exclusive_group = "size"},
                            &MultipleScatteringBake::size},
    MultipleScatteringField{max_error_field, &MultipleScatteringBake::max_error},
    MultipleScatteringField{{.key = "mapping",
                             .kind = Kind::choice,
                             .choices = multiple_scattering_mapping_choices,
                             .fallback = R"("twilight")",
                             .documentation = "which sun angle and altitude a texel stands for",
                             .citation = hillaire_2020},
                            &MultipleScatteringBake::mapping},
    MultipleScatteringField{{.key = "method",
                             .kind = Kind::choice,
                             .choices = method_choices,
                             .fallback = R"("solved")",
                             .documentation = "how the light is computed",
                             .citation = hillaire_2020},
                            &MultipleScatteringBake::method},
    MultipleScatteringField{
        {.key = "max_texel_error",
         .kind = Kind::fraction,
         .range = texel_error_range,
         .fallback = R"("0.2 %")",
         .documentation = "quadrature error of a texel, which sets the number of nodes",
         .selector = "method",
         .selected_by = unsolved},
        &MultipleScatteringBake::max_texel_error},
    MultipleScatteringField{{.key = "content",
                             .kind = Kind::choice,
                             .choices = solved_content_choices,
                             .fallback = R"("hillaire")",
                             .documentation = "which part of the solution the texels hold",
                             .selector = "method",
                             .selected_by = solved},
                            &MultipleScatteringBake::content},
    MultipleScatteringField{
        {.key = "degree",
         .kind = Kind::integer,
         .range = degree_range,
         .fallback = "2",
         .documentation = "degree of the moments; 2 holds Rayleigh scattering exactly",
         .selector = "content",
         .selected_by = moments},
        &MultipleScatteringBake::degree},
};

std::vector<Read> reads_of(const Parameters& parameters, const MultipleScatteringBake& bake) {
    const Roles coefficients = {Role::geometry, Role::extinction, Role::scattering, Role::ground};
    if (bake.method != MultipleScatteringMethod::solved) {
        return reads_of_light(parameters, coefficients);
    }
    const Roles phases = {Role::geometry, Role::extinction, Role::scattering, Role::ground,
                          Role::phase};
    std::vector<Read> reads = reads_of_light(parameters, phases);
    reads.push_back({"scene"});
    return reads;
}

}  // namespace

const AssetKind& asset_kind(Tag<MultipleScatteringBake>) {
    static const auto rows = with_file_fields(multiple_scattering_table, table_files);
    static const AssetKind kind = make_asset_kind<MultipleScatteringBake>(
        {
            .name = "multiple_scattering",
            .documentation = "the light scattered twice or more, per unit of scattering",
            .is_table = true,
            .needs_atmosphere = true,
            .use_of_light = UseOfLight::channels,
        },
        std::span<const MultipleScatteringField>(rows), reads_of);
    return kind;
}

}  // namespace skybake::config
