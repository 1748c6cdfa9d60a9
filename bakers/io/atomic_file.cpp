#include "bakers/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <string>
#include <utility>

#include "bakers/io/file_descriptor.h"
#include "bakers/io/file_diagnostic.h"
#include "bakers/io/temporary_file.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

config::Outcome<WriteResult> failure(const fs::path& path, const std::string& reason) {
    return {{},
            {file_error("E0301", path.string(),
                        fmt::format("cannot write `{}`: {}", path.string(), reason))}};
}

config::Outcome<WriteResult> failure(const fs::path& path, int error) {
    return failure(path, system_reason(error));
}

// The file that a chain of symbolic links ends at; it need not exist.
fs::path resolve_links(const fs::path& path, std::error_code& error) {
    constexpr int longest_chain = 40;  // what Linux follows
    fs::path target = path;
    for (int i = 0; i < longest_chain; ++i) {
        std::error_code status_error;
        if (fs::symlink_status(target, status_error).type() != fs::file_type::symlink)
            return target;
        const fs::path next = fs::read_symlink(target, error);
        if (error) return target;
        target = target.parent_path() / next;  // an absolute `next` replaces the whole
    }
    error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    return target;
}

// Whether an open file holds these bytes and no more. Reads it piece by piece: no second copy.
bool holds(int descriptor, std::string_view bytes) {
    std::array<char, 65536> piece;
    std::size_t done = 0;
    while (true) {
        const ssize_t count = ::read(descriptor, piece.data(), piece.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return false;
        const auto size = static_cast<std::size_t>(count);
        if (size == 0) return done == bytes.size();
        if (bytes.substr(done, size) != std::string_view(piece.data(), size)) return false;
        done += size;
    }
}

bool is_unchanged(const fs::path& path, const struct stat& status, std::string_view bytes) {
    if (static_cast<std::uintmax_t>(status.st_size) != bytes.size()) return false;
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    return file.valid() && holds(file.get(), bytes);
}

bool is_cancelled(const Progress* progress) { return progress != nullptr && progress->cancelled(); }

// Writes all bytes; returns errno, 0, or ECANCELED.
int write_all(int descriptor, std::string_view bytes, const Progress* progress) {
    constexpr std::size_t piece = std::size_t{4} << 20;  // between looks at `progress`
    while (!bytes.empty()) {
        if (is_cancelled(progress)) return ECANCELED;
        const ssize_t count = ::write(descriptor, bytes.data(), std::min(bytes.size(), piece));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) return EIO;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return is_cancelled(progress) ? ECANCELED : 0;
}

// To the disk, so that a crash after the rename does not leave an empty file under the new name,
// and so that network file systems report a full disk now.
int flush(int descriptor) {
    while (::fdatasync(descriptor) != 0) {
        if (errno == EINTR) continue;
        // Some file systems cannot, which is no reason not to write.
        return errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
    }
    return 0;
}

// Makes the temporary hold the bytes; errno, 0, or ECANCELED.
int fill(const TemporaryFile& temporary, std::optional<mode_t> mode, std::string_view bytes,
         const Progress* progress) {
    if (!temporary.valid()) return errno;
    if (mode && ::fchmod(temporary.descriptor(), *mode) != 0) return errno;
    const int error = write_all(temporary.descriptor(), bytes, progress);
    return error != 0 ? error : flush(temporary.descriptor());
}

}  // namespace

struct AtomicFiles::Staged {
    Staged(fs::path path_, fs::path target_)
        : path(std::move(path_)), target(std::move(target_)), temporary(target) {}

    fs::path path;    // as the user knows it
    fs::path target;  // where its links lead
    TemporaryFile temporary;
};

AtomicFiles::AtomicFiles() = default;
AtomicFiles::~AtomicFiles() = default;

config::Outcome<WriteResult> AtomicFiles::stage(const fs::path& path, std::string_view bytes,
                                                const Progress* progress) {
    if (!path.has_filename()) return failure(path, "it is a folder");
    std::error_code link_error;
    fs::path target = resolve_links(path, link_error);
    if (link_error) return failure(path, link_error.message());

    std::optional<mode_t> mode;
    struct stat status {};
    if (::stat(target.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) return failure(path, "it is a folder");
        if (!S_ISREG(status.st_mode)) return failure(path, "it is not a regular file");
        if (is_unchanged(target, status, bytes)) return {WriteResult::unchanged, {}};
        mode = status.st_mode & 07777;
    } else if (errno != ENOENT) {
        return failure(path, errno);
    }
    remove_stale_temporaries(target);
    if (is_cancelled(progress)) return {WriteResult::interrupted, {}};
    auto staged = std::make_unique<Staged>(path, std::move(target));
    const int error = fill(staged->temporary, mode, bytes, progress);
    if (error == ECANCELED) return {WriteResult::interrupted, {}};
    if (error != 0) return failure(path, error);
    staged_.push_back(std::move(staged));
    return {WriteResult::written, {}};
}

std::vector<config::Diagnostic> AtomicFiles::commit() {
    for (; !staged_.empty(); staged_.pop_back()) {
        Staged& last = *staged_.back();
        if (!last.temporary.rename_to(last.target)) return failure(last.path, errno).diagnostics;
    }
    return {};
}

config::Outcome<WriteResult> write_file_atomically(const fs::path& path, std::string_view bytes,
                                                   const Progress* progress) {
    AtomicFiles files;
    config::Outcome<WriteResult> result = files.stage(path, bytes, progress);
    if (!result.value) return result;
    std::vector<config::Diagnostic> diagnostics = files.commit();
    if (!diagnostics.empty()) return {{}, std::move(diagnostics)};
    return result;
}

}  // namespace skybake
