// One recipe, many values: the variants that [sweep] and --vary ask for.
//
// An axis is a key that varies, or several that walk together (`zip`, `sobol`). The variants are
// the axes' cross product, counted from 0; the last axis varies fastest.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "config/fields/fields.h"

namespace skybake::config {

// The most variants that a sweep may have.
inline constexpr int most_variants = 100'000;

struct SweepValue {
    std::string toml;   // "\"8 km\"", as --set takes it
    std::string plain;  // "8 km", for tables and names
};

struct SweepAxis {
    std::vector<std::string> paths;             // as join_path spells them
    std::vector<std::vector<SweepValue>> rows;  // rows[i][k] is the i-th value of paths[k]
};

struct Sweep {
    std::vector<SweepAxis> axes;
};

// 0 where nothing varies.
int variant_count(const Sweep& sweep);

// Everything that varies, axis by axis.
std::vector<std::string> swept_paths(const Sweep& sweep);

// The values of a variant, in the order of swept_paths; 0 <= index < variant_count(sweep).
std::vector<SweepValue> variant_values(const Sweep& sweep, int index);

// The same as texts of --set, "a.b=c".
std::vector<std::string> variant_settings(const Sweep& sweep, int index);

// The rows of [sweep].
enum class SweepScale { linear, log };

std::span<const Field> sweep_fields();        // besides the paths that vary
std::span<const Field> sweep_range_fields();  // of a range in it

// Sobol's low-discrepancy points, which cover a box of many dimensions evenly for any first so many
// of them.
inline constexpr int sobol_dimensions = 16;

// The coordinate of point `index` (from 0: the origin) along a dimension (from 0), in [0, 1), a
// multiple of 2^-32. Any 2^k points from a multiple of 2^k on have one coordinate in each 2^-k of
// the range. Not scrambled: point i is the same however many there are.
//
// I. M. Sobol, "On the distribution of points in a cube and the approximate evaluation of
// integrals", 1967, with the direction numbers of S. Joe and F. Y. Kuo, "Constructing Sobol
// sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30, 2008, which their
// authors publish under a BSD-style licence (sweep.cpp).
double sobol_coordinate(std::uint32_t index, int dimension);

}  // namespace skybake::config
