// This header turns TOML text into the plain tree of value_tree.h. Only its .cpp knows the TOML
// library.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Reads a source's text. The source must outlive the tree. It returns no table and reports one
// error if the text is not UTF-8 (E0100), is not TOML (E0101) or nests too deeply (E0121).
std::optional<Table> parse_toml(const Source& source, DiagnosticList& diagnostics);

// Reads one TOML value, as in `key = value`. It returns no value if the text is anything else, and
// reports nothing, because the caller then takes the text for a plain string.
std::optional<Value> parse_toml_value(std::string_view text);

// Reads a dotted key, whose names may be bare or quoted, and returns it in the spelling of
// join_path.
std::optional<std::string> parse_toml_key(std::string_view text);

// Spells a value as TOML text on one line.
std::string value_to_string(const Value& value);

}  // namespace skybake::config
