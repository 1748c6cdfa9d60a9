// From one table of the merged tree to the fields of its section, and from those to a struct.
#pragma once

#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/fields/field_value.h"
#include "config/fields/fields.h"
#include "config/text/quantity.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// A key and the struct member that it fills.
template <class T>
concept SiQuantity = std::same_as<T, Length> || std::same_as<T, InverseLength> ||
    std::same_as<T, NumberDensity> || std::same_as<T, Angle>;

// One value of a field into a member. Both come from the same row, so they fit.
template <class T>
void assign(const Field&, const FieldValue& value, T& member) {
    member = std::get<T>(value);
}

inline void assign(const Field&, const FieldValue& value, int& member) {
    member = static_cast<int>(std::get<double>(value));
}

template <SiQuantity T>
void assign(const Field&, const FieldValue& value, T& member) {
    member = T{std::get<double>(value)};
}

template <SiQuantity T, std::size_t count>
void assign(const Field&, const FieldValue& value, std::array<T, count>& member) {
    const auto& numbers = std::get<std::array<double, count>>(value);
    for (std::size_t i = 0; i < count; ++i) member[i] = T{numbers[i]};
}

template <SiQuantity T>
void assign(const Field&, const FieldValue& value, std::vector<T>& member) {
    member.clear();
    for (const double number : std::get<std::vector<double>>(value)) member.push_back(T{number});
}

template <class T>
void assign(const Field&, const FieldValue& value, std::optional<T>& member) {
    member = std::get<T>(value);
}

template <class T>
requires std::is_enum_v<T>
void assign(const Field& field, const FieldValue& value, T& member) {
    member = static_cast<T>(field.choices[std::get<ChoiceIndex>(value).index].enumerator);
}

template <class T>
requires std::is_enum_v<T>
void assign(const Field& field, const FieldValue& value, std::vector<T>& member) {
    member.clear();
    for (const ChoiceIndex choice : std::get<std::vector<ChoiceIndex>>(value)) {
        member.push_back(static_cast<T>(field.choices[choice.index].enumerator));
    }
}

// A key of a section with struct S.
template <class S>
struct Row {
    Field field;
    // The member, whatever its type, and what assigns to one of that type; null where the value is
    // used otherwise.
    char S::*member = nullptr;
    void (*assign_to)(S& target, char S::*member, const Field& field,
                      const FieldValue& value) = nullptr;

    Row(const Field& key, std::nullptr_t) : field(key) {}

    template <class T, class Base>
    requires std::is_base_of_v<Base, S> Row(const Field& key, T Base::*of_base)
        : field(key),
          member(reinterpret_cast<char S::*>(static_cast<T S::*>(of_base))),
          assign_to([](S& target, char S::*any, const Field& of, const FieldValue& value) {
              assign(of, value, target.*reinterpret_cast<T S::*>(any));
          }) {}

    void fill(S& target, const FieldValue& value) const {
        if (assign_to) assign_to(target, member, field, value);
    }
};

// What all decoders share while one recipe is read.
struct Decoder {
    DiagnosticList& diagnostics;
    std::vector<ResolvedValue>& values;
    bool complete = true;         // false: a source is missing, so no key is reported as missing
    std::optional<int> channels;  // the number of wavelengths, once known
};

struct DecodedField {
    const Field* field = nullptr;
    std::optional<FieldValue> value = {};
    const Value* source = nullptr;  // null: a default, or derived from other fields
    bool derived = false;
};

struct DecodedSection {
    std::string path;                  // "atmosphere.layers.mie"
    Place place;                       // of the table's name
    std::vector<DecodedField> fields;  // as many as the section has, in its order

    DecodedField& at(std::string_view key);
    const DecodedField& at(std::string_view key) const;
};

// What is not given: filled in and reported as missing, or (layers that are switched off) left be.
enum class Absent { filled_in, left_out };

// Reads every field of the section, reports unknown and missing keys, fills in defaults.
DecodedSection decode_section(const Section& section, const std::string& path, const Place& place,
                              const Table& table, Absent absent, Decoder& decoder);

// The table under a key: an empty one if there is none, or if it is no table, which is reported.
const Table& subtable(const Table& table, std::string_view key, const std::string& path,
                      Decoder& decoder);

// The table of an entry that the user names, such as a layer, below `path`; null, and an error, if
// it is none.
const Table* named_table(const Entry& entry, const std::string& path, Decoder& decoder);

// The choice that a field has made; none if that is missing or at fault.
template <class Enum>
std::optional<Enum> choice_of(const DecodedField& decoded) {
    if (!decoded.value) return std::nullopt;
    Enum choice{};
    assign(*decoded.field, *decoded.value, choice);
    return choice;
}

// The value of a field that has this choice.
template <class Enum>
ChoiceIndex chosen(const Field& field, Enum value) {
    std::size_t index = 0;
    while (!field.choices[index].is(value)) ++index;
    return {index};
}

// A value that follows from others, where the recipe gives none.
template <class T>
void derive(DecodedField& decoded, T value) {
    if (decoded.source) return;
    decoded.value = std::move(value);
    decoded.derived = true;
}

// Appends the section's values to those of the recipe.
void append_values(const DecodedSection& section, Decoder& decoder);

// Fills the members of `target` that the section has values for. `rows` are those that the section
// was made from.
template <class S>
void bind_section(const DecodedSection& section, std::span<const Row<S>> rows, S& target) {
    assert(section.fields.size() == rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::optional<FieldValue>& value = section.fields[i].value;
        if (value) rows[i].fill(target, *value);
    }
}

// Keys that name another section of the recipe: a bake's noise, a cloud's detail.

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
