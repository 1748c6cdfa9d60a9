#include "config/fields/named_reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/presets/presets.h"
#include "config/text/key_path.h"
#include "config/text/suggest.h"

namespace skybake::config {

const std::string* text_of(const DecodedField& decoded) {
    return decoded.value ? std::get_if<std::string>(&*decoded.value) : nullptr;
}

namespace {

// The section that is missing, where a preset can be it; empty otherwise.
std::string what_to_write(const ReferenceWords& words, const std::string& name) {
    if (words.code != noise_reference.code) return "";
    const CloudNoisePreset noise = noise_of_cloud_preset("", name);
    if (!noise.preset) return "";
    return fmt::format("add [noise.{}] with preset = \"{}\" and pack = \"{}\"", name,
                       noise.preset->name, noise.pack);
}

}  // namespace

void report_unknown_name(const DecodedSection& section, std::string_view key,
                         std::span<const std::string_view> names, const ReferenceWords& words,
                         Decoder& decoder) {
    const DecodedField& field = section.at(key);
    const std::string& name = *text_of(field);
    std::string label = did_you_mean(name, names);
    if (label.empty()) label = what_to_write(words, name);
    if (label.empty() && names.empty()) label = fmt::format("the recipe has no {}", words.section);
    if (label.empty()) label = fmt::format("this recipe has {}", fmt::join(names, ", "));
    const std::string wanted =
        is_bare_key(name)
            ? std::string(words.section).replace(words.section.find("NAME"), 4, shorten(name))
            : fmt::format("{} `{}`", words.noun, shorten(name));
    decoder.diagnostics.error(
        std::string(words.code), field.source ? field.source->place : section.place,
        fmt::format("`{}`: the recipe has no {}", join_path(section.path, key), wanted),
        std::move(label));
}

}  // namespace skybake::config
