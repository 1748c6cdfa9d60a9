// This header reads the numbers within a value: type, unit and range. It also words the errors.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/fields/fields.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// This is one field's value while it is read. The helpers below need it for their messages.
struct Reader {
    const Field& field;
    std::string_view path;
    DiagnosticList& diagnostics;
    std::optional<int> channels = {};  // the number of wavelengths; none if these are at fault

    void error(std::string code, const Value& value, std::string message, std::string label) const {
        diagnostics.error(std::move(code), value.place, std::move(message), std::move(label));
    }
};

// Returns a value as messages show it.
std::string written(const Value& value);

// Reports E0103: the value is of another kind than the one wanted.
void report_type(const Reader& reader, const Value& value, std::string_view wanted);

// Reports E0108: a list has the wrong length.
void report_count(const Reader& reader, const Value& value, std::size_t count, std::string label);

// Reports E0110, or the field's own code, for a value out of range. `label` says what is allowed.
void report_range(const Reader& reader, const Value& value, bool finite, std::string label);

// Reads a number with the unit that the field's kind asks for, checks its range and returns it in
// base units.
std::optional<double> read_number(const Reader& reader, const Value& value);

// Reads a TOML integer in the field's range.
std::optional<double> read_integer(const Reader& reader, const Value& value);

// Returns the items of a list. Returns null and reports an error if the value is no list.
const Array* list_of(const Reader& reader, const Value& value);

// Returns a list's items, of which there must be `count`. Returns null and reports an error if the
// value is not such a list. `label` names the items.
const Array* read_items(const Reader& reader, const Value& value, std::size_t count,
                        std::string label);

// Reads every number of a list, or a single number as a list of one. Returns none if one of them is
// at fault.
std::optional<std::vector<double>> read_numbers(const Reader& reader, const Value& value);

// Does so for one number or more, up to the most that the field's kind takes. `noun` names one in messages.
std::optional<FieldValue> read_one_or_more(const Reader& reader, const Value& value,
                                           std::string_view noun);

}  // namespace skybake::config
