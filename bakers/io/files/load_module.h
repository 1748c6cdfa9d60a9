// Loads modules: parts of the program that would slow down every start if they were linked to it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skybake {

// The modules hold OpenVDB, the libraries that read maps, those that draw charts, and libcurl.
inline constexpr const char* vdb_module_name = "skybake_vdb";
inline constexpr const char* image_module_name = "skybake_images";
inline constexpr const char* chart_module_name = "skybake_charts";
inline constexpr const char* http_module_name = "skybake_http";

// A symbol that a module exports, or null with the reason.
struct ModuleSymbol {
    void* address = nullptr;
    std::string reason;
};

// Loads `module`, one of the names above, and finds its exported `symbol`. The module stays loaded.
// Modules are looked for in lib/skybake of the folders above the program, where installed trees and
// builds have them.
ModuleSymbol load_module(const std::string& module, const char* symbol);

// A module's table of functions, or null with the reason.
template <class Codec>
struct LoadedCodec {
    const Codec* codec = nullptr;
    std::string reason;
};

// Loads a module whose symbol is a function that returns such a table.
template <class Codec>
LoadedCodec<Codec> load_codec(const std::string& module, const char* symbol) {
    const ModuleSymbol found = load_module(module, symbol);
    if (found.address == nullptr) return {nullptr, found.reason};
    return {reinterpret_cast<const Codec* (*)()>(found.address)(), ""};
}

// Returns the files that hold the code which makes assets: the program and its modules, except
// those for charts and for servers. Returns nothing if the system does not tell where the program is.
std::vector<std::filesystem::path> program_files();

}  // namespace skybake
