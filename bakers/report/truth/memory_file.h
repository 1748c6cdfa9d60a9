// A file in memory that writers find under a path: what it takes to store something, without the
// disk's share in it and without anything left behind.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bakers/io/files/file_descriptor.h"

namespace skybake {

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
