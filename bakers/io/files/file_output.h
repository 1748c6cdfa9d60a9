// A file that is being written from its beginning on, in large pieces, with the system's own reason
// where that fails.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "bakers/io/files/file_descriptor.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// After an error nothing more is written: `error` keeps the first.
class FileOutput {
  public:
    // Opens an existing file and empties it. A symbolic link is not followed (ELOOP), but for those
    // in /proc/self/fd, which stand for the process's own open files.
    explicit FileOutput(const std::filesystem::path& path);

    void write(std::string_view bytes);
    void seek(std::uint64_t position);
    std::uint64_t position() const { return position_ + buffer_.size(); }
    // Writes what is still in memory. True where all went well.
    bool finish();

    // errno of the first failure, or 0.
    int error() const { return error_; }
    // E0301 with the reason.
    config::Diagnostic diagnostic() const;

  private:
    void write_through(std::string_view bytes);

    std::filesystem::path path_;
    FileDescriptor file_;
    std::string buffer_;
    std::uint64_t position_ = 0;  // of the buffer's beginning
    int error_ = 0;
};

}  // namespace skybake
