// Loads parts of the program that would cost too much at every start if they were linked to it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skybake {

// OpenVDB, the libraries that read maps, and those that draw charts.
inline constexpr const char* vdb_module_name = "skybake_vdb";
inline constexpr const char* image_module_name = "skybake_images";
inline constexpr const char* chart_module_name = "skybake_charts";

// What a module exports, or null with the reason.
struct ModuleSymbol {
    void* address = nullptr;
    std::string reason;
};

// Loads `module`, one of the names above, which stays, and finds what it exports as `symbol`.
// Modules are looked for in lib/skybake of the folders above the program, which is where installed
// trees and builds have them.
ModuleSymbol load_module(const std::string& module, const char* symbol);

// The files of the program's code that makes assets: the program and the modules beside it, but for
// charts. Empty where the system does not tell where the program is.
std::vector<std::filesystem::path> program_files();

}  // namespace skybake
