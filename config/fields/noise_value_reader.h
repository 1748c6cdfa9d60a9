// The values that only noises and their volumes have: seeds, frequencies, gains, remaps, levels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "config/fields/number_reader.h"

namespace skybake::config {

inline constexpr int most_octaves = 16;

// A TOML integer from 0 up, or text with a decimal or 0x number up to 2^64 - 1.
std::optional<std::uint64_t> read_seed(const Reader& reader, const Value& value);

// Lattice cells a tile along x, y, z: one integer for all axes, or one per axis.
std::optional<std::array<int, 3>> read_frequency(const Reader& reader, const Value& value);

// One to most_octaves of them.
std::optional<std::vector<std::array<int, 3>>> read_frequencies(const Reader& reader,
                                                                const Value& value);

// One to most_octaves numbers, at least one of them above 0.
std::optional<std::vector<double>> read_gains(const Reader& reader, const Value& value);

// [in_low, in_high, out_low, out_high] with a slope that is finite in single precision.
std::optional<std::array<double, 4>> read_remap(const Reader& reader, const Value& value);

// The edges of a smooth step, the first below the second, with a slope that is finite in single
// precision.
std::optional<std::array<double, 2>> read_edges(const Reader& reader, const Value& value);

// true: [0, 1]; false: no bounds, [-infinity, infinity]; or [low, high].
std::optional<std::array<double, 2>> read_clamp(const Reader& reader, const Value& value);

// A number of mip levels, or 0 for "all".
std::optional<double> read_levels(const Reader& reader, const Value& value);

}  // namespace skybake::config
