// Key paths: "atmosphere.layers.mie.g". A name that is no bare TOML key is written in quotes, as in
// TOML: atmosphere.layers."sea fog".g
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::config {

// Letters, digits, '_' and '-', at least one.
bool is_bare_key(std::string_view name);

// A TOML basic string: quotes, backslashes and control characters are escaped.
std::string toml_string(std::string_view text);

// The name itself if it is a bare key, else in quotes.
std::string key_to_string(std::string_view name);

std::string join_path(std::string_view path, std::string_view name);

// The names of a path as join_path writes it (`*` passes as a name); none if it is malformed.
std::optional<std::vector<std::string>> split_path(std::string_view path);

// Whether a path is one that the pattern describes: as many names, each equal or met by a `*`.
bool path_matches(std::string_view path, std::string_view pattern);

// For messages: what is no UTF-8 or would act on a terminal is escaped.
std::string printable(std::string_view text);

// The same, cut to a length that leaves room for the rest of a message.
std::string shorten(std::string_view text);

}  // namespace skybake::config
