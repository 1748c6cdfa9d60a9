// From TOML text to the plain tree of value_tree.h. Its .cpp is the one place that knows the TOML
// library.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Reads a source's text. The source must outlive the tree. None,
// and one error, if the text is not UTF-8 (E0100), not TOML (E0101) or nests too deeply (E0121).
std::optional<Table> parse_toml(const Source& source, DiagnosticList& diagnostics);

// Reads one TOML value, as in `key = value`; none if the text is anything else. No diagnostics: the
// caller takes it for a plain string then.
std::optional<Value> parse_toml_value(std::string_view text);

// Reads a dotted key, names bare or quoted, and returns it as join_path spells it.
std::optional<std::string> parse_toml_key(std::string_view text);

// A value as TOML text on one line.
std::string value_to_string(const Value& value);

}  // namespace skybake::config
