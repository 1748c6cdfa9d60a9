// Columns of the standard atmosphere: molecules per square metre from the ground to space.
#pragma once

#include <span>

#include "config/optics/gases.h"
#include "config/optics/standard_profiles.h"

namespace skybake::config {

// One Dobson unit is 10 um of pure gas at 0 C and 1013.25 hPa.
constexpr double kDobsonUnit_per_m2 = 2.686780111e20;

// Of the US standard of AFGL-TR-86-0110. A millimetre of precipitable water is a kilogram per square
// metre, which is 55.51 mol, within 0.1 %.
constexpr double kStandardWaterVapor_per_m2 = 14.2 * 55.508 * 6.02214076e23;

inline double standard_column_per_m2(Gas gas) {
    if (gas == Gas::ozone) return 300 * kDobsonUnit_per_m2;
    // 3e15 per cm^2 is clean air by day, almost all of it in the stratosphere.
    if (gas == Gas::nitrogen_dioxide) return 3e19;
    if (gas == Gas::water_vapor) return kStandardWaterVapor_per_m2;
    // Shares of air of the US Standard Atmosphere 1976.
    const double share = gas == Gas::oxygen           ? 0.209476
                         : gas == Gas::nitrogen       ? 0.78084
                         : gas == Gas::carbon_dioxide ? 0.000314
                                                      : 1.0;
    return share * air_column_per_m2();
}

// Returns the integral of a profile over altitude in metres.
inline double profile_depth_m(std::span<const ProfilePoint> profile) {
    double depth = 0;
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const double thickness = profile[i].altitude_m - profile[i - 1].altitude_m;
        depth += thickness * (profile[i].relative_density + profile[i - 1].relative_density) / 2;
    }
    return depth;
}

}  // namespace skybake::config
