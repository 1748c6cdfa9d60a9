// This header spells and splits key paths, such as "atmosphere.layers.mie.g". A name that is not a
// bare TOML key is written in quotes, as in TOML: atmosphere.layers."sea fog".g
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::config {

// Whether the name consists of letters, digits, '_' and '-', with at least one of them.
bool is_bare_key(std::string_view name);

// Returns a TOML basic string. Quotes, backslashes and control characters are escaped.
std::string toml_string(std::string_view text);

// Returns the name itself if it is a bare key, else the name in quotes.
std::string key_to_string(std::string_view name);

std::string join_path(std::string_view path, std::string_view name);

// Splits a path, as join_path writes it, into its names. `*` counts as a name. Returns none if the
// path is malformed.
std::optional<std::vector<std::string>> split_path(std::string_view path);

// Whether a path fits the pattern: it has as many names, and each name is equal to the pattern's or
// the pattern has `*` there.
bool path_matches(std::string_view path, std::string_view pattern);

// Makes a text safe for messages: it escapes bytes that are not UTF-8 or that would control a
// terminal.
std::string printable(std::string_view text);

// Does the same, and cuts the text to a length that leaves room for the rest of a message.
std::string shorten(std::string_view text);

}  // namespace skybake::config
