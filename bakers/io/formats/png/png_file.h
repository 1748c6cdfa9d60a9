// Assets as PNG images of 8 or 16 bits per channel: grey, grey with alpha, RGB or RGBA.
//
// Samples are the stored numbers, unorm8 or unorm16, not colours. The file names no gamma and no
// colour space, so readers do not convert the samples. Alpha is unassociated, a number like the
// others. The slices of volumes are arranged in the image as sheet.h says.
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format png_format();

}  // namespace skybake
