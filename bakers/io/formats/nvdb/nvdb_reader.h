// Reads NanoVDB files that skybake wrote (nvdb_file.h).
#pragma once

#include <filesystem>

#include "bakers/io/formats/format.h"

namespace skybake {

// As Format::inspect. Files of float grids do not say whether their values were halves.
config::Outcome<FileFacts> inspect_nvdb(const std::filesystem::path& path);

// As Format::read. Voxels without a leaf or tile are 0. The grid does not state the size of the
// volume, so that a file of a smaller one is told by its content alone. Memory use is eight slices of
// the volume and 24 bytes per leaf.
config::Outcome<bool> read_nvdb(const std::filesystem::path& path, const FileShape& shape,
                                const VoxelVisitor& visit);

}  // namespace skybake
