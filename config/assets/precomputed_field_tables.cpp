// The field tables of the precomputed tables of other models: Bruneton's scattering, the columns of
// Ai et al.; field_tables.cpp says how such tables work.
#include "config/assets/volume_fields.h"
#include "config/fields/fields.h"
#include "config/fields/shared_ranges.h"

namespace skybake::config {
namespace {

constexpr Range nu_range{1, 1024};
constexpr Range orders_range{1, 1000};
constexpr Range sun_cosine_range{-1, 0, false, true};
constexpr Range solar_range{0, 1e6, true};
constexpr Range shells_range{1, 4096};
constexpr Range shell_altitude_range{1, 1e9};

constexpr std::string_view ai_2014 = "Ai et al. 2014";

// Choices, each in the order of its enumeration in parameters.h.
constexpr std::array bruneton_table_choices = {
    Choice{"transmittance", "transmittance to the top of the atmosphere"},
    Choice{"scattering", "light scattered towards a view ray, by nu, sun, view and altitude"},
    Choice{"single_mie", "the first order of the Mie layers on its own"},
    Choice{"higher_orders", "all orders from the second on, on their own"},
    Choice{"irradiance", "irradiance of a level surface by the sky"},
};
constexpr std::array convention_choices = {
    Choice{"bruneton", "the layout of the textures of the implementation of 2017"},
    Choice{"takram",
           "the layout that @takram/three-atmosphere loads: EXR files upside down, with its "
           "parameters"},
};
constexpr std::array bruneton_method_choices = {
    Choice{"solved", "orders from the second on, from a solution of all light"},
    Choice{"iterated", "order after order on the table's own grid, as published"},
};
constexpr std::array depth_table_choices = {
    Choice{"to_top", "column from a point to the top of the atmosphere, by angle and altitude"},
    Choice{"between", "column between two points"},
    Choice{"density", "density by altitude"},
    Choice{"phase", "phase functions, by scattering angle"},
};
constexpr std::array coordinates_choices = {
    Choice{"altitudes", "two altitudes and the angle between them at the planet's centre"},
    Choice{"distance", "altitude, zenith angle, distance along the ray"},
};
constexpr std::array sampling_choices = {
    Choice{"exact", "quadrature to the last digit"},
    Choice{"equal_attenuation",
           "shells that attenuate light from above equally, with one sample in each"},
    Choice{"uniform", "shells of equal thickness, with one sample in each"},
};

constexpr std::string_view by_nu[] = {"scattering", "single_mie", "higher_orders"};
constexpr std::string_view scattering[] = {"scattering"};
constexpr std::string_view with_light[] = {"scattering", "single_mie", "higher_orders",
                                           "irradiance"};
constexpr std::string_view with_orders[] = {"scattering", "higher_orders", "irradiance"};
constexpr std::string_view with_method[] = {"scattering", "higher_orders"};
constexpr std::string_view of_columns[] = {"to_top", "between"};
constexpr std::string_view between[] = {"between"};
constexpr std::string_view shells[] = {"equal_attenuation", "uniform"};

const std::array bruneton_table = {
    BrunetonField{asset_field, {}},
    BrunetonField{{.key = "table",
                   .kind = Kind::choice,
                   .choices = bruneton_table_choices,
                   .fallback = R"("scattering")",
                   .documentation = "which of the tables to bake",
                   .citation = bruneton_2017},
                  &BrunetonBake::table},
    BrunetonField{{.key = "convention",
                   .kind = Kind::choice,
                   .choices = convention_choices,
                   .fallback = R"("bruneton")",
                   .documentation = "the reader that the files are for"},
                  &BrunetonBake::convention},
    BrunetonField{
        {.key = "size",
         .kind = Kind::voxels,
         .range = voxel_range,
         .documentation = "texels along u, v, w; by default [256, 128, 32] of scattering, [256, "
                          "64, 1] of transmittance, [64, 16, 1] of irradiance",
         .citation = bruneton_2017},
        &BrunetonBake::size},
    BrunetonField{{.key = "nu_size",
                   .kind = Kind::integer,
                   .range = nu_range,
                   .fallback = "8",
                   .documentation = "number of angles between view and sun, side by side along u",
                   .citation = bruneton_2017,
                   .selector = "table",
                   .selected_by = by_nu},
                  &BrunetonBake::nu_size},
    BrunetonField{{.key = "combined",
                   .kind = Kind::flag,
                   .fallback = "true",
                   .documentation = "whether A holds the Mie layers' first order, red alone; "
                                    "otherwise the table is R G B, and single_mie holds that order",
                   .selector = "table",
                   .selected_by = scattering},
                  &BrunetonBake::combined},
    BrunetonField{{.key = "orders",
                   .kind = Kind::levels,
                   .range = orders_range,
                   .fallback = R"("all")",
                   .documentation = "number of orders of scattering, with the first",
                   .hint = "Bruneton uses 4",
                   .selector = "table",
                   .selected_by = with_orders},
                  &BrunetonBake::orders},
    BrunetonField{
        {.key = "method",
         .kind = Kind::choice,
         .choices = bruneton_method_choices,
         .fallback = R"("solved")",
         .documentation = "where the higher orders come from; for iterated, \"all\" orders are 4",
         .selector = "table",
         .selected_by = with_method},
        &BrunetonBake::method},
    BrunetonField{{.key = "sun_cos_zenith_min",
                   .kind = Kind::number,
                   .range = sun_cosine_range,
                   .documentation = "where the sun's axis begins; by default -0.5 for takram, as "
                                    "its loader expects, and else cos 102 deg",
                   .citation = bruneton_2017,
                   .selector = "table",
                   .selected_by = by_nu},
                  &BrunetonBake::sun_cos_zenith_min},
    BrunetonField{{.key = "mie_layers",
                   .kind = Kind::text_list,
                   .documentation = "layers whose first order is kept apart; by default those with "
                                    "phase functions other than rayleigh and isotropic",
                   .hint = "[\"mie\"]",
                   .selector = "table",
                   .selected_by = by_nu},
                  &BrunetonBake::mie_layers},
    BrunetonField{{.key = "solar_irradiance",
                   .kind = Kind::fractions,
                   .range = solar_range,
                   .documentation = "factor of all light; by default 1, or takram's own",
                   .selector = "table",
                   .selected_by = with_light},
                  &BrunetonBake::solar_irradiance},
};

const std::array optical_depth_table = {
    OpticalDepthField{asset_field, {}},
    OpticalDepthField{{.key = "table",
                       .kind = Kind::choice,
                       .choices = depth_table_choices,
                       .fallback = R"("to_top")",
                       .documentation = "which of the tables to bake",
                       .citation = ai_2014},
                      &OpticalDepthBake::table},
    OpticalDepthField{{.key = "size",
                       .kind = Kind::voxels,
                       .range = voxel_range,
                       .documentation = "texels along u, v, w; by default [256, 128, 1] of to_top, "
                                        "[64, 64, 64] of between, [1024, 1, 1] of the others"},
                      &OpticalDepthBake::size},
    OpticalDepthField{
        {.key = "kinds",
         .kind = Kind::text_list,
         .documentation =
             "one to four layers of the atmosphere, each a channel; by default all of them",
         .hint = "for example [\"air\", \"dust\", \"fog\", \"rain\"]"},
        &OpticalDepthBake::kinds},
    OpticalDepthField{{.key = "coordinates",
                       .kind = Kind::choice,
                       .choices = coordinates_choices,
                       .fallback = R"("altitudes")",
                       .documentation = "how the two points are given",
                       .citation = ai_2014,
                       .selector = "table",
                       .selected_by = between},
                      &OpticalDepthBake::coordinates},
    OpticalDepthField{{.key = "sampling",
                       .kind = Kind::choice,
                       .choices = sampling_choices,
                       .fallback = R"("exact")",
                       .documentation = "how densities are summed along a ray",
                       .citation = ai_2014,
                       .selector = "table",
                       .selected_by = of_columns},
                      &OpticalDepthBake::sampling},
    OpticalDepthField{{.key = "shells",
                       .kind = Kind::integer,
                       .range = shells_range,
                       .fallback = "32",
                       .documentation = "number of shells",
                       .selector = "sampling",
                       .selected_by = shells},
                      &OpticalDepthBake::shells},
    OpticalDepthField{{.key = "max_altitude",
                       .kind = Kind::length,
                       .range = shell_altitude_range,
                       .fallback = R"("35 km")",
                       .documentation = "altitude of the highest shell; the air above is left out",
                       .citation = ai_2014,
                       .selector = "sampling",
                       .selected_by = shells},
                      &OpticalDepthBake::max_altitude},
};

}  // namespace

std::span<const BrunetonField> bruneton_fields() {
    static const auto table = with_file_fields(bruneton_table, {.formats = R"(["exr"])"});
    return table;
}

std::span<const OpticalDepthField> optical_depth_fields() {
    static const auto table = with_file_fields(
        optical_depth_table, {.formats = R"(["exr"])", .pixel_type = R"("float")"});
    return table;
}

}  // namespace skybake::config
