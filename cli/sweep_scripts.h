// Scripts that hand a sweep to an engine that a farm has already. Tasks are shards of the sweep:
// idempotent, so that whoever runs one again, after a node has died, does no harm.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::cli {

struct SweepScript {
    std::vector<std::string> words;  // of the command without --shard and --merge
    std::string folder;              // of the sweep
    int variants = 0;
    int tasks = 0;
    int threads = 1;                            // of a task
    std::vector<std::filesystem::path> inputs;  // what the variants are made from
    std::vector<std::string> names;             // of all variants' folders; inputs and names are
                                                // for ninja_file alone
};

// A word that a POSIX shell reads back as it is.
std::string shell_word(std::string_view text);

// The command of one task, or of the merge that ends the sweep, for a shell.
std::string task_command(const SweepScript& script, std::string_view task);
std::string merge_command(const SweepScript& script);

// One task per line, without the merge: commands of a shell, quoted so that `sh`, GNU parallel and
// `xargs -d '\n' -I{} sh -c '{}'` run them from any folder.
std::string command_lines(const SweepScript& script);

// A shell script that submits an array job and, after it, the merge. Its arguments go to sbatch.
std::string slurm_script(const SweepScript& script);

// A build.ninja: a stamp in each variant's folder, and the index files. A task with variants that
// fail leaves their stamps as they are, so that it is run again, and lets the merge run, which
// fails in its place.
std::string ninja_file(const SweepScript& script);

}  // namespace skybake::cli
