// The names of the files that a bake makes, relative to the output folder. They follow from the
// recipe alone.
#pragma once

#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/sections/parameters.h"

namespace skybake {

// "NAME.exr", "NAME.vdb"; "NAME.mip1.exr" and so on for further levels of detail.
std::string file_name(const std::string& name, config::FileFormat format, int level);

// "NAME.json": a text beside the files of an asset.
std::string companion_file_name(const std::string& name, const std::string& format);

// All files of a [bake.NAME].
std::vector<std::string> file_names(const config::Bake& bake);

}  // namespace skybake
