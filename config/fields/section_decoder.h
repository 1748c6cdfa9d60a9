// From one table of the merged tree to the fields of its section, and from those to a struct.
#pragma once

#include <cassert>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "config/diagnostics/diagnostic_list.h"
#include "config/fields/field_value.h"
#include "config/fields/fields.h"
#include "config/fields/resolved_value.h"
#include "config/fields/row.h"
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

}  // namespace skybake::config
