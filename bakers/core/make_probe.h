// Probes: places where a runtime can check its lookup of a stored table.
#pragma once

#include "bakers/core/baked_table.h"

namespace skybake {

// The lookup of a stored image at (u, v), with the room that a GPU's filtering in 1/256 texel steps
// and the pixel type's rounding need. The physical place, Probe::at, is the caller's to fill.
Probe make_probe(const Image2<float>& image, double u, double v, config::PixelType type);

}  // namespace skybake
