// Volumes as OpenVDB files, written and read in bounded memory: a volume may be larger than memory.
// Only vdb_*.cpp know OpenVDB.
//
// A file has one grid per channel, of one shape: `density` where the volume has one channel, else
// `R`, `G`, `B`, `A`. Grids are FloatGrids of class fog volume with background 0. *Every* voxel of
// the volume is active, those of value 0 too: the active voxels are the volume, voxels (0, 0, 0) to
// size - 1. Values are half or float; halves are rounded to nearest even. Voxel i is centred on
// minimum_m + (i + 1/2) h in metres, without rotation; h are volume.voxel_size_m,
// and so much more in a level as it has fewer voxels along that axis.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bakers/core/progress.h"
#include "bakers/core/volume.h"
#include "bakers/io/exr.h"
#include "config/diagnostic.h"

namespace skybake {

// Whether write_vdb can do its work here: E0301 where OpenVDB's module is missing or cannot be
// loaded. Ask before a long bake.
std::optional<config::Diagnostic> vdb_obstacle(const std::filesystem::path& path);

// Writes volume.levels[level] over an existing file; `attributes` become text metadata of the file.
// The bytes depend on the volume and the attributes only: not on threads, runs or time (the file's
// UUID is made of the level's content hash). True when the file is complete, false once
// progress->cancelled(); the file is then incomplete, as it is after an error.
// E0301: it cannot be written; the message has the system's reason.
// E0401: a voxel is NaN or infinite. E0402: a voxel rounds to an infinite half.
// E0500: a level, pixel type, hash or shape that VDB files do not have (a mistake of the program).
config::Outcome<bool> write_vdb(const BakedVolume& volume, int level, const Attributes& attributes,
                                int threads, Progress* progress, const std::filesystem::path& path);

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
// at most 8 planes. Memory is a slab and 8 bytes per leaf. The channels are in the order R,
// G, B, A. Ends early, with false, once visit returns false. E0300: it cannot be read. E0304: it is
// damaged, or is not such a file (grids of another type, different extents, a bounding box that
// does not begin at the origin, inactive voxels, tiles).
config::Outcome<bool> read_vdb_voxels(const std::filesystem::path& path,
                                      const std::function<bool(const VdbSlab& slab)>& visit);

}  // namespace skybake
