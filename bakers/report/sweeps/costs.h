// What work costs: processor time of the calling thread, whatever else the machine does meanwhile,
// and bytes that are written to memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "bakers/io/files/file_descriptor.h"

namespace skybake {

// Of the calling thread.
double thread_cpu_seconds();

// The median time of each job in seconds. The jobs are run in turn, `repetitions` times round, so
// that a machine that slows down slows them all; `before_each(round, job)` returns false to stop,
// and then the result is empty. repetitions >= 1.
std::vector<double> interleaved_medians(
    const std::vector<std::function<void()>>& jobs, int repetitions,
    const std::function<bool(int round, std::size_t job)>& before_each);

// A file in memory that writers find under a path: what it takes to store something, without the
// disk's share in it and without anything left behind.
class MemoryFile {
  public:
    // Where the system gives none, whoever opens the path is told that it cannot be.
    MemoryFile();
    std::filesystem::path path() const;
    std::uint64_t bytes() const;

  private:
    FileDescriptor file_;
};

}  // namespace skybake
