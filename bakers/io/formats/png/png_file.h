// Assets as PNG images of 8 or 16 bits a channel: gray, gray with alpha, RGB or RGBA.
//
// Samples are the stored numbers, unorm8 or unorm16, and no colours: the file names no gamma and no
// colour space, so that readers hand them on as they are. Alpha is unassociated, a number like the
// others. Volumes lie in the image slice by slice.
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format png_format();

}  // namespace skybake
