#include "config/noise_volume_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "config/key_path.h"
#include "config/octave_sampling.h"
#include "config/suggest.h"

namespace skybake::config {
namespace {

using Triple = std::array<int, 3>;

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

template <class Enum>
std::optional<Enum> choice_of(const DecodedField& decoded) {
    const auto* choice = value_of<ChoiceIndex>(decoded);
    if (!choice) return std::nullopt;
    return static_cast<Enum>(choice->index);
}

std::string spell_size(const Triple& size) {
    return fmt::format("{}x{}x{}", size[0], size[1], size[2]);
}

std::string spell_frequency(const Triple& frequency) {
    const bool isotropic = frequency[0] == frequency[1] && frequency[1] == frequency[2];
    return isotropic ? fmt::format("{}", frequency[0]) : fmt::format("{}", frequency);
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

// One section while it is resolved.
struct VolumeResolver {
    DecodedSection& bake;
    Decoder& decoder;

    std::string path(std::string_view key) const { return join_path(bake.path, key); }

    // What the size was said by: the bake, or the noise that it names.
    Place size_place() const {
        for (const std::string_view key : {"size", "noise"}) {
            if (bake.at(key).source) return bake.at(key).source->place;
        }
        return bake.place;
    }

    const Noise* find_noise(std::span<const Noise> noises) const {
        const auto* name = value_of<std::string>(bake.at("noise"));
        if (!name) return nullptr;
        for (const Noise& noise : noises) {
            if (noise.name == *name) return &noise;
        }
        if (decoder.complete) report_unknown_noise(*name, noises);
        return nullptr;
    }

    void report_unknown_noise(const std::string& name, std::span<const Noise> noises) const {
        std::vector<std::string_view> names;
        for (const Noise& noise : noises) names.push_back(noise.name);
        std::string label = did_you_mean(name, names);
        if (label.empty() && names.empty()) label = "the recipe has no [noise.NAME]";
        if (label.empty()) label = fmt::format("there are: {}", fmt::join(names, ", "));
        decoder.diagnostics.error(
            "E0130", bake.at("noise").source->place,
            fmt::format("`{}` names no noise of the recipe: `{}`", path("noise"), shorten(name)),
            std::move(label));
    }

    void resolve_size(const Noise& noise) const {
        DecodedField& size = bake.at("size");
        if (size.source || noise.size[0] == 0) return;
        size.value = noise.size;
        size.derived = true;
    }

    void check_voxels(const Triple& size, const Noise& noise) const {
        const std::int64_t voxels = std::int64_t{size[0]} * size[1] * size[2];
        const auto type = choice_of<PixelType>(bake.at("pixel_type"));
        if (voxels <= most_voxels || !type) return;
        const std::size_t channels = noise.pack == NoisePacking::none ? noise.channels.size() : 1;
        const std::int64_t bytes = voxels * static_cast<std::int64_t>(channels) * bytes_of(*type);
        decoder.diagnostics.error(
            "E0126", size_place(),
            fmt::format("[{}] has {} voxels ({}) and would need {} bytes ({})", bake.path, voxels,
                        spell_size(size), bytes, spell_bytes(bytes)),
            fmt::format("at most {} (2^36) voxels", most_voxels));
    }

    void check_pixel_type() const {
        const DecodedField& decoded = bake.at("pixel_type");
        const auto type = choice_of<PixelType>(decoded);
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
            fmt::format("`{}` is {}, which {} has not", path("pixel_type"),
                        decoded.field->choices[static_cast<std::size_t>(*type)].name,
                        fmt::join(without, " and ")),
            "unorm8 and unorm16 go with formats = [\"bin\"] alone; float and half with all");
    }

    void check_columns(const Triple& size) const {
        const DecodedField& decoded = bake.at("columns");
        const auto* columns = value_of<double>(decoded);
        if (!columns) return;
        // A row of an atlas is made whole: a longer one would take memory that grows with it.
        constexpr double kWidest = 1 << 20;
        const bool wide = *columns * size[0] > kWidest;
        if (*columns <= size[2] && !wide) return;
        decoder.diagnostics.error(
            "E0110", decoded.source->place,
            fmt::format("`{}` is out of range: {}", path("columns"), static_cast<int>(*columns)),
            *columns > size[2] ? fmt::format("there are {} slices", size[2])
                               : fmt::format("an atlas is at most {} voxels wide: {} columns",
                                             kWidest, static_cast<int>(kWidest) / size[0]));
    }

    void resolve_levels(const Triple& size) const {
        DecodedField& decoded = bake.at("mips");
        const auto* asked = value_of<double>(decoded);
        if (!asked) return;
        const double levels = levels_of(size);
        if (*asked > levels) {
            decoder.diagnostics.error(
                "E0110", decoded.source->place,
                fmt::format("`{}` is out of range: {}", path("mips"), static_cast<int>(*asked)),
                fmt::format("{} has {} levels down to one voxel", spell_size(size),
                            static_cast<int>(levels)));
        }
        if (*asked == 0) decoded.value = levels;
    }

    // floor(log2(longest edge)) + 1.
    static int levels_of(const Triple& size) {
        int levels = 1;
        for (int edge = *std::max_element(size.begin(), size.end()); edge > 1; edge /= 2) ++levels;
        return levels;
    }

    // Which of a series' octaves count: one of gain 0 is not there.
    template <class Test>
    static std::optional<std::size_t> first_octave(const NoiseOctaves& octaves, Test test) {
        const std::size_t count = std::min(octaves.frequencies.size(), octaves.gains.size());
        for (std::size_t i = 0; i < count; ++i) {
            if (octaves.gains[i] > 0 && test(octaves.frequencies[i])) return i;
        }
        return std::nullopt;
    }

    std::string describe_octave(const Noise& noise, const NoiseChannel& channel,
                                const NoiseOctaves& octaves, std::size_t octave) const {
        const bool cellular = &octaves == &channel.worley_octaves;
        return fmt::format("octave {} of channel {} of noise `{}` ({}frequency {})", octave + 1,
                           channel.name, noise.name, cellular ? "Worley, " : "",
                           spell_frequency(octaves.frequencies[octave]));
    }

    // False if an octave is nothing, which is reported. The derivatives that curl noise is made of
    // are not 0 where gradient noise is.
    bool check_zero(const Noise& noise, const NoiseChannel& channel, const Triple& size) const {
        if (channel.type != NoiseType::perlin && channel.type != NoiseType::perlin_worley)
            return true;
        const auto octave = first_octave(channel.octaves, [&](const Triple& frequency) {
            return is_zero_everywhere(frequency, size, noise.sampling);
        });
        if (!octave) return true;
        decoder.diagnostics.error(
            "E0127", size_place(),
            fmt::format("{} is 0 at every voxel of {}",
                        describe_octave(noise, channel, channel.octaves, *octave),
                        spell_size(size)),
            "a larger or odd size, a lower frequency, or an octave less");
        return false;
    }

    void warn_of_coarse(const Noise& noise, const NoiseChannel& channel, const Triple& size) const {
        for (const NoiseOctaves* octaves : {&channel.octaves, &channel.worley_octaves}) {
            const auto octave = first_octave(
                *octaves, [&](const Triple& frequency) { return is_coarse(frequency, size); });
            if (!octave) continue;
            decoder.diagnostics.warning(
                "W0203", size_place(),
                fmt::format("{} has fewer than {} voxels a cell at size {}",
                            describe_octave(noise, channel, *octaves, *octave),
                            fewest_voxels_per_cell, spell_size(size)),
                "it aliases: a larger size, or a lower frequency");
            return;
        }
    }
};

}  // namespace

void resolve_noise_volume(DecodedSection& bake, std::span<const Noise> noises, Decoder& decoder) {
    const VolumeResolver resolver{bake, decoder};
    resolver.check_pixel_type();
    const Noise* noise = resolver.find_noise(noises);
    if (noise) resolver.resolve_size(*noise);
    const auto* size = value_of<Triple>(bake.at("size"));
    if (!size) return;
    resolver.check_columns(*size);
    resolver.resolve_levels(*size);
    if (!noise) return;
    resolver.check_voxels(*size, *noise);
    for (const NoiseChannel& channel : noise->channels) {
        if (resolver.check_zero(*noise, channel, *size)) {
            resolver.warn_of_coarse(*noise, channel, *size);
        }
    }
}

}  // namespace skybake::config
