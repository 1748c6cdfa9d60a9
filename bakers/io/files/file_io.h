// Reads and writes files through descriptors, whole or in pieces, and makes diagnostics about them.
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

// Makes a diagnostic about a file.
inline Diagnostic file_error(std::string code, const std::string& file, std::string message,
                             std::string label = {}) {
    const Severity severity = code.starts_with('W') ? Severity::warning : Severity::error;
    const config::SourceRange where{file, 0, 0, 0, ""};
    return {severity, std::move(code), std::move(message), where, std::move(label)};
}

// Returns the system's message for an errno: "No space left on device".
inline std::string system_reason(int error) { return std::generic_category().message(error); }

// Returns E0300 and E0301 with a reason: "cannot write `a.exr`: No space left on device".
Diagnostic cannot_read(const std::filesystem::path& path, const std::string& reason);
Diagnostic cannot_write(const std::filesystem::path& path, const std::string& reason);

// A file that is read in pieces, at any position, because it may be larger than memory.
class FileInput {
  public:
    // E0300 if the file is missing, a folder, a device or a pipe, or if reading is not permitted;
    // the message says which.
    static Outcome<FileInput> open(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t size() const { return size_; }
    // Reads up to `count` bytes at `position` and returns how many were read; fewer than `count`
    // only at the end of the file. After an error it returns nothing; see diagnostic().
    std::optional<std::size_t> read(std::uint64_t position, char* bytes, std::size_t count);
    // Returns E0300 with the reason of the failed read.
    Diagnostic diagnostic() const;

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

// Reads the whole file, piece by piece. E0300 if that fails.
Outcome<FileFingerprint> fingerprint(const std::filesystem::path& path);

// A file that is written from its beginning on, in large pieces. After an error nothing more is
// written; `error` keeps the system's reason of the first one.
class FileOutput {
  public:
    // Opens an existing file and empties it. A symbolic link is not followed (ELOOP), except those
    // in /proc/self/fd, which stand for the process's own open files.
    explicit FileOutput(const std::filesystem::path& path);

    void write(std::string_view bytes);
    void seek(std::uint64_t position);
    std::uint64_t position() const { return position_ + buffer_.size(); }
    // Writes what is still in memory. Returns true if everything was written.
    bool finish();
    // Finishes a file that is `complete` or cut short, and returns that.
    Outcome<bool> finished(bool complete);

    // Returns the errno of the first failure, or 0.
    int error() const { return error_; }
    // Returns E0301 with the reason.
    Diagnostic diagnostic() const;

  private:
    void write_through(std::string_view bytes);

    std::filesystem::path path_;
    FileDescriptor file_;
    std::string buffer_;
    std::uint64_t position_ = 0;  // position of the buffer's beginning
    int error_ = 0;
};

// Reads a whole file into memory. E0300 if the file is missing, a folder, a device or a pipe, if
// reading is not permitted or fails, or if the file is larger than `limit` bytes; the message says
// which.
Outcome<std::string> read_file(const std::filesystem::path& path,
                               std::uintmax_t limit = std::uintmax_t{4} << 30);

}  // namespace skybake
