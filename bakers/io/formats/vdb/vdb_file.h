// Volumes as OpenVDB files, written and read in bounded memory, because a volume may be larger than
// memory. Only vdb_*.cpp know OpenVDB.
//
// A file has one grid per channel, named by volume.grid_names. Without names, the grid of a volume
// with one channel is `density`, and those of several channels are `R`, `G`, `B`, `A`. Grids are
// FloatGrids of class fog volume with background 0; those of vectors are Vec3SGrids. Values are half or
// float; halves are rounded to nearest even. Voxel i is centred on minimum_m + (i + 1/2) h in metres, without
// rotation. For level 0, h is volume.voxel_size_m; for other levels, it is larger in proportion, as they have
// fewer voxels along an axis.
//
// In a dense volume, *every* voxel is active, including those of value 0. The active voxels are the
// whole volume, voxels (0, 0, 0) to size - 1.
//
// In a sparse volume, the active voxels of a grid are those that are not stored as 0 or -0. Leaves
// and nodes exist only where a voxel is active, and there are no active tiles. The metadata entry
// `skybake/size` of each grid (vec3i) is the size of the volume. A grid without active voxels says
// that 0 voxels are active and that its bounds (file_bbox_min, file_bbox_max) are those of the
// volume; OpenVDB would write bounds of INT_MAX.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/formats/format.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// Returns the names of the grids in a volume's files, one per channel. In VDB files, the channels `v.x`, `v.y`
// and `v.z` are the components of a grid of vectors `v`, which is read under their names.
std::vector<std::string> vdb_grid_names(const Baked& volume);

// A grid of a file, of numbers or of vectors.
struct VdbGridChannels {
    std::string name;
    std::size_t first = 0;  // channel of the volume
    int count = 1;          // of channels
};
std::vector<VdbGridChannels> vdb_grids(const Baked& volume);

// The most memory for encoded voxels of a sparse volume: enough for a 1024^3 cloud in half of which
// an eighth is active.
inline constexpr std::size_t vdb_most_kept_bytes = 256 << 20;

// Writes volume.levels[level] over an existing file; `attributes` become text metadata of the file.
// The bytes depend only on the volume and the attributes, not on threads, runs or time (the file's
// UUID is made from the level's content hash). Returns true when the file is complete, false once
// progress->cancelled(). In that case, and after an error, the file is incomplete.
//
// The voxels of a dense volume are made once. The voxels of a sparse volume are encoded in memory,
// up to `most_kept_bytes`; voxels beyond that limit are made twice. Voxels for which
// volume.levels[level].voxels->is_empty are not made. Memory use is those bytes, 66 bytes per leaf
// and channel, and a few strips of 2 MiB per thread.
//
// E0301: the file cannot be written; the message has the system's reason.
// E0500: VDB files cannot have the level, pixel type, hash or shape (a bug in the program).
config::Outcome<bool> write_vdb(const Baked& volume, int level, const Attributes& attributes,
                                int threads, Progress* progress, const std::filesystem::path& path,
                                std::size_t most_kept_bytes = vdb_most_kept_bytes);

struct VdbGrid {
    std::string name;                    // "density", "R", ...
    std::string type;                    // "Tree_float_5_4_3"
    std::string value_type;              // "float", "half", "int32", "vec3s", "points", "mask"
    std::string grid_class;              // "fog volume"
    std::string compression;             // "blosc + active values"
    std::array<double, 3> voxel_size{};  // in the file's units: metres in ours
    std::optional<std::array<double, 3>> first_centre = {};  // of voxel (0, 0, 0), if it says so
    // The bounds of the active voxels, inclusive, as the file says; all 0 if it does not say.
    std::array<std::int64_t, 3> first_active{};
    std::array<std::int64_t, 3> last_active{};
    std::int64_t active_voxels = 0;
    bool half = false;
    bool states_active = false;  // it has the bounds of its active voxels
    bool empty = false;          // it says that no voxel is active
    Attributes metadata;         // all metadata of the grid, as text, by name
};

struct VdbFile {
    std::string uuid;
    std::string library;         // "10.0/224": versions of the library and the format that wrote it
    std::vector<VdbGrid> grids;  // as in the file
    Attributes attributes;       // the file's text metadata, by name
};

// Reads what a file says of itself, without its voxels. E0300 if it cannot be read, E0304 if it is
// damaged or not a VDB file.
config::Outcome<VdbFile> read_vdb(const std::filesystem::path& path);

}  // namespace skybake
