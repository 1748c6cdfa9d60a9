#include "bakers/io/spelling.h"

#include <span>

#include "config/fields.h"

namespace skybake {
namespace {

// The choices of a key of volumes, in the order of its enumeration; those of tables are the first
// of them.
std::span<const config::Choice> choices_of(std::string_view key) {
    const config::Section* section = config::find_section("bake.*", "noise_volume");
    const config::Field* field = section != nullptr ? config::find_field(*section, key) : nullptr;
    return field != nullptr ? field->choices : std::span<const config::Choice>();
}

template <class Enum>
std::string_view word_of(std::string_view key, Enum value) {
    const auto choices = choices_of(key);
    const auto index = static_cast<std::size_t>(value);
    return index < choices.size() ? choices[index].name : std::string_view();
}

template <class Enum>
std::optional<Enum> value_of(std::string_view key, std::string_view word) {
    const auto choices = choices_of(key);
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (choices[i].name == word) return static_cast<Enum>(i);
    }
    return std::nullopt;
}

}  // namespace

std::string_view spell(config::PixelType type) { return word_of("pixel_type", type); }

std::string_view spell(config::Compression compression) {
    return word_of("compression", compression);
}

std::string_view spell(config::VdbCompression compression) {
    return word_of("vdb_compression", compression);
}

std::string_view spell(config::VolumeFormat format) { return word_of("formats", format); }

std::string_view spell(config::VolumeLayout layout) { return word_of("layout", layout); }

std::optional<config::PixelType> pixel_type_of(std::string_view word) {
    return value_of<config::PixelType>("pixel_type", word);
}

std::optional<config::Compression> compression_of(std::string_view word) {
    return value_of<config::Compression>("compression", word);
}

std::optional<config::VolumeFormat> volume_format_of(std::string_view word) {
    return value_of<config::VolumeFormat>("formats", word);
}

std::optional<config::VolumeLayout> volume_layout_of(std::string_view word) {
    return value_of<config::VolumeLayout>("layout", word);
}

}  // namespace skybake
