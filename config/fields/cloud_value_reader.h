// The values that only clouds have: pairs and bounds, three lengths, powers of two.
#pragma once

#include <array>
#include <optional>

#include "config/fields/number_reader.h"

namespace skybake::config {

// Two numbers: [0.2, 0.35].
std::optional<std::array<double, 2>> read_pair(const Reader& reader, const Value& value);

// The same, the first not above the second.
std::optional<std::array<double, 2>> read_bounds(const Reader& reader, const Value& value);

// Three lengths: along x, y and z.
std::optional<std::array<double, 3>> read_lengths(const Reader& reader, const Value& value);

// 1, 2, 4 ... in the field's range.
std::optional<double> read_power_of_two(const Reader& reader, const Value& value);

}  // namespace skybake::config
