// How the errors of tables that hold light are told.
#pragma once

#include <algorithm>

namespace skybake {

// Values below this share of the channel's maximum are compared with it and not with themselves.
inline constexpr double kErrorFloor = 1e-3;

inline constexpr const char* kRelativeErrorScale =
    "relative to max(reference, 1e-3 of the channel's largest)";

// As TableModel::error wants it.
inline double relative_error(double value, double reference, double scale) {
    const double denominator = std::max(reference, kErrorFloor * scale);
    return denominator > 0 ? (value - reference) / denominator : value;
}

}  // namespace skybake
