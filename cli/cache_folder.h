// Where the cache is: --cache-dir, else the environment's SKYBAKE_CACHE_DIR. It decides how fast a
// bake is, never what it makes.
#pragma once

#include <string>

#include "cli/command.h"

namespace skybake::cli {

Option cache_option();

// Empty: no cache.
std::string cache_folder(const Invocation& invocation);

}  // namespace skybake::cli
