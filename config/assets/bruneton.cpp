#include "config/assets/bruneton.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/file_decoder.h"
#include "config/assets/takram_layers.h"
#include "config/fields/fields.h"
#include "config/sections/file_formats.h"
#include "config/sections/layer.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

constexpr Choice bruneton_table_choices[] = {
    {BrunetonTable::transmittance, "transmittance", "transmittance to the top of the atmosphere"},
    {BrunetonTable::scattering, "scattering",
     "light scattered towards a view ray, by nu, sun, view and altitude"},
    {BrunetonTable::single_mie, "single_mie", "the first order of the Mie layers on its own"},
    {BrunetonTable::higher_orders, "higher_orders", "all orders from the second on, on their own"},
    {BrunetonTable::irradiance, "irradiance", "irradiance of a level surface by the sky"},
};

constexpr Choice convention_choices[] = {
    {BrunetonConvention::bruneton, "bruneton",
     "the layout of the textures of the implementation of 2017"},
    {BrunetonConvention::takram, "takram",
     "the layout that @takram/three-atmosphere loads: EXR files upside down, with its parameters"},
    {BrunetonConvention::calcmysky, "calcmysky", "the sun's axis of CalcMySky and Stellarium"},
};

constexpr Words by_nu = {"scattering", "single_mie", "higher_orders"};

const Row<BrunetonBake> bruneton_table[] = {
    {"table", Kind::choice, &BrunetonBake::table, "which of the tables to bake",
     bruneton_table_choices, Default{R"("scattering")"}, Cited{bruneton_2017}},
    {"convention", Kind::choice, &BrunetonBake::convention, "the reader that the files are for",
     convention_choices, Default{R"("bruneton")"}},
    {"size", Kind::voxels, &BrunetonBake::size,
     "texels along u, v, w; by default [256, 128, 32] of scattering, [256, 64, 1] of "
     "transmittance, [64, 16, 1] of irradiance",
     texel_range, Cited{bruneton_2017}},
    {"nu_size", Kind::integer, &BrunetonBake::nu_size,
     "number of angles between view and sun, side by side along u", Range{2, 1024}, Default{"8"},
     When{"table", by_nu}, Cited{bruneton_2017}},
    {"combined", Kind::flag, &BrunetonBake::combined,
     "whether A holds the Mie layers' first order, red alone, as takram's loader expects, for "
     "which it is true by default; otherwise the table is R G B, and single_mie holds that order",
     When{"table", "scattering"}},
    {"orders", Kind::levels, &BrunetonBake::orders,
     "number of orders of scattering, with the first", Range{1, 1000}, Default{R"("all")"},
     Hint{"Bruneton uses 4"}, When{"table", {"scattering", "higher_orders", "irradiance"}}},
    {"sun_cos_zenith_min", Kind::number, &BrunetonBake::sun_cos_zenith_min,
     "where the sun's axis begins; by default -0.5 for takram, as its loader expects, -R / (2 "
     "R_top) for calcmysky, which takes no other, and else cos 102 deg",
     Range{-1, 0, false, true}, When{"table", by_nu}, Cited{bruneton_2017}},
    {"mie_layers", Kind::text_list, &BrunetonBake::mie_layers,
     "layers whose first order is kept apart; by default those with phase functions other than "
     "rayleigh and isotropic",
     Hint{"for example [\"aerosol\"]"}, When{"table", by_nu}},
    {"solar_irradiance", Kind::fractions, &BrunetonBake::solar_irradiance,
     "factor of all light; by default 1, or takram's own", Range{0, 1e6, true},
     When{"table", {"scattering", "single_mie", "higher_orders", "irradiance"}}},
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
           std::ranges::any_of(layer.scattering,
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

// Reports sub-images that do not divide the texels along u, or are too few or too small (E0142).
void check_nu(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    const std::optional<int> nu_size = bake.whole("nu_size");
    if (!nu_size || (*nu_size >= 2 && size[0] % *nu_size == 0 && size[0] / *nu_size >= 2)) return;
    decoder.diagnostics.error("E0142", bake.place_of("size"),
                              fmt::format("`{}` cannot part {} texels into {} sub-images",
                                          join_path(bake.path, "nu_size"), size[0], *nu_size),
                              "it needs at least two sub-images, each of at least two texels");
}

// Reports an odd number of texels along v (E0142).
void check_halves(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    if (size[1] % 2 == 0) return;
    decoder.report("E0142", bake, "size", fmt::format("has {} texels along v", size[1]),
                   "give an even number: half of them are for rays to the ground");
}

// Reports a combined table whose A would be a fifth channel, or the second or third, which no
// runtime takes for A (E0129).
void check_combined(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder) {
    const std::size_t channels = channels_of_light(recipe);
    if (channels == 1 || channels == 3 || channels == 0) return;
    const auto* combined = bake.value<bool>("combined");
    if (!combined || !*combined) return;
    decoder.report(
        "E0129", bake, "combined",
        fmt::format("is for one or three channels of light, and this recipe has {}", channels),
        "give combined = false, and bake table = \"single_mie\" as another asset");
}

// Reports an atmosphere that takram's parameters cannot describe (E0143).
void check_takram(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder) {
    const auto problem = takram_problem(recipe.atmosphere, channels_of_light(recipe));
    if (!problem) return;
    decoder.report("E0143", bake, "convention", fmt::format(": {}", *problem),
                   "convention = \"bruneton\" takes any atmosphere");
}

// Warns of values other than those that takram's loader takes for granted (W0205). The loader would
// look such a file up wrongly.
void warn_of_loader(const DecodedSection& bake, const VoxelCounts& usual_size, Decoder& decoder) {
    const char* unusual = nullptr;
    if (*bake.value<VoxelCounts>("size") != usual_size) unusual = "size";
    if (bake.whole("nu_size").value_or(8) != 8) unusual = "nu_size";
    if (bake.whole("mips").value_or(1) != 1) unusual = "mips";
    if (choice_of<SheetLayout>(bake.at("layout")) != SheetLayout::stack) unusual = "layout";
    if (choice_of<PixelType>(bake.at("pixel_type")) != PixelType::half) unusual = "pixel_type";
    if (const auto* flip = bake.value<bool>("flip"); flip && !*flip) unusual = "flip";
    if (!unusual) return;
    decoder.report(
        "W0205", bake, unusual, "is not what @takram/three-atmosphere loads",
        "it loads the default sizes, half floats and one stack upside down, without mips");
}

// Reports a sun's axis that CalcMySky does not have (E0110). Files carry the one that it has.
void check_calcmysky(const DecodedSection& bake, double usual, Decoder& decoder) {
    if (bake.number("sun_cos_zenith_min").value_or(usual) == usual) return;
    decoder.report("E0110", bake, "sun_cos_zenith_min",
                   "follows from the planet with convention = \"calcmysky\"",
                   "leave it out, or take another convention");
}

// Reports `orders = 1` for the table of orders above the first, which would have no orders (E0110).
void check_higher_orders(const DecodedSection& bake, Decoder& decoder) {
    if (bake.whole("orders") != 1) return;
    decoder.report("E0110", bake, "orders", "is out of range: 1",
                   "higher_orders holds the second order and above: give at least 2, or \"all\"");
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
        const double darkest = default_sun_cosine(*convention, recipe);
        derive(bake.at("sun_cos_zenith_min"), darkest);
        if (*convention == BrunetonConvention::calcmysky) check_calcmysky(bake, darkest, decoder);
        derive(bake.at("mie_layers"), peaked_layers(recipe.atmosphere));
    }
    if (has_light) {
        derive(bake.at("solar_irradiance"), default_solar_irradiance(*convention, recipe));
    }
    resolve_axes_and_files(bake, is_flat ? 2 : 3, 4, decoder);
    const auto* size = bake.value<VoxelCounts>("size");
    if (!is_flat && size) {
        check_nu(bake, *size, decoder);
        check_halves(bake, *size, decoder);
    }
    if (*table == BrunetonTable::scattering) check_combined(bake, recipe, decoder);
    if (*table == BrunetonTable::higher_orders) check_higher_orders(bake, decoder);
    if (*convention == BrunetonConvention::takram && decoder.complete) {
        check_takram(bake, recipe, decoder);
        if (size) warn_of_loader(bake, default_size(*table), decoder);
    }
}

}  // namespace

AssetKind asset_kind(Tag<BrunetonBake>) {
    return make_asset_kind<BrunetonBake>(
        {.name = "bruneton",
         .documentation = "a table of Bruneton's precomputed scattering",
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::colors},
        with_file_fields(bruneton_table, {.flip = ""}), reads_of_all_light, resolve_bruneton);
}

}  // namespace skybake::config
