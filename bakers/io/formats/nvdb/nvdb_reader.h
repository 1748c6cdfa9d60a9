// Reads NanoVDB files that skybake wrote (nvdb_file.h).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/io/formats/format.h"

namespace skybake {

// The facts that a grid of any program states.
struct NvdbGridFacts {
    std::string name;
    std::string type;                     // "float", "vec3f", "points"
    std::string grid_class;               // "fog volume"
    std::string codec;                    // "none", "zip", "blosc"
    std::array<std::int64_t, 3> first{};  // bounds of the active voxels, inclusive
    std::array<std::int64_t, 3> last{};
    std::int64_t active_voxels = 0;
    std::array<double, 3> voxel_size{};
};
struct NvdbFacts {
    std::string version;  // "NanoVDB 32.6"
    std::vector<NvdbGridFacts> grids;
};
// E0300 if the file cannot be read, E0304 if it is damaged or of another major version.
config::Outcome<NvdbFacts> read_nvdb_facts(const std::filesystem::path& path);

// Like Format::inspect. Files of float grids do not say whether their values were halves.
config::Outcome<FileFacts> inspect_nvdb(const std::filesystem::path& path);

// Like Format::read. Voxels without a leaf or tile are 0. The grid does not state the size of the
// volume, so that a file of a smaller one is told by its content alone. Memory use is eight slices of
// the volume and 24 bytes per leaf.
config::Outcome<bool> read_nvdb(const std::filesystem::path& path, const FileShape& shape,
                                const VoxelVisitor& visit);

}  // namespace skybake
