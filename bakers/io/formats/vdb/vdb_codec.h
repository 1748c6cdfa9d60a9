// The seam between VDB files and OpenVDB: what the module on its far side does. Linking OpenVDB
// costs 35 ms at every start of the program, so it is loaded on first use (vdb_file.cpp).
//
// Everything here is bytes in, bytes out; files are written on the near side. Functions but the
// readers throw std::exception where the library does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/formats/exr/attribute_pieces.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/io/formats/vdb/vdb_tree.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/files.h"

namespace skybake {

struct VdbEncoding {
    bool half = false;
    config::VdbCompression compression = config::VdbCompression::none;
};

// The name of the size of a sparse volume in a grid's metadata.
inline constexpr const char* vdb_size_name = "skybake/size";

// What a grid says of itself.
struct VdbGridDescription {
    std::string name;
    VdbActiveVoxels active;  // with bounds even where there are none
    // Of the volume, as metadata named vdb_size_name; none where the bounds say it.
    std::optional<std::array<int, 3>> size;
    std::array<double, 3> voxel_size{};    // edges
    std::array<double, 3> first_centre{};  // of voxel (0, 0, 0)
    VdbEncoding encoding;
    Attributes metadata;
};

// The record of a grid up to its tree.
struct VdbGridHead {
    std::string bytes;
    std::size_t positions_at = 0;  // where in `bytes` grid_positions() go
    std::size_t grid_at = 0;       // where in `bytes` the grid's own data begins
};

// Active voxels of a strip (vdb_tree.h) as the file holds them. The file wants the leaves of a node
// in the order of x first, so the columns of the node's strips are to be interleaved.
struct VdbStrip {
    std::string bytes;
    std::array<std::size_t, vdb_node_columns> column_ends{};  // ascending; the last: bytes.size()
};

// The module's functions.
struct VdbCodec {
    // Everything before the first grid. `uuid` has 36 characters.
    std::string (*file_head)(const std::string& uuid, const Attributes& attributes, int grids);

    VdbGridHead (*grid_head)(const VdbGridDescription& grid);

    // Positions in the file: of the grid's own data, of its voxels, behind its end.
    std::string (*grid_positions)(std::uint64_t grid, std::uint64_t voxels, std::uint64_t end);

    // The tree of a grid is its root; then its 4096^3 nodes in the order of x, then y, then z; and
    // behind each of them its 128^3 nodes with their leaves. A node has children and nothing else.
    std::string (*root)(std::size_t upper_nodes);
    // The places of a node's children are counted as those of leaves are, 32 along an axis.
    std::string (*upper_node)(const std::array<int, 3>& corner,
                              const std::vector<std::uint16_t>& places, VdbEncoding encoding);
    std::string (*lower_node)(const VdbLeaves& leaves, VdbEncoding encoding);

    // The active voxels of a strip; its values x fastest, then y, then z. Any thread may call it.
    void (*encode_strip)(const VoxelBox& strip, const float* values, const VdbLeaves& leaves,
                         VdbEncoding encoding, VdbStrip& encoded);

    // As read_vdb and read_vdb_voxels, of files that can be opened.
    config::Outcome<VdbFile> (*read)(const std::filesystem::path& path);
    config::Outcome<bool> (*read_voxels)(const std::filesystem::path& path,
                                         const std::function<bool(const VdbSlab& slab)>& visit);
};

// What the module exports, under this name.
using VdbCodecFunction = const VdbCodec* (*)();
inline constexpr const char* vdb_codec_symbol = "skybake_vdb_codec";

}  // namespace skybake
