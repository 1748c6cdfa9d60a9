// Assets as KTX2 files: textures as GPUs hold them, with all levels of detail in one file, and with
// the description of the asset.
//
// A table is a 2-D texture, a volume a 3-D texture, and a table of the faces of a cube a cube texture:
// +x, -x, +y, -y, +z, -z, in a left-handed system whose y points up and whose z points ahead, each
// face with its upper row first. A volume of layers is an array of 2-D textures. Channels are R, RG or RGBA of unorm8, unorm16,
// half or float; three channels are stored as four, the fourth of which is 1; or blocks of BC4, BC5
// or BC6H, slice by slice. Levels are stored from
// the smallest to the largest, each either as it is or as a Zstandard frame of its own. The key
// skybake/asset holds the description, KTXorientation says that texel (0, 0, 0) has the smallest
// texture coordinates (`rd`, `rdi`), and KTXwriter names the release. The data format descriptor
// says that the numbers are linear and no colours of certain primaries, so that readers leave them
// as they are.
//
// Source: Khronos, "KTX File Format Specification", version 2.0, and "Khronos Data Format
// Specification", version 1.3. Version 1.4 wants the bytes of a texel in the descriptor of
// compressed files too; the files have them.
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format ktx2_format();

}  // namespace skybake
