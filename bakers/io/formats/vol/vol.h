// Volumes as grids of Mitsuba's plug-in `gridvolume`: a head of 48 bytes, then floats, x fastest, then
// y, then z, channels interleaved. Halves are stored as floats, which hold them exactly.
//
// The bounds in the head are those of the volume in metres, from the outer face of the first voxel
// to that of the last along each axis; of noise, which lies nowhere, from 0 to 1. The plug-in reads
// them with `use_grid_bbox`. It takes one, three or six channels, or with `raw` any number. The
// format has no place for metadata; the manifest says what the file means.
//
// Source: Mitsuba 3, "Grid-based volume data source (gridvolume)".
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format vol_format();

}  // namespace skybake
