#include "config/named_reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/key_path.h"
#include "config/suggest.h"

namespace skybake::config {

const std::string* text_of(const DecodedField& decoded) {
    return decoded.value ? std::get_if<std::string>(&*decoded.value) : nullptr;
}

void report_unknown_name(const DecodedSection& section, std::string_view key,
                         std::span<const std::string_view> names, const ReferenceWords& words,
                         Decoder& decoder) {
    const DecodedField& field = section.at(key);
    const std::string& name = *text_of(field);
    std::string label = did_you_mean(name, names);
    if (label.empty() && names.empty()) label = fmt::format("the recipe has no {}", words.section);
    if (label.empty()) label = fmt::format("there are: {}", fmt::join(names, ", "));
    decoder.diagnostics.error(std::string(words.code),
                              field.source ? field.source->place : section.place,
                              fmt::format("`{}` names no {} of the recipe: `{}`",
                                          join_path(section.path, key), words.noun, shorten(name)),
                              std::move(label));
}

}  // namespace skybake::config
