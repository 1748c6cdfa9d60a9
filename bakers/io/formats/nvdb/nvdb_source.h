// The grid of any program's NanoVDB file as a source of voxels.
#pragma once

#include <filesystem>
#include <string>

#include "bakers/io/volumes/file_voxels.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/volume.h"

namespace skybake {

// Reads the grid of that name, of type Float, Fp8 or Fp16. Its voxels are the box of its active voxels
// and tiles, along the axes of the file's space (file_voxels.h). Values are those that NanoVDB's accessors return, whether active or not; a level set's
// distances become densities (vdb_source.h). Before voxels are returned, every leaf has been decoded
// once. Memory use is 24 bytes for each leaf and tile.
//
// E0300 if the file cannot be read. E0304 if it is damaged, which its checksum tells, or compressed, was
// written by another major version (nvdb_file.h), has no such grid (file_voxels.h), or the grid has
// another type, is sheared or turned by other than right angles, has no active voxels, active voxels
// beyond its bounds or a value that is not finite, unless these are the background; the message says
// which.
config::Outcome<FileVoxels> open_nvdb_grid(
    const std::filesystem::path& path, const std::string& grid, VolumePart part,
    config::NotFinite not_finite = config::NotFinite::refuse);

}  // namespace skybake
