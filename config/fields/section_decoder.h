// This header reads one table of the merged tree into the fields of its section, and then into a
// struct. It also looks up the sections that keys name.
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
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/fields/field_value.h"
#include "config/fields/fields.h"
#include "config/fields/key.h"
#include "config/text/quantity.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// These are the types of quantities that hold one number in an SI unit.
template <class T>
concept SiQuantity =
    std::same_as<T, Length> || std::same_as<T, InverseLength> || std::same_as<T, NumberDensity> ||
    std::same_as<T, Pressure> || std::same_as<T, ColumnDensity> || std::same_as<T, Angle>;

// Stores one value of a field in a member. Both come from the same row, so their types fit.
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

// This is a key of a section with struct S, and the member that the key fills.
template <class S>
struct Row {
    Field field;
    // `member` is the member, whatever its type, and `assign_to` assigns to one of that type. They
    // are null where the value is used otherwise.
    char S::*member = nullptr;
    void (*assign_to)(S& target, char S::*member, const Field& field,
                      const FieldValue& value) = nullptr;

    Row(const Field& key_field, std::nullptr_t) : field(key_field) {}

    template <class T, class Base>
    requires std::is_base_of_v<Base, S> Row(const Field& key_field, T Base::*of_base)
        : field(key_field),
          member(reinterpret_cast<char S::*>(static_cast<T S::*>(of_base))),
          assign_to([](S& target, char S::*any, const Field& of, const FieldValue& value) {
              assign(of, value, target.*reinterpret_cast<T S::*>(any));
          }) {}

    // The key is said in place, with the parts of key().
    template <class Member, class... Parts>
    Row(std::string_view name, const ValueKind& kind, Member of, const Parts&... parts)
        : Row(key(name, kind, parts...), of) {}

    void fill(S& target, const FieldValue& value) const {
        if (assign_to) assign_to(target, member, field, value);
    }
};

struct DecodedSection;

// All decoders share this while one recipe is read.
struct Decoder {
    DiagnosticList& diagnostics;
    std::vector<ResolvedValue>& values;
    bool complete = true;         // false: a source is missing, so no key is reported as missing
    std::optional<int> channels;  // the number of wavelengths, once known

    // Reports a key where it is given, as a warning if the code is one. The message is the key's path
    // and what is said of it: "is empty" gives "`volumes.a.file` is empty", and ": nothing moves"
    // needs no space.
    void report(std::string_view code, const DecodedSection& section, std::string_view key,
                std::string_view says, std::string label) const;
};

struct DecodedField {
    const Field* field = nullptr;
    std::optional<FieldValue> value = {};
    const Value* source = nullptr;  // null if it is a default or derived from other fields
    bool derived = false;

    // Returns the value, or null if there is none or it is of another type.
    template <class T>
    const T* as() const {
        return value ? std::get_if<T>(&*value) : nullptr;
    }
};

struct DecodedSection {
    std::string path;                  // "atmosphere.layers.mie"
    Place place;                       // of the table's name
    std::vector<DecodedField> fields;  // all fields of the section, in its order

    DecodedField& at(std::string_view key);
    const DecodedField& at(std::string_view key) const;
    // Returns null if the section has no such field.
    const DecodedField* find(std::string_view key) const;
    // Returns the value of a key, or null if it has none or one of another type.
    template <class T>
    const T* value(std::string_view key) const {
        return at(key).as<T>();
    }
    // Returns the value of a key as a number or as a whole one, or none if it has no value.
    std::optional<double> number(std::string_view key) const;
    std::optional<int> whole(std::string_view key) const;
    // Whether the recipe gives the key.
    bool gives(std::string_view key) const { return at(key).source != nullptr; }
    // Returns the place of a key's value, or else of another key's, or of the table's name if neither
    // is given.
    const Place& place_of(std::string_view key, std::string_view other = {}) const;
};

// Reports the name of an entry that a table's path cannot end with. `what` is what it would name: "a
// noise".
void check_name(const Entry& entry, const std::string& path, std::string_view what,
                Decoder& decoder);

// This says what happens to keys that are not given. They are filled in, and reported where they
// are required, or they are left out (in layers that are switched off).
enum class Absent { filled_in, left_out };

// Reads every field of the section, reports unknown and missing keys, and fills in defaults.
DecodedSection decode_section(const Section& section, const std::string& path, const Place& place,
                              const Table& table, Absent absent, Decoder& decoder);

// Whether a table has another key of the section, which excludes the field.
bool is_excluded(const Field& field, const Section& section, const Table& table);

// Returns the table under a key. It returns an empty table if there is none, and also if the value
// is no table, which it reports.
const Table& subtable(const Table& table, std::string_view key, const std::string& path,
                      Decoder& decoder);

// Returns the table of an entry below `path` that the user names, such as a layer. It returns null
// and reports an error if the value is no table.
const Table* named_table(const Entry& entry, const std::string& path, Decoder& decoder);

// Returns the entries of a table in the order in which its sources name them.
std::vector<const Entry*> in_reading_order(const Table& table);

// Returns the choice that a field has made, or none if the value is missing or at fault.
template <class Enum>
std::optional<Enum> choice_of(const DecodedField& decoded) {
    if (!decoded.value) return std::nullopt;
    Enum choice{};
    assign(*decoded.field, *decoded.value, choice);
    return choice;
}

// Returns the value of a field that has made this choice.
template <class Enum>
ChoiceIndex chosen(const Field& field, Enum value) {
    std::size_t index = 0;
    while (!field.choices[index].is(value)) ++index;
    return {index};
}

// Sets a value that follows from others.
template <class T>
void replace(DecodedField& decoded, T value) {
    decoded.value = std::move(value);
    decoded.derived = true;
}

// Does so unless the recipe gives a value.
template <class T>
void derive(DecodedField& decoded, T value) {
    if (!decoded.source) replace(decoded, std::move(value));
}

// Appends the section's values to those of the recipe.
void append_values(const DecodedSection& section, Decoder& decoder);

// Fills the members of `target` that the section has values for. `rows` are the rows that the
// section was made from.
template <class S>
void bind_section(const DecodedSection& section, std::span<const Row<S>> rows, S& target) {
    assert(section.fields.size() == rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::optional<FieldValue>& value = section.fields[i].value;
        if (value) rows[i].fill(target, *value);
    }
}

// Decodes the section of a table, appends its values and fills the members of `target`. `pattern` is
// the section's path, in which a `*` stands for a name, and `path` that of the table.
template <class S>
DecodedSection decode_into(S& target, std::span<const Row<S>> rows, std::string_view pattern,
                           const std::string& path, const Place& place, const Table& table,
                           Decoder& decoder) {
    DecodedSection section =
        decode_section(*find_section(pattern), path, place, table, Absent::filled_in, decoder);
    append_values(section, decoder);
    bind_section(section, rows, target);
    return section;
}

// The rest of this header is about keys that name another section of the recipe, such as a bake's
// noise or a cloud's detail.

// These words say in messages what a key names.
struct ReferenceWords {
    std::string_view code;     // "E0130"
    std::string_view noun;     // "noise"
    std::string_view section;  // "[noise.NAME]"
};

inline constexpr ReferenceWords noise_reference{"E0130", "noise", "[noise.NAME]"};
inline constexpr ReferenceWords layer_reference{"E0138", "layer", "[atmosphere.layers.NAME]"};
inline constexpr ReferenceWords particles_reference{"E0140", "particles", "[particles.NAME]"};
inline constexpr ReferenceWords volume_reference{"E0170", "volume", "[volumes.NAME]"};
inline constexpr ReferenceWords cloud_reference{"E0132", "cloud", "[clouds.NAME]"};

// Reports that the key names none of `names`.
void report_unknown_name(const DecodedSection& section, std::string_view key,
                         std::span<const std::string_view> names, const ReferenceWords& words,
                         Decoder& decoder);

// Returns the thing that the field `key` names, among things with a member `name`. It returns null
// if the field has no value or an empty one. It also returns null if no thing has that name, which
// it reports unless a source is missing.
template <class T>
const T* find_named(const DecodedSection& section, std::string_view key, std::span<const T> things,
                    const ReferenceWords& words, Decoder& decoder) {
    const auto* name = section.value<std::string>(key);
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
