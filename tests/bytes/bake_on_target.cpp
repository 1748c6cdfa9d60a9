// skybake with its vector kernels held to one instruction set: bake_on_target TARGET bake ...
// `--list` prints those that this machine has and kernels are compiled for; with any other one Highway
// would take the scalar kernels, which are among them.
#include <hwy/targets.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"

int main(int argc, char** argv) {
    const bool list = argc == 2 && std::strcmp(argv[1], "--list") == 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (list) {
            std::puts(hwy::TargetName(target));
        } else if (argc > 1 && std::strcmp(argv[1], hwy::TargetName(target)) == 0) {
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            const std::vector<std::string> words(argv + 2, argv + argc);
            return static_cast<int>(skybake::cli::run(words, skybake::cli::descriptor_sink(1),
                                                      skybake::cli::descriptor_sink(2), {}));
        }
    }
    return list ? 0 : 2;
}
