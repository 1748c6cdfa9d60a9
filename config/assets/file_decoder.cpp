#include "config/assets/file_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "config/assets/sheet_decoder.h"
#include "config/sections/file_formats.h"
#include "config/sections/targets.h"

namespace skybake::config {
namespace {

constexpr std::int64_t most_voxels = std::int64_t{1} << 36;

std::int64_t voxels_of(const VoxelCounts& size) {
    return std::int64_t{size[0]} * size[1] * size[2];
}

// Rounded up.
int bytes_of(PixelType type) {
    constexpr PixelTypes two_bytes(PixelType::half, PixelType::unorm16, PixelType::rgbe);
    if (type == PixelType::float32) return 4;
    return two_bytes.contains(type) ? 2 : 1;
}

std::optional<PixelType> pixel_type_of(const DecodedSection& bake) {
    return choice_of<PixelType>(bake.at("pixel_type"));
}

std::string bytes_to_string(std::int64_t bytes) {
    constexpr std::array<std::string_view, 5> units = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    double number = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (number >= 1024 && unit + 1 < units.size()) {
        number /= 1024;
        ++unit;
    }
    return fmt::format("{:.3g} {}", number, units[unit]);
}

bool has_format(const DecodedSection& bake, FileFormat format) {
    const std::vector<FileFormat> formats = formats_of(bake);
    return std::ranges::find(formats, format) != formats.end();
}

// Returns the number of levels down to one voxel, or to one of each slice: log2(longest edge) + 1, where
// the logarithm is rounded in the same way as sizes are.
int levels_of(const VoxelCounts& size, Halving halving) {
    int levels = 1;
    const auto end = halving == Halving::down_within_slices ? size.begin() + 2 : size.end();
    int edge = *std::max_element(size.begin(), end);
    while (edge > 1) {
        edge = (edge + (halving == Halving::up ? 1 : 0)) / 2;
        ++levels;
    }
    return levels;
}

// Whether a table is a cube, whose six faces lie below each other.
bool is_cube(const DecodedSection& bake) {
    const DecodedField* mapping = bake.find("mapping");
    const auto* choice = mapping ? mapping->as<ChoiceIndex>() : nullptr;
    return choice && mapping->field->choices[choice->index].name == "cube";
}

// Reports that the target does not load textures without their last levels.
void check_for_target(const DecodedSection& bake, double levels, Decoder& decoder) {
    const auto target = choice_of<Target>(bake.at("target"));
    if (!target || !facts_of(*target).needs_every_level) return;
    decoder.report("E0160", bake, "mips",
                   fmt::format(": {} cannot load textures whose levels end before one texel",
                               facts_of(*target).name),
                   fmt::format("it loads 1 level, or all {}", static_cast<int>(levels)));
}

void resolve_levels(DecodedSection& bake, const VoxelCounts& size, Halving halving,
                    Decoder& decoder) {
    const std::optional<double> asked = bake.number("mips");
    if (!asked) return;
    const VoxelCounts of_face = {size[0], size[0], size[2]};
    const double levels = levels_of(is_cube(bake) ? of_face : size, halving);
    if (*asked > levels) {
        decoder.report("E0110", bake, "mips",
                       fmt::format("is out of range: {}", static_cast<int>(*asked)),
                       fmt::format("{} has {} levels down to one voxel", voxels_to_string(size),
                                   static_cast<int>(levels)));
    }
    if (*asked == 0) bake.at("mips").value = levels;
    if (*asked > 1 && *asked < levels) check_for_target(bake, levels, decoder);
}

// Reports formats that refer to VDB files of an asset that has none.
void check_references(const DecodedSection& bake, Decoder& decoder) {
    for (const FileFormat format : formats_of(bake)) {
        if (!facts_of(format).only_refers || has_format(bake, FileFormat::vdb)) continue;
        decoder.report("E0131", bake, "formats",
                       fmt::format(": {} files refer to VDB files, and [{}] has none",
                                   facts_of(format).name, bake.path),
                       "add \"vdb\"");
    }
}

// Reports `flip` of an asset without images, which no reader would see.
void check_flip(const DecodedSection& bake, Decoder& decoder) {
    const auto* flip = bake.value<bool>("flip");
    if (!bake.gives("flip") || !flip || !*flip) return;
    const std::vector<FileFormat> formats = formats_of(bake);
    const auto is_image = [](FileFormat format) { return facts_of(format).is_image; };
    if (formats.empty() || std::ranges::any_of(formats, is_image)) return;
    decoder.report("E0131", bake, "flip",
                   fmt::format("turns images upside down, and [{}] has none", bake.path),
                   "leave it out, or add an image, such as \"exr\", to the formats");
}

// Reports axes that the table does not have, and axes with fewer than the two texels that their
// ends need.
void check_axes(const DecodedSection& bake, const VoxelCounts& size, int axes, Decoder& decoder) {
    for (int axis = 0; axis < 3; ++axis) {
        const int count = size[static_cast<std::size_t>(axis)];
        const bool is_axis = axis < axes;
        if (is_axis ? count >= 2 : count == 1) continue;
        return decoder.report(
            "E0142", bake, "size",
            fmt::format("is {}: its table has {} ax{}", voxels_to_string(size), axes,
                        axes == 1 ? "is" : "es"),
            is_axis ? "each of them needs two texels or more" : "give 1 along the others");
    }
}

// Returns none if an error bound is to choose the size.
std::optional<VoxelCounts> table_size(const DecodedSection& bake) {
    if (const auto* texels = bake.value<std::array<int, 2>>("size")) {
        return VoxelCounts{(*texels)[0], (*texels)[1], 1};
    }
    const std::optional<int> texels = bake.whole("size");
    return texels ? std::optional(VoxelCounts{*texels, 1, 1}) : std::nullopt;
}

}  // namespace

std::vector<FileFormat> formats_of(const DecodedSection& bake) {
    const DecodedField& decoded = bake.at("formats");
    std::vector<FileFormat> formats;
    if (decoded.value) assign(*decoded.field, *decoded.value, formats);
    return formats;
}

std::string voxels_to_string(const VoxelCounts& size) {
    return fmt::format("{}x{}x{}", size[0], size[1], size[2]);
}

void check_pixel_type(const DecodedSection& bake, Decoder& decoder) {
    const DecodedField& decoded = bake.at("pixel_type");
    const auto type = pixel_type_of(bake);
    if (!type) return;
    std::vector<std::string_view> without;
    const FormatFacts* first = nullptr;
    for (const FileFormat format : formats_of(bake)) {
        const FormatFacts& facts = facts_of(format);
        if (facts.holds(*type)) continue;
        if (without.empty()) first = &facts;
        without.push_back(facts.name);
    }
    check_references(bake, decoder);
    if (first == nullptr) return;
    std::vector<std::string_view> with;
    for (const FormatFacts& facts : file_formats) {
        if (facts.holds(*type) && !facts.only_refers) with.push_back(facts.name);
    }
    std::vector<std::string_view> types;
    for (const Choice& choice : decoded.field->choices) {
        if (first->holds(static_cast<PixelType>(choice.enumerator))) types.push_back(choice.name);
    }
    decoder.report("E0131", bake, "pixel_type",
                   fmt::format(": {} files cannot hold {}", fmt::join(without, " and "),
                               choice_name(*decoded.field, *type)),
                   fmt::format("{} hold it; {} holds {}", fmt::join(with, ", "), first->name,
                               fmt::join(types, ", ")));
}

void check_channels(const DecodedSection& bake, std::size_t channels, Decoder& decoder) {
    const DecodedField& decoded = bake.at("pixel_type");
    const auto type = pixel_type_of(bake);
    if (!type) return;
    const std::size_t coded = coded_channels(*type);
    if (coded == 0 || coded == channels) return;
    decoder.report(
        "E0131", bake, "pixel_type",
        fmt::format(": {} codes {} channel{}, and [{}] has {}", choice_name(*decoded.field, *type),
                    coded, coded == 1 ? "" : "s", bake.path, channels),
        "bc4 codes one channel, bc6h and rgbe three");
}

void refuse_blocks(const DecodedSection& bake, std::string_view what, Decoder& decoder) {
    const DecodedField& decoded = bake.at("pixel_type");
    const auto type = pixel_type_of(bake);
    if (!type || !is_block_coded(*type)) return;
    decoder.report("E0131", bake, "pixel_type",
                   fmt::format(": {} codes blocks of volumes, and [{}] is {}",
                               choice_name(*decoded.field, *type), bake.path, what),
                   "float, half, unorm8 and unorm16 hold each value by itself");
}

void resolve_files(DecodedSection& bake, const VoxelCounts& size, Halving halving,
                   Decoder& decoder) {
    const bool is_too_large = voxels_of(size) > most_voxels;  // check_voxel_count reports it
    if (has_good_columns(bake, size, decoder) && !is_too_large) resolve_sheet(bake, size, decoder);
    resolve_levels(bake, size, halving, decoder);
    check_flip(bake, decoder);
}

// Edges are quotients of doubles, so the edges of equal voxels may differ by rounding, by about
// 1e-16 of their length. OpenVDB takes edges that differ by less than 5e-7 m as equal.
void check_cubes(const DecodedSection& bake, const std::array<double, 3>& edges,
                 const Place& size_place, Decoder& decoder) {
    constexpr double rounding = 1e-12;
    const auto [least, greatest] = std::ranges::minmax_element(edges);
    const bool are_cubes = *greatest - *least <= rounding * *greatest;
    if (are_cubes || !has_format(bake, FileFormat::vdb)) return;
    decoder.diagnostics.warning(
        "W0211", size_place,
        fmt::format("the voxels of [{}] are not cubes: {:.5g} x {:.5g} x {:.5g} m", bake.path,
                    edges[0], edges[1], edges[2]),
        "many programs assume that the voxels of a VDB file are cubes; `voxel_size` makes cubes");
}

void check_voxel_count(const DecodedSection& bake, const VoxelCounts& size, std::size_t channels,
                       const Place& size_place, Decoder& decoder) {
    check_channels(bake, channels, decoder);
    const std::int64_t voxels = voxels_of(size);
    const auto type = pixel_type_of(bake);
    if (voxels <= most_voxels || !type) return;
    const std::int64_t bytes = voxels * static_cast<std::int64_t>(channels) * bytes_of(*type);
    decoder.diagnostics.error(
        "E0126", size_place,
        fmt::format("[{}] has {} voxels ({}) and would need {} bytes ({})", bake.path, voxels,
                    voxels_to_string(size), bytes, bytes_to_string(bytes)),
        fmt::format("at most {} (2^36) voxels are allowed", most_voxels));
}

void resolve_axes_and_files(DecodedSection& bake, int axes, std::size_t channels,
                            Decoder& decoder) {
    check_pixel_type(bake, decoder);
    const auto* texels = bake.value<VoxelCounts>("size");
    if (!texels) return;
    check_axes(bake, *texels, axes, decoder);
    resolve_files(bake, *texels, Halving::down, decoder);
    check_voxel_count(bake, *texels, channels, bake.place_of("size"), decoder);
}

void check_formats(const DecodedSection& bake, bool is_table, bool has_colors, Decoder& decoder) {
    for (const FileFormat format : formats_of(bake)) {
        const FormatFacts& facts = facts_of(format);
        const bool misses_colors = facts.only_colors && !(is_table && has_colors);
        if (!(facts.only_volumes && is_table) && !misses_colors) continue;
        decoder.report("E0131", bake, "formats",
                       fmt::format(": {} files hold {}, and [{}] {}", facts.name,
                                   misses_colors ? "colours of the sky in tables" : "volumes",
                                   bake.path, misses_colors ? "has none" : "is a table"),
                       misses_colors ? "environment, sky_view and irradiance have them"
                                     : "most other formats hold tables");
    }
    if (has_colors && decoder.channels && pixel_type_of(bake) == PixelType::rgbe) {
        check_channels(bake, static_cast<std::size_t>(*decoder.channels), decoder);
    }
}

void resolve_table_files(DecodedSection& bake, Decoder& decoder) {
    check_pixel_type(bake, decoder);
    refuse_blocks(bake, "a table", decoder);
    if (const auto size = table_size(bake)) {
        resolve_files(bake, *size, Halving::down, decoder);
        return;
    }
    check_chosen_files(bake, "size", decoder);
}

void check_chosen_files(DecodedSection& bake, std::string_view size_key, Decoder& decoder) {
    for (const std::string_view key : {"mips", "columns"}) {
        if (!bake.gives(key) || bake.whole(key).value_or(1) == 1) continue;
        decoder.report("E0110", bake, key, fmt::format("needs `{}`", size_key),
                       "it follows from the size, and `max_error` chooses that later");
    }
}

}  // namespace skybake::config
