// Converts radiance to what a screen shows.
#pragma once

#include "bakers/field/image.h"
#include "bakers/plot/drawing.h"

namespace skybake {

// Multiplies scene-linear RGB (or one channel, shown as grey) by `exposure`, applies the tone curve
// that `tone_curve_name` states, and converts to sRGB. Values must be finite; negative values
// become black.
Picture tone_mapped(const Image2<float>& radiance, double exposure);

// The text for captions: "1 - exp(-exposure L)".
const char* tone_curve_name();

// Returns the exposure that brings the 99th percentile of luminance to 0.85 of white.
double exposure_for(const Image2<float>& radiance);

}  // namespace skybake
