// This header describes the variants of one recipe that [sweep] and --vary ask for.
//
// An axis is one key that varies, or several keys that vary together (`zip`, `sobol`). The variants
// are the axes' cross product, counted from 0. The last axis varies fastest.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "config/fields/fields.h"

namespace skybake::config {

// A sweep may have at most this many variants.
inline constexpr int most_variants = 100'000;

struct SweepValue {
    std::string toml;   // "\"8 km\"", as --set takes it
    std::string plain;  // "8 km", for tables and names
};

struct SweepAxis {
    std::vector<std::string> paths;             // in the spelling of join_path
    std::vector<std::vector<SweepValue>> rows;  // rows[i][k] is the i-th value of paths[k]
};

struct Sweep {
    std::vector<SweepAxis> axes;
};

// Returns 0 if nothing varies.
int variant_count(const Sweep& sweep);

// Returns the paths of all keys that vary, axis by axis.
std::vector<std::string> swept_paths(const Sweep& sweep);

// Returns the values of a variant, in the order of swept_paths. The index must satisfy 0 <= index <
// variant_count(sweep).
std::vector<SweepValue> variant_values(const Sweep& sweep, int index);

// Returns the same values as texts of --set, such as "a.b=c".
std::vector<std::string> variant_settings(const Sweep& sweep, int index);

// These functions return the rows of [sweep].
enum class SweepScale { linear, log };

std::span<const Field> sweep_fields();        // all keys except the paths that vary
std::span<const Field> sweep_range_fields();  // the keys of a range in [sweep]

inline constexpr int sobol_dimensions = 16;

// Returns the coordinate of a point of Sobol's low-discrepancy sequence along a dimension. It lies
// in [0, 1) and is a multiple of 2^-32. The first n points cover a box of many dimensions evenly,
// for any n. Points and dimensions count from 0, and point 0 is the origin. Any 2^k consecutive
// points whose first index is a multiple of 2^k have one coordinate in each of the 2^k equal parts
// of [0, 1). The points are not scrambled: point i is the same however many points there are.
//
// The method is from I. M. Sobol, "On the distribution of points in a cube and the approximate
// evaluation of integrals", 1967. The direction numbers are from S. Joe and F. Y. Kuo,
// "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30,
// 2008. Their authors publish them under a BSD-style licence (sweep.cpp).
double sobol_coordinate(std::uint32_t index, int dimension);

}  // namespace skybake::config
