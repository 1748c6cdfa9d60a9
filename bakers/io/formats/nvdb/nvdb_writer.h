// Writes NanoVDB files (nvdb_reader.h): leaves as they are made, and what points to them afterwards.
#pragma once

#include <filesystem>

#include "bakers/io/formats/format.h"

namespace skybake {

// Writes one level as Format::write does. The bytes depend only on the volume and its description.
// Memory use is 17 MB per thread, 600 bytes per node of 128^3 voxels, and a node of 260 KB.
config::Outcome<bool> write_nvdb(const FileContent& content, const std::filesystem::path& path);

}  // namespace skybake
