// From radiance to what a screen shows.
#pragma once

#include "bakers/field/image.h"
#include "bakers/plot/drawing.h"

namespace skybake {

// Scene-linear RGB (or one channel, shown grey) times `exposure` through the tone curve that
// `tone_curve_name` states, then sRGB. Values must be finite; negative ones show as black.
Picture tone_mapped(const Image2<float>& radiance, double exposure);

// "1 - exp(-exposure L)", as captions say it.
const char* tone_curve_name();

// The exposure that brings the 99th percentile of luminance to 0.85 of white.
double exposure_for(const Image2<float>& radiance);

}  // namespace skybake
