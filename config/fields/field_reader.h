// From a value of the tree to a value of a field: type, dimension, number of values and range.
#pragma once

#include <optional>
#include <string_view>

#include "config/diagnostics/diagnostic.h"
#include "config/fields/field_value.h"
#include "config/fields/fields.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Reads and checks a value; `path` names it in messages. `channels` is the number of wavelengths,
// none if that is not known because the wavelengths are at fault. No value, and at least one error,
// if it is not what the field takes.
std::optional<FieldValue> read_field(const Field& field, std::string_view path, const Value& value,
                                     std::optional<int> channels, DiagnosticList& diagnostics);

// The field's default, which it must have, or none if it has none.
std::optional<FieldValue> default_value(const Field& field, std::optional<int> channels);

}  // namespace skybake::config
