// Compares the light of an asset with paths of light. The result is the certificate's error.sky.
//
// With the same number of paths everywhere, twilight would be very noisy: places have paths in
// proportion to their relative spread. Then the places with the largest errors are traced again
// with more paths, until the place with the largest error is one of these: noise makes errors
// larger, and the largest most of all.
#pragma once

#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/conventions.h"
#include "bakers/math/bake_options.h"

namespace skybake {

struct Baked;

// Returns |found / traced - 1| over all places and channels; of colours, whose channels may be 0 or
// below, the difference over the brightest channel. Channels where no path finds light do not count,
// and those whose standard error is above 5 % are left out. After an interruption the result must
// not be used.
SkyError measure_sky(const TracedLight& light, const Baked& baked, const BakeOptions& options);

}  // namespace skybake
