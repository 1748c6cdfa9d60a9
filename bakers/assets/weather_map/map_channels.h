// The ramp that turns a channel of noise into how much there is of something, so that exact shares
// of its texels are above 0 and are 1.
//
// Among N texels in falling order n_1 >= n_2 ... the first K = round(covered N) are above 0 and the
// first J = round(full N) are 1. The ramp goes from low, in the middle between n_K and n_(K+1), to
// high, in the middle between n_J and n_(J+1); if K is N, from n_N, and if J is 0, to n_1:
//
//   t = (n - low) / (high - low), within [0, 1];  or t t (3 - 2 t) of that (CoverEdge::smooth)
//   value = 0 where n < low and K < N,  1 where n >= high and J > 0,  else (1 + 253 t) / 255
//   (and (1 + 254 t) / 255 if J is 0)
//
// So values between 0 and 1 round to neither of them, and every pixel type keeps both shares. Of
// equal texels at a threshold, the first ones count as the greater ones; they differ from the others
// by one code of unorm8. Where more than kMostTied of all texels are equal, that would draw a line
// through the map, and the share cannot be reached.
//
// Noise that the wind has drawn out: each place has the noise of the way behind it, ever less the
// farther away. Falling ice leaves such streaks below cirrus while it evaporates.
//
//   streaked(x) = integral_0^8 exp(-s) noise(x - s L d) ds / integral_0^8 exp(-s) ds
//
// L is the streaks' length in tiles, d the unit vector of the wind in texture space.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/math/bake_options.h"
#include "config/assets/weather_map.h"

namespace skybake {

struct CoverRamp {
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();

    double low = 0;  // of the ramp
    double high = 1;
    double none_below = kInfinity;  // nothing is covered below this noise
    double full_from = kInfinity;   // the value is 1 from this noise on
    config::CoverEdge edge = config::CoverEdge::linear;

    // Returns 0, or a value from 1/255 to 1.
    double operator()(double noise) const;
};

// The share of the texels that may be divided by their order: as many as have one code of unorm8 in
// a channel of evenly distributed values.
inline constexpr double kMostTied = 1.0 / 255;

// A value that so many texels have that no threshold reaches the wanted share.
struct TiedTexels {
    double value = 0;
    double share_above = 0;    // of the texels, with greater values
    double share_with_it = 0;  // of the texels, with this value or greater ones
};

struct FittedRamp {
    CoverRamp ramp;
    std::size_t left_bare = 0;  // of the texels that equal none_below, the last ones, which are 0
    std::size_t left_thin =
        0;  // of the texels that equal full_from, the last ones, which are not 1
    std::optional<TiedTexels> tied = {};  // then the ramp is not to be used
};

// `noise` has the channel's texels, at least one; `full` is at most `covered`.
FittedRamp fit_cover_ramp(std::vector<float> noise, double covered, double full,
                          config::CoverEdge edge);

// Replaces the noise that the ramp was fitted to by its values.
void apply(const FittedRamp& fitted, std::vector<float>& noise);

struct Streaks {
    double length = 0;  // in tiles; 0 leaves the noise as it is
    std::array<double, 2> direction{1, 0};
};

// The direction of an angle in radians from +x towards +y.
std::array<double, 2> wind_direction(double angle);

// Returns the streaked texels of a tile that repeats. The integral is a sum over steps of half a
// texel or less, 512 or more, between texels by cubic convolution. Incomplete after an interruption.
Image2<float> streaked(const Image2<float>& noise, const Streaks& streaks,
                       const BakeOptions& options);

// Returns the integral at one place of a noise that is known everywhere, by Simpson's rule.
double streaked_reference(const std::function<double(double x, double y)>& noise,
                          const Streaks& streaks, double x, double y);

}  // namespace skybake
