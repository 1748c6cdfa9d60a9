// The seam between VDB files and OpenVDB: what the module on its far side does. Linking OpenVDB
// costs 35 ms at every start of the program, so it is loaded on first use (vdb_module.h).
//
// Everything here is bytes in, bytes out; files are written on the near side. Functions but the
// readers throw std::exception where the library does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/core/volume.h"
#include "bakers/io/exr.h"
#include "bakers/io/vdb_volume.h"
#include "config/diagnostic.h"
#include "config/parameters.h"

namespace skybake {

struct VdbEncoding {
    bool half = false;
    config::VdbCompression compression = config::VdbCompression::none;
};

// What a grid says of itself.
struct VdbGridDescription {
    std::string name;
    std::array<int, 3> size{};
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

// Voxels of a part of a 128^3 node as the file holds them. The file wants the leaves of a node in
// the order of x first: the leaves of every 8 voxels of x are a column, and the columns of the
// node's parts, which follow each other in y, are to be interleaved.
struct VdbStrip {
    std::string bytes;
    std::vector<std::size_t> column_ends;  // ascending; the last is bytes.size()
};

// The module's functions.
struct VdbCodec {
    // Everything before the first grid. `uuid` has 36 characters.
    std::string (*file_head)(const std::string& uuid, const Attributes& attributes, int grids);

    VdbGridHead (*grid_head)(const VdbGridDescription& grid);

    // Positions in the file: of the grid's own data, of its voxels, behind its end.
    std::string (*grid_positions)(std::uint64_t grid, std::uint64_t voxels, std::uint64_t end);

    // The tree of a volume whose voxels are all active, piece by piece, until `sink` returns false.
    void (*topology)(const std::array<int, 3>& size, VdbEncoding encoding,
                     const std::function<bool(std::string_view)>& sink);

    // The voxels of `strip`, which begins at a multiple of 8 along each axis and ends at one or at
    // the volume's end; its values x fastest, then y, then z. Any thread may call it.
    void (*encode_strip)(const VoxelBox& strip, const float* values, VdbEncoding encoding,
                         VdbStrip& encoded);

    // As read_vdb and read_vdb_voxels, of files that can be opened.
    config::Outcome<VdbFile> (*read)(const std::filesystem::path& path);
    config::Outcome<bool> (*read_voxels)(const std::filesystem::path& path,
                                         const std::function<bool(const VdbSlab& slab)>& visit);
};

// What the module exports, under this name.
using VdbCodecFunction = const VdbCodec* (*)();
inline constexpr const char* vdb_codec_symbol = "skybake_vdb_codec";

}  // namespace skybake
