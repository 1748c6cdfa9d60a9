// Volumes as NanoVDB files, written and read in bounded memory.
//
// A file has one grid per channel, with the names of the VDB file's (vdb_file.h), in one segment
// without a codec. Grids are fog volumes with background 0. Float and half are stored as float, which
// holds both exactly. Voxel i is centred on minimum_m + (i + 1/2) h in metres, as in VDB files, and the
// same voxels are active.
//
// The version of the files is that of the library with which skybake is built, 32.4.2 on Debian 12,
// and their magic number is `NanoVDB0`, which pbrt-v4 and OpenVDB 8 to 11 read. NanoVDB of OpenVDB 12
// writes `NanoVDB1` and `NanoVDB2`, and reads these files too.
//
// Nodes are stored breadth-first, children in the order of their parent's table, with the bounds and
// the extremes of their active values, but without means and deviations. The checksum covers
// grid, tree, root and every node. Behind the leaves of the first grid is a blind datum named skybake/asset: the
// description of the asset, as text.
#pragma once

#include <filesystem>

#include "bakers/io/formats/format.h"
#include "bakers/io/formats/vdb/vdb_file.h"

namespace skybake {

// Reads what a file of any program says of itself; its library is "NanoVDB 32.6". E0300 if it cannot be
// read, E0304 if it is damaged or of another major version.
config::Outcome<VdbFile> read_nvdb_facts(const std::filesystem::path& path);

// Writes one level as Format::write does: leaves as they are made, and what points to them afterwards.
// The bytes depend only on the volume and its description. Memory use is 17 MB per thread, 600 bytes
// per node of 128^3 voxels, and a node of 260 KB.
config::Outcome<bool> write_nvdb(const FileContent& content, const std::filesystem::path& path);

}  // namespace skybake
