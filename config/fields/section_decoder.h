// From one table of the merged tree to the fields of its section, and from those to a struct.
#pragma once

#include <cassert>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/diagnostics/diagnostic_list.h"
#include "config/fields/field_value.h"
#include "config/fields/fields.h"
#include "config/fields/resolved_value.h"
#include "config/text/value_tree.h"

namespace skybake::config {

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
    const Choice& choice = decoded.field->choices[std::get<ChoiceIndex>(*decoded.value).index];
    return static_cast<Enum>(choice.enumerator);
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

// One value into one member; both come from the same row of a field table, so they fit.
template <class S>
struct Assigner {
    S& target;
    const Field& field;
    const FieldValue& value;

    void operator()(std::monostate) const {}
    void operator()(Length S::*member) const { target.*member = {std::get<double>(value)}; }
    void operator()(InverseLength S::*member) const { target.*member = {std::get<double>(value)}; }
    void operator()(NumberDensity S::*member) const { target.*member = {std::get<double>(value)}; }
    void operator()(Angle S::*member) const { target.*member = {std::get<double>(value)}; }
    void operator()(std::array<Length, 3> S::*member) const {
        const auto& meters = std::get<std::array<double, 3>>(value);
        target.*member = {Length{meters[0]}, Length{meters[1]}, Length{meters[2]}};
    }
    void operator()(std::array<Length, 2> S::*member) const { assign_both(member); }
    void operator()(std::array<Angle, 2> S::*member) const { assign_both(member); }
    void operator()(std::vector<Angle> S::*member) const { assign_each(member); }
    void operator()(std::vector<Length> S::*member) const { assign_each(member); }
    void operator()(std::vector<InverseLength> S::*member) const { assign_each(member); }
    void operator()(int S::*member) const {
        target.*member = static_cast<int>(std::get<double>(value));
    }
    template <class T>
    void operator()(std::optional<T> S::*member) const {
        target.*member = std::get<T>(value);
    }
    template <class T>
    requires std::is_enum_v<T>
    void operator()(std::vector<T> S::*member) const {
        (target.*member).clear();
        for (const ChoiceIndex choice : std::get<std::vector<ChoiceIndex>>(value)) {
            (target.*member).push_back(enumerator<T>(choice));
        }
    }
    template <class T>
    void operator()(T S::*member) const {
        if constexpr (std::is_enum_v<T>) {
            target.*member = enumerator<T>(std::get<ChoiceIndex>(value));
        } else {
            target.*member = std::get<T>(value);
        }
    }

  private:
    template <class T>
    T enumerator(const ChoiceIndex& choice) const {
        return static_cast<T>(field.choices[choice.index].enumerator);
    }
    template <class T>
    void assign_both(std::array<T, 2> S::*member) const {
        const auto& numbers = std::get<std::array<double, 2>>(value);
        target.*member = {T{numbers[0]}, T{numbers[1]}};
    }
    template <class T>
    void assign_each(std::vector<T> S::*member) const {
        (target.*member).clear();
        for (const double number : std::get<std::vector<double>>(value)) {
            (target.*member).push_back({number});
        }
    }
};

// Fills the members of `target` that the section has values for. `table` is the bound table that
// the section was made from.
template <class S, class Bound>
void bind_section(const DecodedSection& section, std::span<const Bound> table, S& target) {
    assert(section.fields.size() == table.size());
    for (std::size_t i = 0; i < table.size(); ++i) {
        const std::optional<FieldValue>& value = section.fields[i].value;
        if (value)
            std::visit(Assigner<S>{target, *section.fields[i].field, *value}, table[i].member);
    }
}

}  // namespace skybake::config
