#include "bakers/io/files/to_string.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "config/fields/fields.h"
#include "config/sections/file_formats.h"

namespace skybake {
namespace {

// Returns a field of the files' settings, which are the same for all assets.
const config::Field& field_of(std::string_view key) {
    return *config::find_field(*config::find_section("bake.*", "noise_volume"), key);
}

template <class Enum>
std::string_view word_of(std::string_view key, Enum value) {
    return config::choice_name(field_of(key), value);
}

template <class Enum>
std::optional<Enum> value_of(std::string_view key, std::string_view word) {
    for (const config::Choice& choice : field_of(key).choices) {
        if (choice.name == word) return static_cast<Enum>(choice.enumerator);
    }
    return std::nullopt;
}

// The words of enumerations that do not occur in recipes, in the order of their enumerators.
constexpr std::array<std::string_view, 2> end_point_words = {"texel_centres", "texture_edges"};
constexpr std::array<std::string_view, 2> wrap_words = {"clamp", "repeat"};
constexpr std::array<std::string_view, 2> filter_words = {"linear", "nearest"};

template <class Enum>
std::optional<Enum> value_among(std::span<const std::string_view> words, std::string_view word) {
    const auto found = std::ranges::find(words, word);
    if (found == words.end()) return std::nullopt;
    return static_cast<Enum>(found - words.begin());
}

}  // namespace

std::string_view to_string(PixelType type) { return word_of("pixel_type", type); }

std::string_view to_string(config::Compression compression) {
    return word_of("compression", compression);
}

std::string_view to_string(config::VdbCompression compression) {
    return word_of("vdb_compression", compression);
}

std::string_view to_string(config::Ktx2Compression compression) {
    return word_of("ktx2_compression", compression);
}

std::string_view to_string(config::FileFormat format) { return config::facts_of(format).name; }

std::string_view to_string(config::SheetLayout layout) { return word_of("layout", layout); }

std::string_view to_string(TexelConvention end_points) {
    return end_point_words[static_cast<std::size_t>(end_points)];
}

std::string_view to_string(AxisWrap wrap) { return wrap_words[static_cast<std::size_t>(wrap)]; }

std::string_view to_string(AxisFilter filter) {
    return filter_words[static_cast<std::size_t>(filter)];
}

std::optional<TexelConvention> end_points_of(std::string_view word) {
    return value_among<TexelConvention>(end_point_words, word);
}

std::optional<AxisWrap> axis_wrap_of(std::string_view word) {
    return value_among<AxisWrap>(wrap_words, word);
}

std::optional<AxisFilter> axis_filter_of(std::string_view word) {
    return value_among<AxisFilter>(filter_words, word);
}

std::optional<PixelType> pixel_type_of(std::string_view word) {
    return value_of<PixelType>("pixel_type", word);
}

std::optional<config::SheetLayout> sheet_layout_of(std::string_view word) {
    return value_of<config::SheetLayout>("layout", word);
}

std::string byte_size_text(double bytes) {
    constexpr double kib = 1024;
    if (bytes < kib) return fmt::format("{:.0f} B", bytes);
    if (bytes < kib * kib) return fmt::format("{:.0f} KiB", bytes / kib);
    if (bytes < kib * kib * kib) return fmt::format("{:.1f} MiB", bytes / (kib * kib));
    return fmt::format("{:.1f} GiB", bytes / (kib * kib * kib));
}

}  // namespace skybake
