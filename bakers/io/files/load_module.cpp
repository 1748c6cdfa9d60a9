#include "bakers/io/files/load_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <system_error>

#include "bakers/math/parallel.h"
#include "bakers/math/startable_threads.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// Returns the module's path, found from the program's path, or an empty path if there is none. For
// PREFIX/bin/skybake it is in PREFIX/lib/skybake. Programs of a build are one or two folders below
// the build's root.
fs::path find_module(const std::string& file_name) {
    constexpr int levels = 2;
    std::error_code error;
    fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (int level = 0; level < levels && !error; ++level) {
        folder = folder.parent_path();
        const fs::path candidate = folder / SKYBAKE_MODULE_FOLDER / file_name;
        std::error_code missing;
        if (fs::is_regular_file(candidate, missing)) return candidate;
    }
    return {};
}

std::string file_name_of(const std::string& module) { return module + ".so"; }

bool uses_openvdb(const std::string& module) {
    return module == vdb_module_name || module == image_module_name;
}

// Returns why a module cannot be loaded, or an empty text. OpenVDB brings log4cplus, which begins four
// threads as it is loaded, and waits for ever or ends the process if one cannot begin; Pango begins two
// whenever it meets another font, beside all that work then, OpenVDB's among them, and ends the process.
// One more is left to whoever tells how far the work is.
std::string want_of_threads(const std::string& module) {
    const bool draws = module == chart_module_name;
    if (!draws && !uses_openvdb(module)) return "";
    const int wanted = draws ? 8 + thread_count(0) : 5;
    const int startable = startable_threads(wanted);
    if (startable == wanted) return "";
    return fmt::format(
        "the system lets this process begin only {} of the {} threads that {} needs (ulimit -u, or "
        "pids.max of a container)",
        startable, wanted, draws ? "Pango" : "OpenVDB");
}

}  // namespace

std::vector<fs::path> program_files() {
    std::error_code error;
    std::vector<fs::path> files = {fs::read_symlink("/proc/self/exe", error)};
    if (error) return {};
    for (const char* module : {vdb_module_name, image_module_name}) {
        const fs::path path = find_module(file_name_of(module));
        if (!path.empty()) files.push_back(path);
    }
    return files;
}

ModuleSymbol load_module(const std::string& module, const char* symbol) {
    const std::string file_name = file_name_of(module);
    const fs::path path = find_module(file_name);
    if (path.empty()) {
        return {nullptr, fmt::format("the module `{}` is not in `{}` beside the program", file_name,
                                     SKYBAKE_MODULE_FOLDER)};
    }
    if (const std::string obstacle = want_of_threads(module); !obstacle.empty()) {
        return {nullptr, obstacle};
    }
    void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const address = library != nullptr ? ::dlsym(library, symbol) : nullptr;
    if (address == nullptr) {
        return {nullptr, fmt::format("a module cannot be loaded: {}", ::dlerror())};
    }
    // OpenVDB uses TBB, which asks for no more threads than are granted here.
    if (uses_openvdb(module)) {
        count_threads_again();
        static_cast<void>(thread_count(0));
    }
    return {address, ""};
}

}  // namespace skybake
