#include "bakers/io/files/file_input.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/math/hash.h"

namespace skybake {
namespace {

config::Diagnostic unreadable(const std::filesystem::path& path, const std::string& reason) {
    return file_error("E0300", path.string(),
                      fmt::format("cannot read `{}`: {}", path.string(), reason));
}

}  // namespace

config::Outcome<FileInput> FileInput::open(const std::filesystem::path& path) {
    // O_NONBLOCK: opening a pipe that nobody writes to would wait for ever.
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (!file.valid() || ::fstat(file.get(), &status) != 0) {
        return {{}, {unreadable(path, system_reason(errno))}};
    }
    if (S_ISDIR(status.st_mode)) return {{}, {unreadable(path, "it is a folder")}};
    if (!S_ISREG(status.st_mode)) return {{}, {unreadable(path, "it is not a regular file")}};
    return {FileInput(path, std::move(file), static_cast<std::uint64_t>(status.st_size)), {}};
}

std::optional<std::size_t> FileInput::read(std::uint64_t position, char* bytes, std::size_t count) {
    std::size_t done = 0;
    while (done < count) {
        const ssize_t got =
            ::pread(file_.get(), bytes + done, count - done, static_cast<off_t>(position + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            error_ = errno;
            return std::nullopt;
        }
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

config::Diagnostic FileInput::diagnostic() const {
    return unreadable(path_, system_reason(error_));
}

config::Outcome<FileFingerprint> fingerprint(const std::filesystem::path& path) {
    config::Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    std::string piece(std::size_t{1} << 20, '\0');
    FileFingerprint result;
    Hasher hasher;
    while (true) {
        const auto count = file.value->read(result.bytes, piece.data(), piece.size());
        if (!count) return {{}, {file.value->diagnostic()}};
        if (*count == 0) break;
        hasher.update(std::string_view(piece).substr(0, *count));
        result.bytes += *count;
    }
    result.xxh3 = hasher.hex();
    return {std::move(result), {}};
}

}  // namespace skybake
