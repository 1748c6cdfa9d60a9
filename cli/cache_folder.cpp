#include "cli/cache_folder.h"

#include <cstdlib>

namespace skybake::cli {

Option cache_option() {
    return {.name = "cache-dir",
            .value = "FOLDER",
            .help = "share baked assets through this folder (default: $SKYBAKE_CACHE_DIR)"};
}

std::string cache_folder(const Invocation& invocation) {
    if (invocation.has("cache-dir")) return invocation.value("cache-dir");
    const char* const folder = std::getenv("SKYBAKE_CACHE_DIR");
    return folder ? folder : "";
}

}  // namespace skybake::cli
