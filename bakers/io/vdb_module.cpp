#include "bakers/io/vdb_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace skybake {
namespace {

namespace fs = std::filesystem;

// The module's place, from the program's: PREFIX/bin/skybake has it in PREFIX/lib/skybake, programs
// of a build are one or two folders below its root. Empty where there is none.
fs::path find_module() {
    constexpr int levels = 2;
    std::error_code error;
    fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (int level = 0; level < levels && !error; ++level) {
        folder = folder.parent_path();
        const fs::path candidate = folder / SKYBAKE_MODULE_FOLDER / SKYBAKE_VDB_MODULE;
        std::error_code missing;
        if (fs::is_regular_file(candidate, missing)) return candidate;
    }
    return {};
}

LoadedVdbCodec load() {
    const fs::path path = find_module();
    if (path.empty()) {
        return {nullptr, fmt::format("the module `{}` is not in `{}` beside the program",
                                     SKYBAKE_VDB_MODULE, SKYBAKE_MODULE_FOLDER)};
    }
    void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const symbol = library != nullptr ? ::dlsym(library, vdb_codec_symbol) : nullptr;
    if (symbol == nullptr) {
        return {nullptr, fmt::format("a module cannot be loaded: {}", ::dlerror())};
    }
    return {reinterpret_cast<VdbCodecFunction>(symbol)(), ""};
}

}  // namespace

const LoadedVdbCodec& vdb_codec() {
    static const LoadedVdbCodec loaded = load();
    return loaded;
}

}  // namespace skybake
