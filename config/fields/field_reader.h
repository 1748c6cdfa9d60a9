// This header turns a value of the tree into a value of a field. It checks the type, the dimension,
// the number of values and the range.
#pragma once

#include <optional>
#include <string_view>

#include "config/diagnostics/diagnostic.h"
#include "config/fields/field_value.h"
#include "config/fields/fields.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Reads and checks a value. `path` names it in messages. `channels` is the number of wavelengths,
// or none if the wavelengths are at fault. If the value is not what the field takes, it returns no
// value and reports at least one error.
std::optional<FieldValue> read_field(const Field& field, std::string_view path, const Value& value,
                                     std::optional<int> channels, DiagnosticList& diagnostics);

// Returns the field's default, or none if the field has none.
std::optional<FieldValue> default_value(const Field& field, std::optional<int> channels);

}  // namespace skybake::config
