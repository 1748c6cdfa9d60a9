// The numbers within a value: type, unit and range, with the words for what is at fault.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/fields/fields.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// One field's value while it is read: what every helper below needs for its messages.
struct Reader {
    const Field& field;
    std::string_view path;
    DiagnosticList& diagnostics;
    std::optional<int> channels = {};  // the number of wavelengths; none if they are at fault

    void error(std::string code, const Value& value, std::string message, std::string label) const {
        diagnostics.error(std::move(code), value.place, std::move(message), std::move(label));
    }
};

// A value as messages show it.
std::string written(const Value& value);

// E0103: the value is of another kind than the one wanted.
void report_type(const Reader& reader, const Value& value, std::string_view wanted);

// E0108: a list of the wrong length.
void report_count(const Reader& reader, const Value& value, std::size_t count, std::string label);

// E0110, or the field's own code: `label` says what is allowed.
void report_range(const Reader& reader, const Value& value, bool finite, std::string label);

// A number with the unit that the field's kind asks for, in its range and in base units.
std::optional<double> read_number(const Reader& reader, const Value& value);

// A TOML integer in the field's range.
std::optional<double> read_integer(const Reader& reader, const Value& value);

// A list's items, of which there must be `count`; null, and an error, if it is none. `label` names
// them.
const Array* read_items(const Reader& reader, const Value& value, std::size_t count,
                        std::string label);

// Each of a list's values, or the one value; none if one of them is at fault.
std::optional<std::vector<double>> read_numbers(const Reader& reader, const Value& value);

}  // namespace skybake::config
