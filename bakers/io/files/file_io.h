// Reading and writing files through descriptors, and what went wrong with one.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Owns a POSIX file descriptor.
class FileDescriptor {
  public:
    FileDescriptor() = default;
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    FileDescriptor(FileDescriptor&& other) noexcept : descriptor_(other.release()) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~FileDescriptor() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    int get() const { return descriptor_; }
    bool valid() const { return descriptor_ >= 0; }
    int release() { return std::exchange(descriptor_, -1); }

  private:
    int descriptor_ = -1;
};

// Diagnostics about files.
inline config::Diagnostic file_error(std::string code, const std::string& file,
                                     std::string message) {
    config::Diagnostic diagnostic;
    diagnostic.code = std::move(code);
    diagnostic.message = std::move(message);
    diagnostic.where.source = file;
    return diagnostic;
}

// The system's words for an errno: "No space left on device".
inline std::string system_reason(int error) { return std::generic_category().message(error); }

// A file that is read in pieces, at any place: for files that may be larger than memory.
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

// A file that is being written from its beginning on, in large pieces, with the system's own reason
// where that fails.

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

// Whole files into memory, with one clear diagnostic where that does not work.

// E0300: missing, a folder, a device or pipe, not permitted, larger than `limit` bytes, or an error
// while reading; the message says which.
config::Outcome<std::string> read_file(const std::filesystem::path& path,
                                       std::uintmax_t limit = std::uintmax_t{4} << 30);

}  // namespace skybake
