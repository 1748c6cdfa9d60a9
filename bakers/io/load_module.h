// Loads parts of the program that would cost too much at every start if they were linked to it.
#pragma once

#include <string>

namespace skybake {

// What a module exports, or null with the reason.
struct ModuleSymbol {
    void* address = nullptr;
    std::string reason;
};

// Loads `module` ("skybake_vdb"), which stays, and finds what it exports as `symbol`. Modules are
// looked for in lib/skybake of the folders above the program, which is where installed trees and
// builds have them.
ModuleSymbol load_module(const std::string& module, const char* symbol);

}  // namespace skybake
