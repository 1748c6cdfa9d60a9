// Keys that name another section of the recipe: a bake's noise, a cloud's detail.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/fields/section_decoder.h"

namespace skybake::config {

// What a key names, for messages.
struct ReferenceWords {
    std::string_view code;     // "E0130"
    std::string_view noun;     // "noise"
    std::string_view section;  // "[noise.NAME]"
};

inline constexpr ReferenceWords noise_reference{"E0130", "noise", "[noise.NAME]"};
inline constexpr ReferenceWords layer_reference{"E0138", "layer", "[atmosphere.layers.NAME]"};
inline constexpr ReferenceWords particles_reference{"E0140", "particles", "[particles.NAME]"};
inline constexpr ReferenceWords cloud_reference{"E0132", "cloud", "[clouds.NAME]"};

// The text of a field; null if it has none.
const std::string* text_of(const DecodedField& decoded);

// The key names none of `names`.
void report_unknown_name(const DecodedSection& section, std::string_view key,
                         std::span<const std::string_view> names, const ReferenceWords& words,
                         Decoder& decoder);

// The one that the field `key` names, among things with a member `name`; null if the field has no
// value or an empty one, or if there is none of that name, which is reported unless a source is
// missing.
template <class T>
const T* find_named(const DecodedSection& section, std::string_view key, std::span<const T> things,
                    const ReferenceWords& words, Decoder& decoder) {
    const std::string* name = text_of(section.at(key));
    if (!name || (name->empty() && !section.at(key).field->required)) return nullptr;
    std::vector<std::string_view> names;
    for (const T& thing : things) {
        if (thing.name == *name) return &thing;
        names.push_back(thing.name);
    }
    if (decoder.complete) report_unknown_name(section, key, names, words, decoder);
    return nullptr;
}

}  // namespace skybake::config
