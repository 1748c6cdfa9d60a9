#include "config/assets/bruneton_checks.h"

#include <fmt/format.h>

#include "config/assets/takram_layers.h"
#include "config/sections/file_formats.h"
#include "config/text/key_path.h"

namespace skybake::config {

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

void check_halves(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    if (size[1] % 2 == 0) return;
    report_size(bake,
                fmt::format("`{}` has {} texels along v", join_path(bake.path, "size"), size[1]),
                "give an even number: half of them are for rays to the ground", decoder);
}

void check_combined(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder) {
    const std::size_t channels = channels_of_light(recipe);
    if (channels == 1 || channels == 3 || channels == 0) return;
    const DecodedField& combined = bake.at("combined");
    if (!combined.value || !std::get<bool>(*combined.value)) return;
    decoder.diagnostics.error(
        "E0129", combined.source ? combined.source->place : bake.place,
        fmt::format("`{}` is for one or three channels of light, and this recipe has {}",
                    join_path(bake.path, "combined"), channels),
        "give combined = false, and bake table = \"single_mie\" as another asset");
}

void check_takram(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder) {
    const auto problem = takram_problem(recipe.atmosphere, channels_of_light(recipe));
    if (!problem) return;
    const DecodedField& convention = bake.at("convention");
    decoder.diagnostics.error("E0143", convention.source ? convention.source->place : bake.place,
                              fmt::format("`{}`: {}", join_path(bake.path, "convention"), *problem),
                              "convention = \"bruneton\" takes any atmosphere");
}

void warn_of_loader(const DecodedSection& bake, const VoxelCounts& usual_size, Decoder& decoder) {
    const auto is_number = [&](std::string_view key, double wanted) {
        const DecodedField& decoded = bake.at(key);
        return !decoded.value || std::get<double>(*decoded.value) == wanted;
    };
    const char* unusual = nullptr;
    if (std::get<VoxelCounts>(*bake.at("size").value) != usual_size) unusual = "size";
    if (!is_number("nu_size", 8)) unusual = "nu_size";
    if (!is_number("mips", 1)) unusual = "mips";
    if (choice_of<SheetLayout>(bake.at("layout")) != SheetLayout::stack) unusual = "layout";
    if (choice_of<PixelType>(bake.at("pixel_type")) != PixelType::half) unusual = "pixel_type";
    if (!std::get<bool>(*bake.at("flip").value)) unusual = "flip";
    if (!unusual) return;
    const DecodedField& decoded = bake.at(unusual);
    decoder.diagnostics.warning(
        "W0205", decoded.source ? decoded.source->place : bake.place,
        fmt::format("`{}` is not what @takram/three-atmosphere loads",
                    join_path(bake.path, unusual)),
        "it loads the default sizes, half floats and one stack upside down, without mips");
}

void check_calcmysky(const DecodedSection& bake, Decoder& decoder) {
    const DecodedField& least = bake.at("sun_cos_zenith_min");
    if (!least.source) return;
    decoder.diagnostics.error(
        "E0110", least.source->place,
        fmt::format("`{}` follows from the planet with convention = \"calcmysky\"",
                    join_path(bake.path, "sun_cos_zenith_min")),
        "leave it out, or take another convention");
}

void check_higher_orders(const DecodedSection& bake, Decoder& decoder) {
    const DecodedField& orders = bake.at("orders");
    if (!orders.value || std::get<double>(*orders.value) != 1) return;
    decoder.diagnostics.error(
        "E0110", orders.source->place,
        fmt::format("`{}` is out of range: 1", join_path(bake.path, "orders")),
        "higher_orders holds the second order and above: give at least 2, or \"all\"");
}

}  // namespace skybake::config
