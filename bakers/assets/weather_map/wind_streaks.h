// Noise that the wind has drawn out: each place has the noise of the way behind it, ever less the
// farther away. Falling ice leaves such streaks below cirrus while it evaporates.
//
//   streaked(x) = integral_0^8 exp(-s) noise(x - s L d) ds / integral_0^8 exp(-s) ds
//
// L is the streaks' length in tiles, d the unit vector of the wind in texture space.
#pragma once

#include <array>
#include <functional>

#include "bakers/field/image.h"
#include "bakers/math/bake_options.h"

namespace skybake {

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
