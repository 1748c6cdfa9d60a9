// How the errors of tables that hold light are measured.
#pragma once

#include <algorithm>

namespace skybake {

// An error of a value below this share of its channel's maximum is relative to that share of the
// maximum, not to the value.
inline constexpr double kErrorFloor = 1e-3;

inline constexpr const char* kRelativeErrorScale =
    "relative to max(reference, 1e-3 of the channel's largest)";

// Returns the relative error, signed, as TableModel::error requires it.
inline double relative_error(double value, double reference, double scale) {
    const double denominator = std::max(reference, kErrorFloor * scale);
    return denominator > 0 ? (value - reference) / denominator : value;
}

}  // namespace skybake
