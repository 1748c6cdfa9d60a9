#include "config/optics/standard_profiles.h"

#include <cassert>

#include "config/optics/interpolated_table.h"

namespace skybake::config {
namespace {

constexpr ProfilePoint kAirProfile[] = {
#include "config/optics/tables/air_profile.inc"
};

constexpr ProfilePoint kOzoneProfile[] = {
#include "config/optics/tables/ozone_profile.inc"
};

constexpr ProfilePoint kWaterVaporProfile[] = {
#include "config/optics/tables/water_vapor_profile.inc"
};

constexpr ProfilePoint kNitrogenDioxideProfile[] = {
#include "config/optics/tables/nitrogen_dioxide_profile.inc"
};

}  // namespace

std::span<const ProfilePoint> standard_profile(Gas gas) {
    if (gas == Gas::ozone) return kOzoneProfile;
    if (gas == Gas::nitrogen_dioxide) return kNitrogenDioxideProfile;
    if (gas == Gas::water_vapor) return kWaterVaporProfile;
    return kAirProfile;
}

double profile_at(std::span<const ProfilePoint> profile, double altitude_m) {
    assert(altitude_m >= 0);
    return interpolate(profile, &ProfilePoint::altitude_m, &ProfilePoint::relative_density,
                       altitude_m);
}

}  // namespace skybake::config
