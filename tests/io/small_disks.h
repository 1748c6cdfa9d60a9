// Disks that fill up: a limit of the size of files, and small file systems.
#pragma once

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>
#include <string>

#include "tests/io/files.h"

namespace skybake::testing {

// Lets the process write files of so many bytes, as long as it lives.
class LargestFile {
  public:
    explicit LargestFile(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit = {bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~LargestFile() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int);
};

// What a child process returns where it must not do what the test is about.
inline constexpr int not_permitted = 77;

// Expects 0 of `body`, run with a file system of this size, as "64k", over the folder. It vanishes with
// the child process.
inline void expect_on_small_disk(const std::string& size,
                                 const std::function<int(const TemporaryFolder&)>& body) {
    const TemporaryFolder folder;
    const int status = in_child([&] {
        const bool mounted =
            ::unshare(CLONE_NEWNS) == 0 &&
            ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
            ::mount("none", folder.path().c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
        return mounted ? body(folder) : not_permitted;
    });
    if (status == not_permitted) GTEST_SKIP() << "mounting a small file system is not permitted";
    EXPECT_EQ(status, 0);
}

}  // namespace skybake::testing
