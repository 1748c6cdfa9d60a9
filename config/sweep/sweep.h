// This header describes the variants of one recipe that [sweep] and --vary ask for.
//
// An axis is one key that varies, or several keys that vary together (`zip`, `sobol`). The variants
// are the axes' cross product, counted from 0. The last axis varies fastest.
#pragma once

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

}  // namespace skybake::config
