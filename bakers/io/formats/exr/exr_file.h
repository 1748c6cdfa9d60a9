// Assets as EXR images, written and read in bounded memory. Pixel types float and half; an image
// has at most 2^31 - 1 rows or columns.
#pragma once

#include "bakers/io/formats/exr/exr_rows.h"
#include "bakers/io/formats/format.h"

namespace skybake {

Format exr_format();

// The file must stay where it is.
RowSource rows_of(ExrRows& file);

}  // namespace skybake
