// Converts radiance to what a screen shows.
#pragma once

#include "bakers/field/image.h"
#include "bakers/plot/drawing.h"
#include "config/sections/preview.h"

namespace skybake {

using config::ToneCurve;

// Multiplies scene-linear RGB (or one channel, shown as grey) by `exposure`, applies the curve, and
// converts to sRGB. Values must be finite; negative values become black.
//
// Each pixel adds a threshold in [0, 1) to its three exact values in bytes before it drops their
// fractions (ordered dithering). So the mean over an area is exact where rounding would show bands, each
// byte is less than 1 off, and black and white stay black and white. The thresholds depend on a pixel's
// place alone.
Picture tone_mapped(const Image2<float>& radiance, double exposure,
                    ToneCurve curve = ToneCurve::exponential);

// The text for captions: "1 - exp(-exposure L)".
const char* tone_curve_name(ToneCurve curve = ToneCurve::exponential);

// Returns the exposure that brings the 99th percentile of luminance to 0.85 of white, as the curve shows
// grey: nothing but the brightest hundredth is lost.
double exposure_for(const Image2<float>& radiance, ToneCurve curve = ToneCurve::exponential);

// Returns the exposure that brings the median luminance of the pixels that are not black to 0.25 of
// white, half a stop above middle grey, as a photographer exposes a sky: the light around the sun may
// become white.
double sky_exposure_for(const Image2<float>& radiance, ToneCurve curve = ToneCurve::exponential);

}  // namespace skybake
