// The tables themselves, but for those of the sky's views, noises, clouds and volumes, which have
// files of their own
// (noise_field_tables.cpp and so on). Whoever adds a key adds it here, and a member of the same
// name in parameters.h; everything else follows.
#include "config/assets/shared_fields.h"
#include "config/assets/sky_fields.h"
#include "config/fields/fields.h"
#include "config/fields/shared_ranges.h"

namespace skybake::config {
namespace {

// Ranges. The outer bounds are wider than any planet and narrower than anything that would overflow
// a double when squared, so that the bakers need not ask again.
constexpr Range radius_range{1, 1e12};
constexpr Range altitude_range{-1e9, 1e12};
constexpr Range thickness_range{1e-3, 1e9};
constexpr Range wavelength_range{1e-8, 1e-3};
constexpr Range number_density_range{1e-12, 1e30};
constexpr Range albedo_of_scattering_range{1e-6, 1};
constexpr Range asymmetry_range{-1, 1, true, true};
constexpr Range degree_range{2, 8};

constexpr std::string_view bruneton_2008 =
    "Bruneton and Neyret 2008, Precomputed Atmospheric Scattering";
constexpr std::string_view henyey_1941 = "Henyey and Greenstein 1941; Cornette and Shanks 1992";

// Choices, each in the order of its enumeration in parameters.h.
constexpr std::array profile_choices = {
    Choice{"exponential", "exp(-altitude / scale_height)"},
    Choice{"tent", "1 at center_altitude, falling linearly to 0 half_width above and below"},
    Choice{"slab", "1 between bottom_altitude and top_altitude, 0 elsewhere"},
    Choice{"tabulated", "linear between the entries of table, 0 outside"},
};
constexpr std::array phase_choices = {
    Choice{"isotropic", "the same in all directions"},
    Choice{"rayleigh", "molecules: 3/(16 pi) (1 + cos^2)"},
    Choice{"henyey_greenstein", "haze and dust, one parameter g"},
    Choice{"cornette_shanks", "Henyey-Greenstein with a Rayleigh-like back; Rayleigh at g = 0"},
    Choice{"mie", "the phase function of [particles.NAME], and with it scattering and extinction"},
};
constexpr std::array transmittance_content_choices = {
    Choice{"transmittance", "the share of light that passes, in [0, 1]"},
    Choice{"optical_depth",
           "-ln of the transmittance, which keeps its digits where the transmittance underflows"},
};
constexpr std::array transmittance_mapping_choices = {
    Choice{"bruneton", "ratios of distances, with end points on texel centres"},
    Choice{"ue", "the same ratios without the half-texel correction, as widely copied"},
};
constexpr std::array multiple_scattering_mapping_choices = {
    Choice{"hillaire", "linear in sun cosine and altitude, with end points on texel centres"},
    Choice{"twilight", "more texels near sunrise and sunset"},
};
constexpr std::array method_choices = {
    Choice{"converged", "quadrature split at the horizon, with as many nodes as the error needs"},
    Choice{"as_in_paper", "64 uniform directions of 20 steps each, for comparison"},
    Choice{"solved", "all orders of scattering, each layer with its own phase function"},
};
constexpr std::array solved_content_choices = {
    Choice{"hillaire", "the mean radiance, in place of Hillaire's texture"},
    Choice{"fitted",
           "the value that comes nearest to the sky when light is scattered equally in all "
           "directions"},
    Choice{"moments", "angular moments of the light, one table each"},
};

// For which profiles and phases a key has a meaning.
constexpr std::string_view exponential[] = {"exponential"};
constexpr std::string_view tent[] = {"tent"};
constexpr std::string_view slab[] = {"slab"};
constexpr std::string_view tabulated[] = {"tabulated"};
constexpr std::string_view solved[] = {"solved"};
constexpr std::string_view unsolved[] = {"converged", "as_in_paper"};
constexpr std::string_view moments[] = {"moments"};
constexpr std::string_view mie[] = {"mie"};
constexpr std::string_view with_asymmetry[] = {"henyey_greenstein", "cornette_shanks"};

const std::array root_table = {
    RootField{{.key = "format",
               .kind = Kind::integer,
               .range = {1, 1},
               .fallback = "1",
               .documentation = "version of the recipe's language, which may be left out",
               .range_code = "E0119",
               .only_shown = true},
              {}},
    RootField{{.key = "preset",
               .kind = Kind::text,
               .documentation = "name of a preset to start from, without its [bake.*] sections",
               .only_shown = true},
              {}},
    RootField{{.key = "include",
               .kind = Kind::text_list,
               .documentation = "recipes to read before this one, relative to its folder",
               .only_shown = true},
              {}},
    RootField{{.key = "wavelengths",
               .kind = Kind::wavelengths,
               .range = wavelength_range,
               .fallback = R"(["680 nm", "550 nm", "440 nm"])",
               .documentation = "wavelengths, one per channel: three (R, G, B) or one (Y)",
               .hint = "visible light is 380 nm to 750 nm",
               .citation = bruneton_2008},
              &Parameters::wavelengths},
};

const std::array atmosphere_table = {
    AtmosphereField{{.key = "ground_radius",
                     .kind = Kind::length,
                     .range = radius_range,
                     .required = true,
                     .documentation = "distance from the planet's centre to the ground",
                     .hint = "the Earth has 6360 km"},
                    &Atmosphere::ground_radius},
    AtmosphereField{
        {.key = "top_radius",
         .kind = Kind::length,
         .range = radius_range,
         .required = true,
         .documentation = "distance from the planet's centre to where the atmosphere is cut off",
         .hint = "60 to 100 km above the Earth's ground"},
        &Atmosphere::top_radius},
    AtmosphereField{{.key = "ground_albedo",
                     .kind = Kind::fractions,
                     .range = unit_range,
                     .fallback = "0",
                     .documentation = "share of the light that the ground reflects (Lambert)",
                     .hint = "the Earth's mean is 0.3"},
                    &Atmosphere::ground_albedo},
};

const std::array layer_table = {
    LayerField{{.key = "preset",
                .kind = Kind::text,
                .documentation = "name of a preset of a layer to start from",
                .only_shown = true},
               {}},
    LayerField{{.key = "enabled",
                .kind = Kind::flag,
                .fallback = "true",
                .documentation = "false drops the layer",
                .only_shown = true},
               &Layer::enabled},
    LayerField{{.key = "profile",
                .kind = Kind::choice,
                .choices = profile_choices,
                .required = true,
                .documentation = "how density changes with altitude"},
               &Layer::profile},
    LayerField{{.key = "scale_height",
                .kind = Kind::length,
                .range = thickness_range,
                .required = true,
                .documentation = "altitude over which the density falls by a factor of e",
                .hint = "air has 8 km, haze 1.2 km",
                .citation = bruneton_2008,
                .selector = "profile",
                .selected_by = exponential},
               &Layer::scale_height},
    LayerField{{.key = "center_altitude",
                .kind = Kind::length,
                .range = altitude_range,
                .required = true,
                .documentation = "altitude of the largest density",
                .hint = "ozone has 25 km",
                .citation = bruneton_2017,
                .selector = "profile",
                .selected_by = tent},
               &Layer::center_altitude},
    LayerField{
        {.key = "half_width",
         .kind = Kind::length,
         .range = thickness_range,
         .required = true,
         .documentation = "distance from the largest density to zero: half the base of the tent",
         .hint = "ozone has 15 km; its \"width of 30 km\" is the whole base",
         .citation = bruneton_2017,
         .selector = "profile",
         .selected_by = tent},
        &Layer::half_width},
    LayerField{{.key = "bottom_altitude",
                .kind = Kind::length,
                .range = altitude_range,
                .required = true,
                .documentation = "lower bound of the slab",
                .selector = "profile",
                .selected_by = slab},
               &Layer::bottom_altitude},
    LayerField{{.key = "top_altitude",
                .kind = Kind::length,
                .range = altitude_range,
                .required = true,
                .documentation = "upper bound of the slab",
                .selector = "profile",
                .selected_by = slab},
               &Layer::top_altitude},
    LayerField{
        {.key = "table",
         .kind = Kind::density_table,
         .range = density_range,
         .required = true,
         .documentation = "pairs [altitude, density] with altitudes that increase from at least 0",
         .selector = "profile",
         .selected_by = tabulated},
        &Layer::table},
    LayerField{{.key = "scattering",
                .kind = Kind::coefficients,
                .range = coefficient_range,
                .fallback = R"("0 /m")",
                .documentation = "scattering coefficient where the density is 1",
                .hint = "air has 5.8e-6, 1.36e-5, 3.31e-5 /m"},
               &Layer::scattering},
    LayerField{{.key = "extinction",
                .kind = Kind::coefficients,
                .range = coefficient_range,
                .documentation = "scattering plus absorption where the density is 1",
                .hint = "haze has 4.44e-6 /m, which the table in Hillaire 2020 calls absorption",
                .citation = bruneton_2008,
                .exclusive_group = "extinction"},
               &Layer::extinction},
    LayerField{
        {.key = "absorption",
         .kind = Kind::coefficients,
         .range = coefficient_range,
         .documentation = "absorption coefficient where the density is 1; without it there is none",
         .hint = "ozone has 6.5e-7, 1.881e-6, 8.5e-8 /m",
         .citation = hillaire_2020,
         .exclusive_group = "extinction",
         .only_shown = true},
        {}},
    LayerField{{.key = "single_scattering_albedo",
                .kind = Kind::fractions,
                .range = albedo_of_scattering_range,
                .documentation = "scattering as a share of extinction",
                .hint = "haze has 0.9",
                .exclusive_group = "extinction",
                .only_shown = true},
               {}},
    LayerField{{.key = "phase",
                .kind = Kind::choice,
                .choices = phase_choices,
                .fallback = R"("isotropic")",
                .documentation = "where scattered light goes; { mie = \"NAME\" } names particles",
                .citation = henyey_1941},
               &Layer::phase},
    LayerField{{.key = "g",
                .kind = Kind::number,
                .range = asymmetry_range,
                .required = true,
                .documentation = "asymmetry of the phase function: forward above 0, back below",
                .hint = "typical haze has 0.76",
                .citation = henyey_1941,
                .selector = "phase",
                .selected_by = with_asymmetry},
               &Layer::g},
    LayerField{{.key = "particles",
                .kind = Kind::text,
                .required = true,
                .documentation = "NAME of the [particles.NAME] that the layer is made of",
                .selector = "phase",
                .selected_by = mie},
               {}},
    LayerField{{.key = "number_density",
                .kind = Kind::number_density,
                .range = number_density_range,
                .required = true,
                .documentation = "particles per volume where the density is 1",
                .hint = "haze has 1e3 to 1e4 /cm3, fog 10 to 100 /cm3, rain 1e3 /m3",
                .selector = "phase",
                .selected_by = mie},
               {}},
};

// Keys that both tables of the sky share are described once.
constexpr Field max_error_field{
    .key = "max_error",
    .kind = Kind::fraction,
    .range = lookup_error_range,
    .documentation =
        "in place of size, asks for the smallest table whose lookups are within this error",
    .hint = "errors below 0.01 are invisible",
    .exclusive_group = "size"};

const std::array transmittance_table = {
    TransmittanceField{asset_field, {}},
    TransmittanceField{{.key = "size",
                        .kind = Kind::size,
                        .range = texel_range,
                        .fallback = "[256, 64]",
                        .documentation = "texels along the zenith angle and along altitude",
                        .citation = bruneton_2008,
                        .exclusive_group = "size"},
                       &TransmittanceBake::size},
    TransmittanceField{max_error_field, &TransmittanceBake::max_error},
    TransmittanceField{{.key = "content",
                        .kind = Kind::choice,
                        .choices = transmittance_content_choices,
                        .fallback = R"("transmittance")",
                        .documentation = "what the texels hold"},
                       &TransmittanceBake::content},
    TransmittanceField{{.key = "mapping",
                        .kind = Kind::choice,
                        .choices = transmittance_mapping_choices,
                        .fallback = R"("bruneton")",
                        .documentation = "which angle and altitude a texel stands for",
                        .citation = bruneton_2008},
                       &TransmittanceBake::mapping},
    TransmittanceField{table_pixel_type_field, &TransmittanceBake::pixel_type},
    TransmittanceField{compression_field, &TransmittanceBake::compression},
};

const std::array multiple_scattering_table = {
    MultipleScatteringField{asset_field, {}},
    MultipleScatteringField{{.key = "size",
                             .kind = Kind::size,
                             .range = texel_range,
                             .fallback = "[32, 32]",
                             .documentation = "texels along the sun cosine and along altitude",
                             .citation = hillaire_2020,
                             .exclusive_group = "size"},
                            &MultipleScatteringBake::size},
    MultipleScatteringField{max_error_field, &MultipleScatteringBake::max_error},
    MultipleScatteringField{{.key = "mapping",
                             .kind = Kind::choice,
                             .choices = multiple_scattering_mapping_choices,
                             .fallback = R"("hillaire")",
                             .documentation = "which sun angle and altitude a texel stands for",
                             .citation = hillaire_2020},
                            &MultipleScatteringBake::mapping},
    MultipleScatteringField{{.key = "method",
                             .kind = Kind::choice,
                             .choices = method_choices,
                             .fallback = R"("converged")",
                             .documentation = "quadrature over directions and along rays",
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
    MultipleScatteringField{table_pixel_type_field, &MultipleScatteringBake::pixel_type},
    MultipleScatteringField{compression_field, &MultipleScatteringBake::compression},
};

}  // namespace

std::span<const RootField> root_fields() { return root_table; }

std::span<const AtmosphereField> atmosphere_fields() { return atmosphere_table; }

std::span<const LayerField> layer_fields() { return layer_table; }

std::span<const TransmittanceField> transmittance_fields() { return transmittance_table; }

std::span<const MultipleScatteringField> multiple_scattering_fields() {
    return multiple_scattering_table;
}

}  // namespace skybake::config
