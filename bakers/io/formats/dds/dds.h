// Assets as DDS files: textures as GPUs hold them, with all levels of detail in one file.
//
// The header is that of DX10, but for 2-D textures and cubes of half and float, whose old formats readers
// without DX10 know too. A table is a 2-D texture, a volume a 3-D texture, and a table of the
// faces of a cube a cube texture: +x, -x, +y, -y, +z, -z, in a left-handed system whose y points up
// and whose z points ahead, each face with its upper row first and followed by its levels. A volume of layers is an array of 2-D
// textures, each followed by its levels. Channels
// are R, RG or RGBA of unorm8, unorm16, half or float; three channels are stored as four, the
// fourth of which is 1; or blocks of BC4, BC5 or BC6H, slice by slice. Texels of other textures are
// stored level after level, x fastest, then y, then z. Alpha is a number like the others, and the
// header says so (DDS_ALPHA_MODE_CUSTOM). The format has no place for metadata; the manifest says
// what the file means.
//
// Source: Microsoft, "DDS_HEADER structure", "D3DFORMAT" and "DDS_HEADER_DXT10 structure".
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format dds_format();

}  // namespace skybake
