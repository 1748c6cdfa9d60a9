#include "bakers/io/files/file_io.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <new>

#include "bakers/io/files/system_call.h"
#include "bakers/math/hash.h"

namespace skybake {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;

int open_emptied(const std::filesystem::path& path) {
    const bool is_own_file = path.parent_path() == "/proc/self/fd";
    return uninterrupted([&] {
        return ::open(path.c_str(),
                      O_WRONLY | O_TRUNC | O_CLOEXEC | (is_own_file ? 0 : O_NOFOLLOW));
    });
}

}  // namespace

Diagnostic cannot_read(const std::filesystem::path& path, const std::string& reason) {
    return file_error("E0300", path.string(),
                      fmt::format("cannot read `{}`: {}", path.string(), reason));
}

Diagnostic cannot_write(const std::filesystem::path& path, const std::string& reason) {
    return file_error("E0301", path.string(),
                      fmt::format("cannot write `{}`: {}", path.string(), reason));
}

Outcome<FileInput> FileInput::open(const std::filesystem::path& path) {
    // O_NONBLOCK: opening a pipe that nobody writes to would wait for ever.
    FileDescriptor file(
        uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); }));
    struct stat status {};
    if (!file.valid() || ::fstat(file.get(), &status) != 0) {
        return cannot_read(path, system_reason(errno));
    }
    if (S_ISDIR(status.st_mode)) return cannot_read(path, "it is a folder");
    if (!S_ISREG(status.st_mode)) return cannot_read(path, "it is not a regular file");
    return {FileInput(path, std::move(file), static_cast<std::uint64_t>(status.st_size)), {}};
}

std::optional<std::size_t> FileInput::read(std::uint64_t position, char* bytes, std::size_t count) {
    std::size_t done = 0;
    while (done < count) {
        const ssize_t got = uninterrupted([&] {
            return ::pread(file_.get(), bytes + done, count - done,
                           static_cast<off_t>(position + done));
        });
        if (got < 0) {
            error_ = errno;
            return std::nullopt;
        }
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

Diagnostic FileInput::diagnostic() const { return cannot_read(path_, system_reason(error_)); }

Outcome<FileFingerprint> fingerprint(const std::filesystem::path& path) {
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    std::string piece(std::size_t{1} << 20, '\0');
    FileFingerprint result;
    Hasher hasher;
    while (true) {
        const auto count = file.value->read(result.bytes, piece.data(), piece.size());
        if (!count) return file.value->diagnostic();
        if (*count == 0) break;
        hasher.update(std::string_view(piece).substr(0, *count));
        result.bytes += *count;
    }
    result.xxh3 = hasher.hex();
    return {std::move(result), {}};
}

FileOutput::FileOutput(const std::filesystem::path& path) : path_(path), file_(open_emptied(path)) {
    if (!file_.valid()) error_ = errno;
}

void FileOutput::write(std::string_view bytes) {
    if (buffer_.size() + bytes.size() < buffer_size) {
        buffer_.append(bytes);
        return;
    }
    finish();
    write_through(bytes);
}

void FileOutput::seek(std::uint64_t position) {
    finish();
    position_ = position;
}

bool FileOutput::finish() {
    write_through(buffer_);
    buffer_.clear();
    return error_ == 0;
}

Outcome<bool> FileOutput::finished(bool complete) {
    if (!finish()) return diagnostic();
    return {complete, {}};
}

void FileOutput::write_through(std::string_view bytes) {
    while (error_ == 0 && !bytes.empty()) {
        const ssize_t count = uninterrupted([&] {
            return ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(position_));
        });
        if (count <= 0) {
            error_ = count < 0 ? errno : EIO;
            return;
        }
        bytes.remove_prefix(static_cast<std::size_t>(count));
        position_ += static_cast<std::uint64_t>(count);
    }
}

Diagnostic FileOutput::diagnostic() const { return cannot_write(path_, system_reason(error_)); }

Outcome<std::string> read_file(const std::filesystem::path& path, std::uintmax_t limit) {
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const std::uint64_t size = file.value->size();
    if (size > limit) {
        return cannot_read(path,
                           fmt::format("it has {} bytes, but at most {} may be read", size, limit));
    }
    Outcome<std::string> outcome;
    try {
        outcome.value.emplace(static_cast<std::size_t>(size), '\0');
    } catch (const std::bad_alloc&) {
        return cannot_read(path, fmt::format("its {} bytes do not fit in memory", size));
    }
    const auto done = file.value->read(0, outcome.value->data(), outcome.value->size());
    if (!done) return file.value->diagnostic();
    outcome.value->resize(*done);
    return outcome;
}

}  // namespace skybake
