// Shows scalar fields in colours. Both colour maps change evenly for the eye, and their order is
// visible to readers who cannot distinguish red and green.
#pragma once

#include <string>

#include "bakers/field/image.h"
#include "bakers/plot/axis.h"
#include "bakers/plot/drawing.h"

namespace skybake {

// Returns a colour of viridis, from dark violet to yellow with lightness rising throughout, for t
// in [0, 1]. The colour map is by S. van der Walt and N. Smith (CC0), its polynomials are by M.
// Zucker (CC0) and within 1 % of it.
Colour sequential_colour(double t);

// Returns a colour from dark blue over white at 1/2 to dark red, for t in [0, 1].
Colour diverging_colour(double t);

// Returns a colour of a cloud against the sky, for t in [0, 1]: a deep blue at 0, over the greys of
// thin and of dense cloud to white. Its lightness rises throughout.
Colour cloud_colour(double t);

// The meaning of colours.
struct ColourScale {
    double low = 0;
    double high = 1;
    bool logarithmic = false;
    bool diverging = false;  // 0 in the middle: low == -high
    std::string title;       // "transmittance"
    bool clouds = false;     // densities and depths of clouds, in the colours of clouds

    // Returns the colour at t in [0, 1] of the scale.
    Colour colour_at(double t) const {
        if (diverging) return diverging_colour(t);
        return clouds ? cloud_colour(t) : sequential_colour(t);
    }
    ChartAxis axis() const;
};

// Draws a field of one channel, whose row 0 is at the bottom, with one pixel per texel. Values
// beyond the scale have the colour of the nearer end, and NaN is grey.
Picture in_false_colours(const Image2<float>& field, const ColourScale& scale);

// Resizes a field with all its channels so that its longer edge has at least `smallest_edge`
// texels, by repeating texels, and at most `longest_edge`, by averaging square blocks (the last of
// a row or column may be smaller). smallest_edge must be at most longest_edge / 2, so that no field
// is both too small and too large.
Image2<float> fitted(const Image2<float>& field, int smallest_edge, int longest_edge);

}  // namespace skybake
