// Fields at the size at which they are looked at.
#pragma once

#include "bakers/field/image.h"

namespace skybake {

// The same channels, at a size whose longer edge is `smallest_edge` at least, by repeating texels,
// and `longest_edge` at most, by means of square blocks (of which the last of a row or column may
// be smaller). Needs smallest_edge <= longest_edge / 2, so that no field is too small and too
// large.
Image2<float> fitted(const Image2<float>& field, int smallest_edge, int longest_edge);

}  // namespace skybake
