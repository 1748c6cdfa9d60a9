#include "config/assets/bruneton.h"

#include <algorithm>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/bruneton_checks.h"
#include "config/assets/file_decoder.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

using BrunetonField = Row<BrunetonBake>;

constexpr Range nu_range{1, 1024};

constexpr Range orders_range{1, 1000};

constexpr Range sun_cosine_range{-1, 0, false, true};

constexpr Range solar_range{0, 1e6, true};

constexpr std::array bruneton_table_choices = {
    Choice{BrunetonTable::transmittance, "transmittance",
           "transmittance to the top of the atmosphere"},
    Choice{BrunetonTable::scattering, "scattering",
           "light scattered towards a view ray, by nu, sun, view and altitude"},
    Choice{BrunetonTable::single_mie, "single_mie", "the first order of the Mie layers on its own"},
    Choice{BrunetonTable::higher_orders, "higher_orders",
           "all orders from the second on, on their own"},
    Choice{BrunetonTable::irradiance, "irradiance", "irradiance of a level surface by the sky"},
};

constexpr std::array convention_choices = {
    Choice{BrunetonConvention::bruneton, "bruneton",
           "the layout of the textures of the implementation of 2017"},
    Choice{BrunetonConvention::takram, "takram",
           "the layout that @takram/three-atmosphere loads: EXR files upside down, with its "
           "parameters"},
    Choice{BrunetonConvention::calcmysky, "calcmysky",
           "the sun's axis of CalcMySky and Stellarium"},
};

constexpr std::array bruneton_method_choices = {
    Choice{BrunetonMethod::solved, "solved",
           "orders from the second on, from a solution of all light"},
    Choice{BrunetonMethod::iterated, "iterated",
           "order after order on the table's own grid, as published"},
};

constexpr std::string_view by_nu[] = {"scattering", "single_mie", "higher_orders"};
constexpr std::string_view scattering[] = {"scattering"};
constexpr std::string_view with_light[] = {"scattering", "single_mie", "higher_orders",
                                           "irradiance"};

constexpr std::string_view with_orders[] = {"scattering", "higher_orders", "irradiance"};

constexpr std::string_view with_method[] = {"scattering", "higher_orders"};

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
                   .documentation = "whether A holds the Mie layers' first order, red alone, as "
                                    "takram's loader expects, for which it is true by default; "
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
                                    "its loader expects, -R / (2 R_top) for calcmysky, which takes "
                                    "no other, and else cos 102 deg",
                   .citation = bruneton_2017,
                   .selector = "table",
                   .selected_by = by_nu},
                  &BrunetonBake::sun_cos_zenith_min},
    BrunetonField{{.key = "mie_layers",
                   .kind = Kind::text_list,
                   .documentation = "layers whose first order is kept apart; by default those with "
                                    "phase functions other than rayleigh and isotropic",
                   .hint = "for example [\"aerosol\"]",
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

// This is the cosine of 102 deg. Below it, Bruneton's half floats hold no light. takram uses the
// cosine of 120 deg.
constexpr double bruneton_sun_cosine = -0.20791169081775934;
constexpr double takram_sun_cosine = -0.5;

// These are the solar irradiances of R, G and B in W / m^2 / nm, at 680, 550 and 440 nm (ASTM
// E-490), as takram uses them.
constexpr std::array takram_solar_irradiance = {1.474, 1.8504, 1.91198};

// CalcMySky's axis begins at the sun whose ray from the ground to the top is as long as R_top. By the
// law of cosines, R_top^2 = R^2 + D^2 + 2 R D cos, the cosine is -R / (2 R_top).
double calcmysky_sun_cosine(const Atmosphere& atmosphere) {
    return -atmosphere.ground_radius.meters / (2 * atmosphere.top_radius.meters);
}

double default_sun_cosine(BrunetonConvention convention, const Parameters& recipe) {
    switch (convention) {
        case BrunetonConvention::takram:
            return takram_sun_cosine;
        case BrunetonConvention::calcmysky:
            return calcmysky_sun_cosine(recipe.atmosphere);
        case BrunetonConvention::bruneton:
            break;
    }
    return bruneton_sun_cosine;
}

VoxelCounts default_size(BrunetonTable table) {
    switch (table) {
        case BrunetonTable::transmittance:
            return {256, 64, 1};
        case BrunetonTable::irradiance:
            return {64, 16, 1};
        default:
            return {256, 128, 32};
    }
}

bool is_peaked(const Layer& layer) {
    return layer.phase != Phase::rayleigh && layer.phase != Phase::isotropic;
}

bool scatters(const Layer& layer) {
    return layer.phase == Phase::mie ||
           std::any_of(layer.scattering.begin(), layer.scattering.end(),
                       [](InverseLength value) { return value.per_meter > 0; });
}

std::vector<std::string> peaked_layers(const Atmosphere& atmosphere) {
    std::vector<std::string> names;
    for (const Layer& layer : atmosphere.layers) {
        if (is_peaked(layer) && scatters(layer)) names.push_back(layer.name);
    }
    return names;
}

// The colours of sunlight are 1 already.
std::vector<double> default_solar_irradiance(BrunetonConvention convention,
                                             const Parameters& recipe) {
    const std::size_t channels = channels_of_light(recipe);
    const bool takram = convention == BrunetonConvention::takram;
    if (takram && !holds_colors(recipe) && channels == takram_solar_irradiance.size()) {
        return {takram_solar_irradiance.begin(), takram_solar_irradiance.end()};
    }
    return std::vector<double>(channels, 1);
}

// Fills in the values that depend on the table, the convention and the layers. It reports a size
// that the table cannot have (E0142).
void resolve_bruneton(DecodedSection& bake, const RecipeSoFar& so_far, Decoder& decoder) {
    const Parameters& recipe = so_far.parameters;
    const auto table = choice_of<BrunetonTable>(bake.at("table"));
    const auto convention = choice_of<BrunetonConvention>(bake.at("convention"));
    if (!table || !convention) return;
    const bool has_light = *table != BrunetonTable::transmittance;
    const bool is_flat = !has_light || *table == BrunetonTable::irradiance;
    derive(bake.at("size"), default_size(*table));
    derive(bake.at("flip"), *convention == BrunetonConvention::takram);
    if (*table == BrunetonTable::scattering) {
        derive(bake.at("combined"), *convention == BrunetonConvention::takram);
    }
    if (!is_flat) {
        derive(bake.at("sun_cos_zenith_min"), default_sun_cosine(*convention, recipe));
        if (*convention == BrunetonConvention::calcmysky) check_calcmysky(bake, decoder);
        derive(bake.at("mie_layers"), peaked_layers(recipe.atmosphere));
    }
    if (has_light) {
        derive(bake.at("solar_irradiance"), default_solar_irradiance(*convention, recipe));
    }
    resolve_axes_and_files(bake, is_flat ? 2 : 3, 4, decoder);
    if (!is_flat && bake.at("size").value) {
        check_nu(bake, std::get<VoxelCounts>(*bake.at("size").value), decoder);
        check_halves(bake, std::get<VoxelCounts>(*bake.at("size").value), decoder);
    }
    if (*table == BrunetonTable::scattering) check_combined(bake, recipe, decoder);
    if (*table == BrunetonTable::higher_orders) check_higher_orders(bake, decoder);
    if (*convention == BrunetonConvention::takram && decoder.complete) {
        check_takram(bake, recipe, decoder);
        if (bake.at("size").value) warn_of_loader(bake, default_size(*table), decoder);
    }
}

std::vector<Read> reads_of(const Parameters& parameters, const BrunetonBake&) {
    return reads_of_light(parameters, Roles::all());
}

}  // namespace

const AssetKind& asset_kind(Tag<BrunetonBake>) {
    static const auto rows = with_file_fields(bruneton_table, {.flip = ""});
    static const AssetKind kind = make_asset_kind<BrunetonBake>(
        {
            .name = "bruneton",
            .documentation = "a table of Bruneton's precomputed scattering",
            .needs_atmosphere = true,
            .use_of_light = UseOfLight::colors,
        },
        std::span<const BrunetonField>(rows), reads_of, resolve_bruneton);
    return kind;
}

}  // namespace skybake::config
