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
// The default curve, film, has the toe, the straight part and the shoulder of Uchimura 2017 ("HDR Theory
// and Practice", CEDEC) with his values; grey light from 0.22 to 0.532 is shown as it is. It is applied
// to the greatest channel, and the others keep their ratios to it, so that an orange glow does not turn
// yellow, as it does where each channel has a curve of its own. As in the Khronos PBR Neutral tone
// mapper (2024), the share 1 - 1 / (1 + 0.15 (light - shown)) of white is mixed in, both being the greatest
// channel's: 5 % for a cloud just below white, half for light eight times as bright. White alone turns
// orange to pink, so 15 % of the result has the curve on each channel: hues of sunsets and skies stay within
// 10 degrees of Oklab over six stops, where 1 - exp(-light) turns them by 40.
//
// Before the curve, colours near the border of what a screen shows, and beyond it, are drawn within
// it, as the Reference Gamut Compression of the Academy Color Encoding System 1.3 does in its own
// primaries: the sun near the horizon has less than no blue in sRGB, and a sun without blue within
// a sky that has some looks like paint.
//
// Each pixel adds a threshold in [0, 1) to its three exact values in bytes before it drops their
// fractions (ordered dithering). So the mean over an area is exact where rounding would show bands, each
// byte is less than 1 off, and black and white stay black and white. The thresholds depend on a pixel's
// place alone.
Picture tone_mapped(const Image2<float>& radiance, double exposure,
                    ToneCurve curve = ToneCurve::film);

// The text for captions: "film".
const char* tone_curve_name(ToneCurve curve = ToneCurve::film);

// Returns the luminance by Rec. 709, whose primaries are those of sRGB; grey light is its own.
double luminance(const float* texel, int channels);

// A rule by which an exposure is chosen: it brings a quantile of luminance to `share` of white, as the
// curve shows grey, and is then multiplied by `factor`.
struct ExposureRule {
    double quantile = 0;
    double share = 0;
    double factor = 1;
    bool lit_pixels = false;  // pixels that are black do not count
    // The exposure is at most that which brings this quantile to this share of white; 0: no limit.
    double bright_quantile = 0;
    double bright_share = 0;
    double least_median = 0;  // the exposure brings the median to at least this share of white
};

// For tables and other pictures without a sky: only the brightest 1 % clips.
inline constexpr ExposureRule kWholePicture = {0.99, 0.85, 1, false};

// For pictures with clouds: sunlit cloud is the brightest part, and lies just below white, at 235 to 245 of
// 255 by the default curve, where photographers put it. Against the light, the glow of thin cloud around the
// sun is far brighter than all else, and burns out before the rest is darker than a clear sky is shown.
inline constexpr ExposureRule kCloudPicture = {0.99, 0.9, 1, false, 0, 0, 0.25};

// For clear skies by day: the median is half a stop above middle grey, as a photographer exposes a sky. A low sun
// is so much brighter than its sky that this would burn out the light around it; so no more than a
// twentieth of the picture is brighter than 0.9 of white.
inline constexpr ExposureRule kSkyPicture = {0.5, 0.25, 1, true, 0.95, 0.9};

// The factor of exposures for a scene whose level ground has this share of its light by day (daylight_shares of
// cloud_view.h). A picture of an evening that is as bright as one by day does not look like an evening, so what is
// shown is as the power kUnadapted of the light: a stop for a hundredth. Below the light of a full moon it stays.
double dimming(double daylight_share);
inline constexpr double kUnadapted = 0.15;
inline constexpr double kMoonlight = 1e-6;  // of a sun of 30 degrees

// Returns the exposure that the rule chooses; 1 if the quantile is black.
double exposure_by(const ExposureRule& rule, const Image2<float>& radiance,
                   ToneCurve curve = ToneCurve::film);

inline double exposure_for(const Image2<float>& radiance, ToneCurve curve = ToneCurve::film) {
    return exposure_by(kWholePicture, radiance, curve);
}
inline double cloud_exposure_for(const Image2<float>& radiance, ToneCurve curve = ToneCurve::film,
                                 double daylight_share = 1) {
    return dimming(daylight_share) * exposure_by(kCloudPicture, radiance, curve);
}
inline double sky_exposure_for(const Image2<float>& radiance, ToneCurve curve = ToneCurve::film,
                               double daylight_share = 1) {
    return dimming(daylight_share) * exposure_by(kSkyPicture, radiance, curve);
}

}  // namespace skybake
