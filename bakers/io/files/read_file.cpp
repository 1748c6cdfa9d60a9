#include "bakers/io/files/read_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <new>

#include "bakers/io/files/file_descriptor.h"
#include "bakers/io/files/file_diagnostic.h"

namespace skybake {
namespace {

config::Outcome<std::string> read_failure(const std::filesystem::path& path,
                                        const std::string& reason) {
    return {{},
            {file_error("E0300", path.string(),
                        fmt::format("cannot read `{}`: {}", path.string(), reason))}};
}

// Fills `bytes` from the start; returns errno, or 0. A file that ends early shortens it.
int read_all(int descriptor, std::string& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::read(descriptor, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    bytes.resize(done);
    return 0;
}

}  // namespace

config::Outcome<std::string> read_file(const std::filesystem::path& path, std::uintmax_t limit) {
    // O_NONBLOCK: opening a pipe that nobody writes to would wait for ever.
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file.valid()) return read_failure(path, system_reason(errno));
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return read_failure(path, system_reason(errno));
    if (S_ISDIR(status.st_mode)) return read_failure(path, "it is a folder");
    if (!S_ISREG(status.st_mode)) return read_failure(path, "it is not a regular file");
    const auto size = static_cast<std::uintmax_t>(status.st_size);
    if (size > limit) {
        return read_failure(
            path, fmt::format("it has {} bytes, but at most {} may be read", size, limit));
    }
    config::Outcome<std::string> outcome;
    try {
        outcome.value.emplace(static_cast<std::size_t>(size), '\0');
    } catch (const std::bad_alloc&) {
        return read_failure(path, fmt::format("its {} bytes do not fit in memory", size));
    }
    if (const int error = read_all(file.get(), *outcome.value)) {
        return read_failure(path, system_reason(error));
    }
    return outcome;
}

}  // namespace skybake
