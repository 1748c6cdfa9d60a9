// Assets as arrays of NumPy, which `numpy.load` reads and maps into memory: a head that tells the
// type and the shape, then texels as in bin files (bin.h). The shape is (z, y, x, channels), of a
// table (y, x, channels). unorm8 and unorm16 are integers, to be divided by 255 or 65535.
//
// Source: NumPy, "numpy.lib.format", version 1.0 of the format.
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format npy_format();

}  // namespace skybake
