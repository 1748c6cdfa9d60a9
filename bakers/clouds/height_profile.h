// How full a cloud is by height: the factor that gives noise a base, a body and a top.
#pragma once

#include <array>

#include "config/sections/cloud.h"

namespace skybake::cloud {

// Profiles of the three classic types at height h, 0 at the base and 1 at the top: stratus,
// stratocumulus, cumulus. Each rises and falls smoothly between four heights (Schneider and Vos
// 2015, "The Real-Time Volumetric Cloudscapes of Horizon: Zero Dawn", draw them; the heights are
// those of the open implementations of it). In [0, 1]; 0 at and beyond the ends.
std::array<double, 3> classic_profiles(double h);

// Weights of the three for a cloud type in [0, 1]: 0 stratus, 1/2 stratocumulus, 1 cumulus.
std::array<double, 3> type_weights(double cloud_type);

// The profile at h in [0, 1] for profiles that do not depend on a map; blended: with its own
// cloud_type. At least 0.
//
//   thesis   (1 - exp(-b h)) exp(-f h), at most 0.751882 for b = 50, f = 4 (Olajos 2016)
double height_profile(const config::HeightProfile& profile, double h);

}  // namespace skybake::cloud
