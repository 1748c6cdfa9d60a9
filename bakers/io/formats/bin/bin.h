// Assets as files of bare texels: little-endian, without a header, x fastest, then y, then z,
// channels interleaved. The manifest says what they mean. Values are float, half, unorm8 (v * 255)
// or unorm16 (v * 65535), rounded to nearest.
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format bin_format();

}  // namespace skybake
