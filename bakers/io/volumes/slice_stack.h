// A volume as numbered pictures, one for each slice.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "bakers/io/volumes/file_voxels.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/volume.h"

namespace skybake {

// Reads a channel of pictures, the first one by default (image_codec.h). Slice i is at z = i, and row
// j of a picture at y = j. Pictures are decoded once, into a temporary file of floats that no other
// program sees, so memory holds a single slice.
//
// E0300 if a file cannot be read, E0301 if the temporary file cannot be written, E0304 if a picture
// is damaged, lacks the channel, has another size than the first one or a value that is not finite,
// unless such values are 0.
Outcome<FileVoxels> open_slice_stack(std::span<const std::filesystem::path> paths,
                                     const std::string& channel, VolumePart part,
                                     config::NotFinite not_finite);

}  // namespace skybake
