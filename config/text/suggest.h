// The nearest known name to a misspelt one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skybake::config {

// Restricted Damerau-Levenshtein distance in bytes: insertions, deletions, substitutions and swaps
// of neighbours each cost 1.
int edit_distance(std::string_view a, std::string_view b);

// The known name nearest to `name`, the first of equals; none if every one is further away than a
// third of the name's length plus one. A `name` longer than any sensible one has no neighbour.
std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string_view> known);

// "did you mean `x`?", or nothing.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

}  // namespace skybake::config
