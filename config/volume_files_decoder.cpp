#include "config/volume_files_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "config/key_path.h"

namespace skybake::config {
namespace {

constexpr std::int64_t most_voxels = std::int64_t{1} << 36;

// Which pixel types a format has, by their names in the field table.
struct FormatTypes {
    VolumeFormat format;
    std::string_view name;
    bool has_unorm;
};
constexpr std::array format_types = {
    FormatTypes{VolumeFormat::exr, "exr", false},
    FormatTypes{VolumeFormat::vdb, "vdb", false},
    FormatTypes{VolumeFormat::bin, "bin", true},
};

int bytes_of(PixelType type) {
    switch (type) {
        case PixelType::float32:
            return 4;
        case PixelType::half:
        case PixelType::unorm16:
            return 2;
        case PixelType::unorm8:
            return 1;
    }
    return 0;
}

template <class T>
const T* value_of(const DecodedField& decoded) {
    return decoded.value ? std::get_if<T>(&*decoded.value) : nullptr;
}

std::optional<PixelType> pixel_type_of(const DecodedSection& bake) {
    const auto* choice = value_of<ChoiceIndex>(bake.at("pixel_type"));
    if (!choice) return std::nullopt;
    return static_cast<PixelType>(choice->index);
}

std::string spell_bytes(std::int64_t bytes) {
    constexpr std::array<std::string_view, 5> units = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    double number = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (number >= 1024 && unit + 1 < units.size()) {
        number /= 1024;
        ++unit;
    }
    return fmt::format("{:.3g} {}", number, units[unit]);
}

void check_columns(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    const DecodedField& decoded = bake.at("columns");
    const auto* columns = value_of<double>(decoded);
    if (!columns) return;
    // A row of an atlas is made whole: a longer one would take memory that grows with it.
    constexpr double kWidest = 1 << 20;
    const bool wide = *columns * size[0] > kWidest;
    if (*columns <= size[2] && !wide) return;
    decoder.diagnostics.error(
        "E0110", decoded.source->place,
        fmt::format("`{}` is out of range: {}", join_path(bake.path, "columns"),
                    static_cast<int>(*columns)),
        *columns > size[2] ? fmt::format("there are {} slices", size[2])
                           : fmt::format("an atlas is at most {} voxels wide: {} columns", kWidest,
                                         static_cast<int>(kWidest) / size[0]));
}

// Down to one voxel: log2(longest edge), rounded as sizes are, + 1.
int levels_of(const VoxelCounts& size, Halving halving) {
    int levels = 1;
    int edge = *std::max_element(size.begin(), size.end());
    while (edge > 1) {
        edge = (edge + (halving == Halving::up ? 1 : 0)) / 2;
        ++levels;
    }
    return levels;
}

void resolve_levels(DecodedSection& bake, const VoxelCounts& size, Halving halving,
                    Decoder& decoder) {
    DecodedField& decoded = bake.at("mips");
    const auto* asked = value_of<double>(decoded);
    if (!asked) return;
    const double levels = levels_of(size, halving);
    if (*asked > levels) {
        decoder.diagnostics.error(
            "E0110", decoded.source->place,
            fmt::format("`{}` is out of range: {}", join_path(bake.path, "mips"),
                        static_cast<int>(*asked)),
            fmt::format("{} has {} levels down to one voxel", spell_voxels(size),
                        static_cast<int>(levels)));
    }
    if (*asked == 0) decoded.value = levels;
}

}  // namespace

std::string spell_voxels(const VoxelCounts& size) {
    return fmt::format("{}x{}x{}", size[0], size[1], size[2]);
}

void check_pixel_type(const DecodedSection& bake, Decoder& decoder) {
    const DecodedField& decoded = bake.at("pixel_type");
    const auto type = pixel_type_of(bake);
    const auto* formats = value_of<std::vector<ChoiceIndex>>(bake.at("formats"));
    const bool is_unorm = type == PixelType::unorm8 || type == PixelType::unorm16;
    if (!is_unorm || !formats) return;
    std::vector<std::string_view> without;
    for (const ChoiceIndex format : *formats) {
        const FormatTypes& types = format_types[format.index];
        if (!types.has_unorm) without.push_back(types.name);
    }
    if (without.empty()) return;
    decoder.diagnostics.error(
        "E0131", decoded.source ? decoded.source->place : bake.place,
        fmt::format("`{}`: {} files cannot hold {}", join_path(bake.path, "pixel_type"),
                    fmt::join(without, " and "),
                    decoded.field->choices[static_cast<std::size_t>(*type)].name),
        "unorm8 and unorm16 go with formats = [\"bin\"] alone; float and half with all");
}

void resolve_volume_files(DecodedSection& bake, const VoxelCounts& size, Halving halving,
                          Decoder& decoder) {
    check_columns(bake, size, decoder);
    resolve_levels(bake, size, halving, decoder);
}

void check_voxel_count(const DecodedSection& bake, const VoxelCounts& size, std::size_t channels,
                       const Place& size_place, Decoder& decoder) {
    const std::int64_t voxels = std::int64_t{size[0]} * size[1] * size[2];
    const auto type = pixel_type_of(bake);
    if (voxels <= most_voxels || !type) return;
    const std::int64_t bytes = voxels * static_cast<std::int64_t>(channels) * bytes_of(*type);
    decoder.diagnostics.error(
        "E0126", size_place,
        fmt::format("[{}] has {} voxels ({}) and would need {} bytes ({})", bake.path, voxels,
                    spell_voxels(size), bytes, spell_bytes(bytes)),
        fmt::format("at most {} (2^36) voxels", most_voxels));
}

}  // namespace skybake::config
