// Assets as TIFF images of 32-bit floats, a page for each slice, which libtiff and most image programs
// read: the texels of all pages, the asset's description, and a directory for each page. Channels are
// interleaved, without compression; the first page carries what the file says of itself as its
// ImageDescription.
//
// Source: Adobe, "TIFF Revision 6.0" (1992). Files are smaller than 4 GiB.
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format tif_format();

}  // namespace skybake
