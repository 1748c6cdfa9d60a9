// A file that is read in pieces, at any place: for files that may be larger than memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bakers/io/files/file_descriptor.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

class FileInput {
  public:
    // E0300: missing, a folder, a device or pipe, or not permitted; the message says which.
    static config::Outcome<FileInput> open(const std::filesystem::path& path);

    std::uint64_t size() const { return size_; }
    // Reads up to `count` bytes at `position`; how many there were, fewer only at the file's end,
    // or nothing after an error: see diagnostic().
    std::optional<std::size_t> read(std::uint64_t position, char* bytes, std::size_t count);
    // E0300 with the reason of the failed read.
    config::Diagnostic diagnostic() const;

  private:
    FileInput(const std::filesystem::path& path, FileDescriptor file, std::uint64_t size)
        : path_(path), file_(std::move(file)), size_(size) {}

    std::filesystem::path path_;
    FileDescriptor file_;
    std::uint64_t size_ = 0;
    int error_ = 0;
};

struct FileFingerprint {
    std::uint64_t bytes = 0;
    std::string xxh3;  // xxh3_hex of the file
};

// Reads the whole file, piece by piece. E0300.
config::Outcome<FileFingerprint> fingerprint(const std::filesystem::path& path);

}  // namespace skybake
