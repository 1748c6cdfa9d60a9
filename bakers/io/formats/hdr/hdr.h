// Skies as Radiance pictures (.hdr) of RGBE (bakers/field/rgbe.h), rows from the top. OpenImageIO writes and
// reads them.
//
// The asset's entry in the manifest stands behind the last row, where readers look for nothing: 100 lines
// of 127 bytes are the most that OpenImageIO 2.4 takes for a header. The last line has the entry's length.
//
// Source: Ward, "Radiance File Formats".
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

// A picture of any program, held in memory, and the asset's entry behind it, or "".
struct HdrPicture {
    RowSource rows;  // R, G and B
    std::string entry;
};
config::Outcome<HdrPicture> read_hdr_picture(const std::filesystem::path& path);

}  // namespace skybake
