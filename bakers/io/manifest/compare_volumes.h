// Compares the grids of OpenVDB and NanoVDB files, of any program, by value.
#pragma once

#include <filesystem>

#include "bakers/io/manifest/compare.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Compares two files, of the same format or not, grid after grid over the boxes of both, along the
// axes of the files' space. Numbers are as stored, whether active or not. `layout` says which grids hold
// no numbers, lie elsewhere or span more than 16384 voxels along an axis. E0300, E0304.
config::Outcome<ImageDifference> compare_volumes(const std::filesystem::path& first,
                                                 const std::filesystem::path& second);

}  // namespace skybake
