// Tests how files are written: the order of system calls, and what happens when a signal interrupts one.
// This program's own open, rename, fsync, fdatasync, fchmod and flock stand before those of the C library.
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "tests/io/files.h"

namespace {

std::vector<std::string> seen;  // "rename a", "fsync folder"
bool interrupts = false;        // every other call fails with EINTR
int calls = 0;

bool is_interrupted() {
    if (!interrupts || ++calls % 2 == 0) return false;
    errno = EINTR;
    return true;
}

// Returns the last part of a path, of a temporary the name of its target.
std::string short_name(const std::string& path) {
    std::string name = path.substr(path.rfind('/') + 1);
    const std::size_t mark = name.find(".skybake-");
    return mark == std::string::npos ? name : name.substr(1, mark - 1);
}

std::string name_of(int descriptor) {
    std::string path(4096, '\0');
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    const ssize_t length = ::readlink(link.c_str(), path.data(), path.size());
    path.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    return short_name(path);
}

int answer(long result) { return static_cast<int>(result); }

}  // namespace

extern "C" int rename(const char* from, const char* to) noexcept {
    if (is_interrupted()) return -1;
    seen.push_back("rename " + short_name(to));
    return answer(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

extern "C" int fdatasync(int descriptor) {
    if (is_interrupted()) return -1;
    seen.push_back("fdatasync " + name_of(descriptor));
    return answer(::syscall(SYS_fdatasync, descriptor));
}

extern "C" int fsync(int descriptor) {
    if (is_interrupted()) return -1;
    seen.push_back("fsync " + name_of(descriptor));
    return answer(::syscall(SYS_fsync, descriptor));
}

extern "C" int fchmod(int descriptor, mode_t mode) noexcept {
    if (is_interrupted()) return -1;
    return answer(::syscall(SYS_fchmod, descriptor, mode));
}

extern "C" int flock(int descriptor, int operation) noexcept {
    if (is_interrupted()) return -1;
    return answer(::syscall(SYS_flock, descriptor, operation));
}

extern "C" int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    if (is_interrupted()) return -1;
    return answer(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

namespace skybake {
namespace {

namespace fs = std::filesystem;
using Calls = std::vector<std::string>;

class SystemCalls : public ::testing::Test {
  protected:
    SystemCalls() {
        seen.clear();
        calls = 0;
    }
    ~SystemCalls() override { interrupts = false; }

    Calls of_commit(AtomicFiles& files) const {
        EXPECT_TRUE(files.commit().empty());
        Calls named = seen;
        for (std::string& call : named) {
            if (call == "fsync " + folder_.path().filename().string()) call = "fsync folder";
        }
        return named;
    }

    const TemporaryFolder folder_;
};

// Otherwise a power cut may leave an empty file, or a manifest without its files.
TEST_F(SystemCalls, FilesAreFlushedBeforeTheyAreNamedAndTheLastIsNamedLast) {
    AtomicFiles files;
    EXPECT_TRUE(files.stage(folder_ / "a", "1").value);
    const FileWriter writer = [](const fs::path& temporary) -> config::Outcome<bool> {
        write_bytes(temporary, "2");
        return {true, {}};
    };
    EXPECT_TRUE(files.stage(folder_ / "b", writer).value);
    EXPECT_TRUE(files.stage(folder_ / "manifest", "3").value);
    EXPECT_EQ(of_commit(files),
              (Calls{"fdatasync a", "fdatasync b", "fdatasync manifest", "rename a", "rename b",
                     "fsync folder", "rename manifest", "fsync folder"}));
}

TEST_F(SystemCalls, AFileAloneIsFlushedBeforeAndItsFolderAfterwards) {
    AtomicFiles files;
    EXPECT_TRUE(files.stage(folder_ / "a", "1").value);
    EXPECT_EQ(of_commit(files), (Calls{"fdatasync a", "rename a", "fsync folder"}));
}

TEST_F(SystemCalls, AreMadeAgainAfterASignal) {
    write_bytes(folder_ / "a", "old");
    fs::permissions(folder_ / "a", fs::perms::owner_read | fs::perms::owner_write);
    for (const int first : {0, 1}) {
        interrupts = true;
        calls = first;
        const std::string text = "new " + std::to_string(first);
        const auto written = write_file_atomically(folder_ / "a", text);
        const auto read = read_file(folder_ / "a");
        const auto print = fingerprint(folder_ / "a");
        const auto lock = FolderLock::acquire(
            folder_.path(), [] {}, [] { return true; });
        FileOutput output(folder_ / "a");
        output.write("more");
        const bool complete = output.finish();
        interrupts = false;
        EXPECT_EQ(written.value, WriteResult::written) << first;
        EXPECT_EQ(read.value, text);
        EXPECT_TRUE(print.value && lock.value && complete) << first;
        EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a"}));
    }
    EXPECT_EQ(fs::status(folder_ / "a").permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
}

// Staged files are closed: a bake of ten thousand files needs no ten thousand descriptors.
TEST_F(SystemCalls, StagedFilesAreNotHeldOpen) {
    const auto open_files = [] {
        return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
    };
    AtomicFiles files;
    const auto before = open_files();
    for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(files.stage(folder_ / std::to_string(i), "x").value);
    }
    EXPECT_LE(open_files(), before + 2);
    // Another writer of the same file sees that this process lives, though the file is closed.
    EXPECT_TRUE(write_file_atomically(folder_ / "50", "of somebody else").value);
    EXPECT_TRUE(files.commit().empty());
    EXPECT_EQ(read_bytes(folder_ / "50"), "x");
    EXPECT_EQ(folder_.names().size(), 100U);
}

}  // namespace
}  // namespace skybake
