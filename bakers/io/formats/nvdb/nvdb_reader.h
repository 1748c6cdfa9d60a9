// Reads what NanoVDB files say of themselves.
#pragma once

#include <filesystem>

#include "bakers/io/formats/vdb/vdb_file.h"

namespace skybake {

// Reads what a file of any program says of itself; its library is "NanoVDB 32.6". E0300 if it cannot be
// read, E0304 if it is damaged or of another major version.
config::Outcome<VdbFile> read_nvdb_facts(const std::filesystem::path& path);

}  // namespace skybake
