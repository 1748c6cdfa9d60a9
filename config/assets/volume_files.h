// Which assets are volumes.
#pragma once

#include "config/sections/files.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// What the files of a volume are like; null of a bake that makes a table.
const VolumeFiles* volume_files(const Bake& bake);

}  // namespace skybake::config
