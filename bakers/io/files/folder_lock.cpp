#include "bakers/io/files/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "bakers/io/files/file_diagnostic.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

enum class Attempt { taken, busy, impossible };

Attempt try_lock(int descriptor) {
    while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        return errno == EWOULDBLOCK ? Attempt::busy : Attempt::impossible;
    }
    return Attempt::taken;
}

// Whether the folder of that name is still the one that was opened: a process that gave up may have
// removed the one it had made.
bool is_still(const fs::path& folder, int descriptor) {
    struct stat named {};
    struct stat opened {};
    return ::stat(folder.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 &&
           named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

// Linux closes the descriptors of a dying process in ascending order. The lock's is a high one, so
// that whoever gets it from a process that was killed finds the temporaries of that one unlocked.
// Where there are not as many descriptors it stays as it is.
FileDescriptor closed_last(FileDescriptor descriptor) {
    if (!descriptor.valid()) return descriptor;
    constexpr int high = 512;  // of the 1024 that processes have by default
    FileDescriptor last(::fcntl(descriptor.get(), F_DUPFD_CLOEXEC, high));
    return last.valid() ? std::move(last) : std::move(descriptor);
}

}  // namespace

config::Outcome<FolderLock> FolderLock::acquire(const fs::path& folder,
                                                const std::function<void()>& waits,
                                                const std::function<bool()>& cancelled) {
    constexpr auto pause = std::chrono::milliseconds(20);
    FileDescriptor open;
    for (bool waited = false;;) {
        if (!open.valid()) {
            open = closed_last(
                FileDescriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)));
        }
        if (!open.valid()) {
            return {{},
                    {file_error("E0302", folder.string(),
                                fmt::format("cannot open the folder `{}`: {}", folder.string(),
                                            system_reason(errno)))}};
        }
        const Attempt attempt = try_lock(open.get());
        if (attempt != Attempt::busy && is_still(folder, open.get())) {
            return {FolderLock(std::move(open)), {}};
        }
        if (attempt != Attempt::busy) {
            // Gone, or another one: E0302 if it is gone.
            FileDescriptor gone;
            std::swap(open, gone);
            continue;
        }
        if (!waited) waits();
        waited = true;
        if (cancelled()) return {};
        std::this_thread::sleep_for(pause);
    }
}

}  // namespace skybake
