// Scalar fields in colours. Both colour maps change evenly for the eye and keep their order for
// readers who do not see red and green apart.
#pragma once

#include <string>

#include "bakers/field/image.h"
#include "bakers/plot/axis.h"
#include "bakers/plot/drawing.h"

namespace skybake {

// viridis, from dark violet to yellow, lightness rising throughout; t in [0, 1]. The colour map of
// S. van der Walt and N. Smith (CC0), by the polynomials of M. Zucker (CC0), which are within 1 %
// of it.
Colour sequential_colour(double t);

// From dark blue over white at 1/2 to dark red; t in [0, 1].
Colour diverging_colour(double t);

// What colours mean.
struct ColourScale {
    double low = 0;
    double high = 1;
    bool logarithmic = false;
    bool diverging = false;  // 0 in the middle: low == -high
    std::string title;       // "transmittance"

    // At t in [0, 1] of the scale.
    Colour colour_at(double t) const {
        return diverging ? diverging_colour(t) : sequential_colour(t);
    }
    ChartAxis axis() const;
};

// One pixel a texel of a field of one channel, whose row 0 is at the bottom; values beyond the
// scale have the colour of the nearer end, and what is not a number is grey.
Picture in_false_colours(const Image2<float>& field, const ColourScale& scale);

// The same channels, at a size whose longer edge is `smallest_edge` at least, by repeating texels,
// and `longest_edge` at most, by means of square blocks (of which the last of a row or column may
// be smaller). Needs smallest_edge <= longest_edge / 2, so that no field is too small and too
// large.
Image2<float> fitted(const Image2<float>& field, int smallest_edge, int longest_edge);

}  // namespace skybake
