// The interface of the module skybake_vdb, which encodes and decodes VDB files by OpenVDB. Linking
// OpenVDB would cost 35 ms at every start of the program, so the module is loaded on first use
// (vdb_file.cpp).
//
// The functions that encode only make bytes; the program writes them to files. These functions
// throw std::exception if the library does; the readers do not throw.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/io/formats/vdb/vdb_source.h"
#include "bakers/io/formats/vdb/vdb_tree.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/file_formats.h"

namespace skybake {

struct VdbEncoding {
    bool half = false;
    int components = 1;  // of a value; 3 of a vector
    config::VdbCompression compression = config::VdbCompression::none;
};

// The name under which a grid's metadata holds the size of a sparse volume.
inline constexpr const char* vdb_size_name = "skybake/size";

// The facts that a grid states.
struct VdbGridDescription {
    std::string name;
    VdbActiveVoxels active;  // with bounds even if no voxel is active
    // The size of the volume, stored as metadata named vdb_size_name; none if the bounds say it.
    std::optional<std::array<int, 3>> size;
    std::array<double, 3> voxel_size{};    // edges of a voxel
    std::array<double, 3> first_centre{};  // centre of voxel (0, 0, 0)
    VdbEncoding encoding;
    Attributes metadata;
};

// The part of a grid's record before its tree.
struct VdbGridHead {
    std::string bytes;
    std::size_t positions_at = 0;  // where grid_positions() go in `bytes`
    std::size_t grid_at = 0;       // where the grid's own data begins in `bytes`
};

// The active voxels of a strip (vdb_tree.h) as the file holds them. The file needs the leaves of a
// node in the order of x first, so the columns of the node's strips must be interleaved.
struct VdbStrip {
    std::string bytes;
    std::array<std::size_t, vdb_node_columns> column_ends{};  // ascending; the last: bytes.size()
};

// The module's functions.
struct VdbCodec {
    // Returns everything before the first grid. `uuid` has 36 characters.
    std::string (*file_head)(const std::string& uuid, const Attributes& attributes, int grids);

    VdbGridHead (*grid_head)(const VdbGridDescription& grid);

    // Encodes positions in the file: of the grid's own data, of its voxels, and after its end.
    std::string (*grid_positions)(std::uint64_t grid, std::uint64_t voxels, std::uint64_t end);

    // The tree of a grid begins with its root. Its 4096^3 nodes follow in the order of x, then y,
    // then z, and after each of them its 128^3 nodes with their leaves. A node has only children,
    // no tiles.
    std::string (*root)(std::size_t upper_nodes, VdbEncoding encoding);
    // The places of a node's children are counted like those of leaves, but with 32 along an axis.
    std::string (*upper_node)(const std::array<int, 3>& corner,
                              const std::vector<std::uint16_t>& places, VdbEncoding encoding);
    std::string (*lower_node)(const VdbLeaves& leaves, VdbEncoding encoding);

    // Encodes the active voxels of a strip. `values` are x fastest, then y, then z, then component. Any
    // thread may call it.
    void (*encode_strip)(const VoxelBox& strip, const float* values, const VdbLeaves& leaves,
                         VdbEncoding encoding, VdbStrip& encoded);

    // Implement read_vdb and open_vdb_grid for files that can be opened.
    config::Outcome<VdbFile> (*read)(const std::filesystem::path& path);
    config::Outcome<FileVoxels> (*open_grid)(const std::filesystem::path& path,
                                             const std::string& grid, VolumePart part,
                                             config::NotFinite not_finite);
};

// The name of the function that the module exports, which returns its VdbCodec.
inline constexpr const char* vdb_codec_symbol = "skybake_vdb_codec";

}  // namespace skybake
