// One value of a recipe, read as its field says, and its canonical spelling.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/diagnostic_list.h"
#include "config/fields.h"
#include "config/value_tree.h"

namespace skybake::config {

// Which of a field's choices.
struct ChoiceIndex {
    std::size_t index = 0;
};

// In base units. Kinds with one value per channel hold one per channel here.
using FieldValue =
    std::variant<bool, double, std::vector<double>, std::string, std::vector<std::string>,
                 std::array<int, 2>, ChoiceIndex, std::vector<DensityPoint>>;

// Reads and checks a value; `path` names it in messages. `channels` is the number of wavelengths,
// none if that is not known because the wavelengths are at fault. No value, and at least one error,
// if it is not what the field takes.
std::optional<FieldValue> read_field(const Field& field, std::string_view path, const Value& value,
                                     std::optional<int> channels, DiagnosticList& diagnostics);

// The field's default, which it must have, or none if it has none.
std::optional<FieldValue> default_value(const Field& field, std::optional<int> channels);

// TOML text in base units, equal for equal values.
std::string canonical_text(const Field& field, const FieldValue& value);

// "earth.toml:14", "preset earth", "--set `a.b=c`".
std::string origin(const Place& place);

}  // namespace skybake::config
