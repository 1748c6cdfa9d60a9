// Small pictures of light for the sheets of plans: as the eye sees them, and their differences. Light is linear
// sRGB, row 0 at the top.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/plan/choose_way.h"
#include "bakers/plot/chart.h"

namespace skybake {

// The exposure that makes the brightest tenth of a picture nearly white.
double exposure_of(const Image2<float>& truth);

Picture shown_picture(const Image2<float>& light, double exposure);

// Returns the relative difference of the luminance from the truth, from -kShownDifference to
// kShownDifference; without any light it is 0.
inline constexpr double kShownDifference = 0.2;
Picture difference_picture(const Image2<float>& light, const Image2<float>& truth);

// Returns the same of the shares of white 1 - exp(-exposure L), their plain difference.
Picture exposed_difference(const Image2<float>& light, const Image2<float>& truth, double exposure);

// Returns the way of least compared error of each family, the best first.
std::vector<std::size_t> best_of_families(const std::vector<MeasuredWay>& ways);

}  // namespace skybake
