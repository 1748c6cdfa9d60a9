#include "config/assets/precomputed_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "config/assets/takram_layers.h"
#include "config/assets/volume_files_decoder.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// The cosine of 102 deg: below, Bruneton's half floats hold nothing. takram has that of 120 deg.
constexpr double bruneton_sun_cosine = -0.20791169081775934;
constexpr double takram_sun_cosine = -0.5;

// Of R, G, B, in W / m^2 / nm at 680, 550 and 440 nm (ASTM E-490), as takram has them.
constexpr std::array takram_solar_irradiance = {1.474, 1.8504, 1.91198};

template <class Enum>
std::optional<Enum> choice_of(const DecodedField& decoded) {
    if (!decoded.value) return std::nullopt;
    return static_cast<Enum>(std::get<ChoiceIndex>(*decoded.value).index);
}

template <class T>
void derive(DecodedField& decoded, T value) {
    if (decoded.source) return;
    decoded.value = std::move(value);
    decoded.derived = true;
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

VoxelCounts default_size(OpticalDepthTable table) {
    switch (table) {
        case OpticalDepthTable::to_top:
            return {256, 128, 1};
        case OpticalDepthTable::between:
            return {64, 64, 64};
        default:
            return {1024, 1, 1};
    }
}

void report_size(const DecodedSection& bake, std::string message, std::string label,
                 Decoder& decoder) {
    const DecodedField& size = bake.at("size");
    decoder.diagnostics.error("E0142", size.source ? size.source->place : bake.place,
                              std::move(message), std::move(label));
}

// Axes that the table does not have, and those that need two ends.
void check_axes(const DecodedSection& bake, const VoxelCounts& size, int axes, Decoder& decoder) {
    for (int axis = 0; axis < 3; ++axis) {
        const int count = size[static_cast<std::size_t>(axis)];
        const bool is_axis = axis < axes;
        if (is_axis ? count >= 2 : count == 1) continue;
        report_size(bake,
                    fmt::format("`{}` is {}: its table has {} ax{}", join_path(bake.path, "size"),
                                spell_voxels(size), axes, axes == 1 ? "is" : "es"),
                    is_axis ? "each of them needs two texels or more" : "give 1 along the others",
                    decoder);
        return;
    }
}

void check_nu(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    const DecodedField& decoded = bake.at("nu_size");
    if (!decoded.value) return;
    const int nu_size = static_cast<int>(std::get<double>(*decoded.value));
    if (nu_size >= 2 && size[0] % nu_size == 0 && size[0] / nu_size >= 2) return;
    report_size(bake,
                fmt::format("`{}` does not divide {} texels into sub-images: {}",
                            join_path(bake.path, "nu_size"), size[0], nu_size),
                "it needs at least two sub-images, each of at least two texels", decoder);
}

// Courses of paths have their own texels along u, two or more of each.
void check_courses(const DecodedSection& bake, const VoxelCounts& size, int least,
                   Decoder& decoder) {
    if (size[0] >= least) return;
    report_size(bake,
                fmt::format("`{}` is {}: its first axis is divided among the kinds of paths",
                            join_path(bake.path, "size"), spell_voxels(size)),
                fmt::format("give it at least {} texels", least), decoder);
}

// What any table needs once its size is known.
void resolve_files(DecodedSection& bake, int axes, std::size_t channels, Decoder& decoder) {
    check_pixel_type(bake, decoder);
    const DecodedField& size = bake.at("size");
    if (!size.value) return;
    const auto texels = std::get<VoxelCounts>(*size.value);
    check_axes(bake, texels, axes, decoder);
    resolve_volume_files(bake, texels, Halving::down, decoder);
    check_voxel_count(bake, texels, channels, size.source ? size.source->place : bake.place,
                      decoder);
}

void check_halves(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    if (size[1] % 2 == 0) return;
    report_size(bake,
                fmt::format("`{}` has {} texels along v", join_path(bake.path, "size"), size[1]),
                "give an even number: half of them are for rays to the ground", decoder);
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

void check_takram(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder) {
    const auto problem = takram_problem(recipe.atmosphere, recipe.wavelengths.size());
    if (!problem) return;
    const DecodedField& convention = bake.at("convention");
    decoder.diagnostics.error("E0143", convention.source ? convention.source->place : bake.place,
                              fmt::format("`{}`: {}", join_path(bake.path, "convention"), *problem),
                              "convention = \"bruneton\" takes any atmosphere");
}

// What the package's loader takes for granted, so that a file of another kind is looked up wrongly.
void warn_of_loader(const DecodedSection& bake, BrunetonTable table, Decoder& decoder) {
    const auto is_number = [&](std::string_view key, double wanted) {
        const DecodedField& decoded = bake.at(key);
        return !decoded.value || std::get<double>(*decoded.value) == wanted;
    };
    const char* unusual = nullptr;
    if (std::get<VoxelCounts>(*bake.at("size").value) != default_size(table)) unusual = "size";
    if (!is_number("nu_size", 8)) unusual = "nu_size";
    if (!is_number("mips", 1)) unusual = "mips";
    if (choice_of<VolumeLayout>(bake.at("layout")) != VolumeLayout::stack) unusual = "layout";
    if (choice_of<PixelType>(bake.at("pixel_type")) != PixelType::half) unusual = "pixel_type";
    if (!unusual) return;
    const DecodedField& decoded = bake.at(unusual);
    decoder.diagnostics.warning(
        "W0205", decoded.source ? decoded.source->place : bake.place,
        fmt::format("`{}` is not what @takram/three-atmosphere loads",
                    join_path(bake.path, unusual)),
        "it loads the default sizes, half floats and one stack, without mips");
}

// Orders above the first, of which there are none with one.
void check_higher_orders(const DecodedSection& bake, Decoder& decoder) {
    const DecodedField& orders = bake.at("orders");
    if (!orders.value || std::get<double>(*orders.value) != 1) return;
    decoder.diagnostics.error(
        "E0110", orders.source->place,
        fmt::format("`{}` is out of range: 1", join_path(bake.path, "orders")),
        "higher_orders holds the second order and above: give at least 2, or \"all\"");
}

std::vector<double> default_solar_irradiance(BrunetonConvention convention, std::size_t channels) {
    const bool takram = convention == BrunetonConvention::takram;
    if (takram && channels == takram_solar_irradiance.size()) {
        return {takram_solar_irradiance.begin(), takram_solar_irradiance.end()};
    }
    return std::vector<double>(channels, 1);
}

}  // namespace

void resolve_bruneton(DecodedSection& bake, const Parameters& recipe, Decoder& decoder) {
    const auto table = choice_of<BrunetonTable>(bake.at("table"));
    const auto convention = choice_of<BrunetonConvention>(bake.at("convention"));
    if (!table || !convention) return;
    const bool has_light = *table != BrunetonTable::transmittance;
    const bool is_flat = !has_light || *table == BrunetonTable::irradiance;
    derive(bake.at("size"), default_size(*table));
    if (!is_flat) {
        derive(bake.at("sun_cos_zenith_min"),
               *convention == BrunetonConvention::takram ? takram_sun_cosine : bruneton_sun_cosine);
        derive(bake.at("mie_layers"), peaked_layers(recipe.atmosphere));
    }
    if (has_light) {
        derive(bake.at("solar_irradiance"),
               default_solar_irradiance(*convention, recipe.wavelengths.size()));
    }
    resolve_files(bake, is_flat ? 2 : 3, 4, decoder);
    if (!is_flat && bake.at("size").value) {
        check_nu(bake, std::get<VoxelCounts>(*bake.at("size").value), decoder);
        check_halves(bake, std::get<VoxelCounts>(*bake.at("size").value), decoder);
    }
    if (*table == BrunetonTable::higher_orders) check_higher_orders(bake, decoder);
    if (*convention == BrunetonConvention::takram && decoder.complete) {
        check_takram(bake, recipe, decoder);
        if (bake.at("size").value) warn_of_loader(bake, *table, decoder);
    }
}

void resolve_optical_depth(DecodedSection& bake, const Atmosphere& atmosphere, Decoder& decoder) {
    constexpr std::size_t most_kinds = 4;
    const auto table = choice_of<OpticalDepthTable>(bake.at("table"));
    if (!table) return;
    derive(bake.at("size"), default_size(*table));
    std::vector<std::string> names;
    for (const Layer& layer : atmosphere.layers) names.push_back(layer.name);
    DecodedField& kinds = bake.at("kinds");
    derive(kinds, names);
    const std::size_t count =
        kinds.value ? std::get<std::vector<std::string>>(*kinds.value).size() : 1;
    if ((count < 1 || count > most_kinds) && decoder.complete) {
        decoder.diagnostics.error(
            "E0129", kinds.source ? kinds.source->place : bake.place,
            fmt::format("`{}` has {} layers", join_path(bake.path, "kinds"), count),
            "each has a channel, of which there are one to four; name the layers");
    }
    const int axes = *table == OpticalDepthTable::to_top    ? 2
                     : *table == OpticalDepthTable::between ? 3
                                                            : 1;
    resolve_files(bake, axes, most_kinds, decoder);
    const auto coordinates = choice_of<BetweenCoordinates>(bake.at("coordinates"));
    if (axes > 1 && bake.at("size").value) {
        const bool falls = axes == 3 && coordinates == BetweenCoordinates::distance;
        check_courses(bake, std::get<VoxelCounts>(*bake.at("size").value), falls ? 8 : 4, decoder);
    }
}

}  // namespace skybake::config
