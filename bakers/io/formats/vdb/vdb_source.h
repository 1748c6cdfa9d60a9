// The grid of any program's VDB file as a source of voxels.
#pragma once

#include <filesystem>
#include <string>

#include "bakers/io/volumes/file_voxels.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/volume.h"

namespace skybake {

// Reads the grid of numbers of that name (file_voxels.h): float, double, int32 or int64, which become
// floats. Its voxels are those that its own metadata says (vdb_file.h) or, in files of other
// programs, the box of its active voxels and tiles, along the axes of the file's space
// (file_voxels.h). Values are those that OpenVDB's accessors return, whether active or not; a level
// set's distances become densities (grid_voxels.h), where w is minus the least tile, or the
// background if no tile is below 0. Before voxels are returned, every leaf has been decoded once.
// Memory use is 32 bytes per leaf, and what the file's inner nodes take.
//
// E0300 if the file cannot be read. E0304 if it is damaged, has no such grid, or the grid has
// another type, is a level set without a half width, is sheared or turned by other than right
// angles, has no active voxels, or a value that is not finite, unless these are the background; the
// message says which.
config::Outcome<FileVoxels> open_vdb_grid(const std::filesystem::path& path,
                                          const std::string& grid, VolumePart part,
                                          config::NotFinite not_finite = config::NotFinite::refuse);

}  // namespace skybake
