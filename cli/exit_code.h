// What the process says to the shell. main.cpp is the only place that exits.
#pragma once

namespace skybake::cli {

enum class ExitCode : int {
    done = 0,
    differs = 1,   // a comparison or verification differs
    usage = 2,     // usage or parameter error
    io = 3,        // cannot open, read or write
    checks = 4,    // the result failed its physical or error checks
    internal = 5,  // a mistake of the program's own
    interrupted = 130,
};

}  // namespace skybake::cli
