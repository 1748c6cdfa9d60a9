// One recipe, many values: the variants that [sweep] and --vary ask for.
//
// An axis is a key that varies, or several that walk together (`zip`, `sobol`). The variants are
// the axes' cross product, counted from 0; the last axis varies fastest.
#pragma once

#include <string>
#include <vector>

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

}  // namespace skybake::config
