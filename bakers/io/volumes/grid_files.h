// OpenVDB and NanoVDB files alike. Their first bytes tell them apart.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/io/formats/format.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/io/volumes/file_voxels.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Whether a file's name says that it is one of them.
bool has_grids(const std::filesystem::path& path);

// Reads what a file of any program says of itself. E0300, E0304.
Outcome<VdbFile> read_grids(const std::filesystem::path& path);

// Returns the names of what a grid holds: its own, or those of a vector's components.
std::vector<std::string> channels_of(const VdbGrid& grid);

// Opens a grid of numbers, or a component of vectors, for its numbers. E0300, E0304.
Outcome<FileVoxels> open_numbers(const std::filesystem::path& path, const std::string& grid);

// Like Format::inspect. NanoVDB files of float grids do not say whether their values were halves.
Outcome<FileFacts> inspect_grids(FileInput& file);

// Like Format::read, of grids of one size at the origin. NanoVDB files do not state it, so that a file of
// a smaller volume is told by its content alone. Memory use is that of the grids and eight slices.
Outcome<bool> read_grid_voxels(FileInput& file, const FileShape& shape, int level,
                               const VoxelVisitor& visit);

}  // namespace skybake
