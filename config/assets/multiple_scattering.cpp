#include "config/assets/multiple_scattering.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

constexpr Choice method_choices[] = {
    {MultipleScatteringMethod::converged, "converged",
     "Hillaire's closure of the second order, by as many nodes as the error needs"},
    {MultipleScatteringMethod::solved, "solved",
     "all orders of scattering, each layer with its own phase function"},
};

constexpr Choice solved_content_choices[] = {
    {MultipleScatteringContent::hillaire, "hillaire",
     "the mean radiance, in place of Hillaire's texture"},
    {MultipleScatteringContent::moments, "moments", "angular moments of the light, one table each"},
};

const Row<MultipleScatteringBake> multiple_scattering_table[] = {
    {"size", Kind::size, &MultipleScatteringBake::size,
     "texels along the sun cosine and along altitude", texel_range, Default{"[64, 64]"},
     Exclusive{"size"}, Cited{hillaire_2020}},
    {max_error_field, &MultipleScatteringBake::max_error},
    {"mapping", Kind::choice, &MultipleScatteringBake::mapping,
     "which sun angle and altitude a texel stands for", sun_mapping_choices,
     Default{R"("twilight")"}, Cited{hillaire_2020}},
    {"method", Kind::choice, &MultipleScatteringBake::method, "how the light is computed",
     method_choices, Default{R"("solved")"}, Cited{hillaire_2020}},
    {"max_texel_error", Kind::fraction, &MultipleScatteringBake::max_texel_error,
     "quadrature error of a texel, which sets the number of nodes", texel_error_range,
     Default{R"("0.2 %")"}, When{"method", "converged"}},
    {"content", Kind::choice, &MultipleScatteringBake::content,
     "which part of the solution the texels hold", solved_content_choices, Default{R"("hillaire")"},
     When{"method", "solved"}},
    {"degree", Kind::integer, &MultipleScatteringBake::degree,
     "degree of the moments; 2 holds Rayleigh scattering exactly", Range{2, 8}, Default{"2"},
     When{"content", "moments"}},
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

AssetKind asset_kind(Tag<MultipleScatteringBake>) {
    return make_asset_kind<MultipleScatteringBake>(
        {.name = "multiple_scattering",
         .documentation = "the light scattered twice or more, per unit of scattering",
         .is_table = true,
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::channels},
        with_file_fields(multiple_scattering_table, table_files), reads_of);
}

}  // namespace skybake::config
