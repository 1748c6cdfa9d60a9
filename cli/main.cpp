// This file starts the program, and is the only place that ends the process.
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "bakers/math/memory.h"
#include "cli/command.h"
#include "cli/console.h"

namespace {

// Opens those of the standard descriptors that are closed. A process that starts with a closed
// stdout would get the number of stdout for the first file that it opens, and print into that file.
// The descriptors are opened for reading only, so that writing to them fails as it should.
void occupy_standard_descriptors() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) == -1) ::open("/dev/null", O_RDONLY);
    }
}

}  // namespace

int main(int argc, char** argv) {
    using namespace skybake::cli;
    occupy_standard_descriptors();
    install_signal_handlers();
    install_end_of_process();
    skybake::keep_freed_memory();
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    const ColorEnvironment colors = {std::getenv("NO_COLOR"), std::getenv("CLICOLOR_FORCE"),
                                     std::getenv("FORCE_COLOR")};
    return static_cast<int>(
        run(words, descriptor_sink(STDOUT_FILENO), descriptor_sink(STDERR_FILENO), colors));
}
