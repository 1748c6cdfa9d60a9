// Volumes as OpenVDB files, written and read in bounded memory: a volume may be larger than memory.
// Only vdb_*.cpp know OpenVDB.
//
// A file has one grid per channel, named by volume.grid_names; else `density` where the volume has
// one channel, and `R`, `G`, `B`, `A` where it has several. Grids are FloatGrids of class fog
// volume with background 0. Values are half or float; halves are rounded to nearest even. Voxel i
// is centred on minimum_m + (i + 1/2) h in metres, without rotation; h are volume.voxel_size_m, and
// so much more in a level as it has fewer voxels along that axis.
//
// Dense volumes: *every* voxel of the volume is active, those of value 0 too. The active voxels are
// the volume, voxels (0, 0, 0) to size - 1.
//
// Sparse volumes: those voxels of a grid are active that are stored as something else than 0 (or
// -0); there are leaves and nodes just where any voxel is active, and no active tiles. The
// metadatum `skybake/size` of each grid (vec3i) is the size of the volume. A grid without active
// voxels says that its bounds (file_bbox_min, file_bbox_max) are the volume's and that 0 voxels are
// active; OpenVDB would write bounds of INT_MAX.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/formats/exr/attribute_pieces.h"
#include "bakers/io/formats/format.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// The names of the grids of a volume's files, one per channel.
std::vector<std::string> vdb_grid_names(const Baked& volume);

Format vdb_format();

// The memory for encoded voxels of a sparse volume: as much as a 1024^3 cloud of halves takes of
// which an eighth is active.
inline constexpr std::size_t vdb_most_kept_bytes = 256 << 20;

// Writes volume.levels[level] over an existing file; `attributes` become text metadata of the file.
// The bytes depend on the volume and the attributes only: not on threads, runs or time (the file's
// UUID is made of the level's content hash). True when the file is complete, false once
// progress->cancelled(); the file is then incomplete, as it is after an error.
//
// The voxels of a dense volume are made once. Those of a sparse volume are made once, as long as
// the encoded file is no longer than `most_kept_bytes`, which it is kept in memory in; what is
// beyond is made twice. Where volume.levels[level].voxels->is_empty, they are not made. Memory is
// those bytes, 66 bytes per leaf and channel, and a few strips of 2 MiB per thread.
// E0301: it cannot be written; the message has the system's reason.
// E0401: a voxel is NaN or infinite. E0402: a voxel rounds to an infinite half.
// E0500: a level, pixel type, hash or shape that VDB files do not have (a mistake of the program).
config::Outcome<bool> write_vdb(const Baked& volume, int level, const Attributes& attributes,
                                int threads, Progress* progress, const std::filesystem::path& path,
                                std::size_t most_kept_bytes = vdb_most_kept_bytes);

struct VdbGrid {
    std::string name;                      // "density", "R", ...
    std::string type;                      // "Tree_float_5_4_3"
    std::string grid_class;                // "fog volume"
    std::string compression;               // "blosc + active values"
    std::array<double, 3> voxel_size{};    // in the file's units: metres in ours
    std::array<double, 3> first_centre{};  // where the centre of voxel (0, 0, 0) is
    // Of the active voxels, inclusive, as the file says; all 0 where it does not say.
    std::array<std::int64_t, 3> first_active{};
    std::array<std::int64_t, 3> last_active{};
    std::int64_t active_voxels = 0;
    // Of the volume: what the grid says, else how far its active voxels go from (0, 0, 0) on.
    std::array<std::int64_t, 3> size{};
    bool half = false;
    Attributes metadata;  // everything that the grid says of itself, as text, by name
};

struct VdbFile {
    std::string uuid;
    std::string library;         // "10.0/224": library and format that wrote it
    std::vector<VdbGrid> grids;  // as in the file
    Attributes attributes;       // the file's text metadata, by name
};

// What a file says of itself, without its voxels. E0300: it cannot be read. E0304: it is damaged or
// not VDB.
config::Outcome<VdbFile> read_vdb(const std::filesystem::path& path);

// Planes z = first_z ... first_z + depth - 1 of all grids.
struct VdbSlab {
    std::array<int, 3> size{};  // of the volume
    int first_z = 0;
    int depth = 0;
    std::vector<float> voxels;  // channels interleaved, x fastest, then y, then z
};

// Hands the voxels of a file as write_vdb makes them to `visit`, slab after slab from z = 0 on, of
// at most 8 planes; inactive voxels are 0. Memory is a slab and 16 bytes per leaf. The channels are
// in the order of the file's grids. Ends early, with false, once visit returns false. E0300: it
// cannot be read. E0304: it is damaged, or is not such a file (grids of another type, of different
// sizes, with tiles or with inactive voxels that are not 0; more than 16384 voxels along an axis;
// where grids do not say their size, bounds that do not begin at the origin).
config::Outcome<bool> read_vdb_voxels(const std::filesystem::path& path,
                                      const std::function<bool(const VdbSlab& slab)>& visit);

}  // namespace skybake
