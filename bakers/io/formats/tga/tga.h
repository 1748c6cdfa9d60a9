// Assets as Targa images of unorm8 without compression: grey, RGB or RGBA, which the file stores as
// BGR and BGRA. Rows stand from the top. Alpha is a number like the others and multiplies nothing,
// which the extension area of the format's version 2.0 says. The slices of volumes are arranged in
// the image as sheet.h says.
//
// The developer area has one entry, of the tag 32768, the first that programs may use: the
// description of the asset, as text.
//
// Source: Truevision, "TGA File Format Specification", version 2.0, 1991.
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format tga_format();

}  // namespace skybake
