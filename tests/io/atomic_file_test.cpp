#include "bakers/io/files/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "bakers/io/files/file_io.h"
#include "tests/io/small_disks.h"
#include "tests/support/cancelled_at.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

TEST(AtomicFile, WritesANewFileAndReplacesAnOldOne) {
    const TemporaryFolder folder;
    for (const char* text : {"a longer text than the new one", "short"}) {
        EXPECT_EQ(write_file_atomically(folder / "a.txt", text).value, WriteResult::written);
        EXPECT_EQ(read_bytes(folder / "a.txt"), text);
        EXPECT_EQ(folder.names(), Names{"a.txt"});
    }
}

TEST(AtomicFile, LeavesEqualBytesAndTheirTimeStampAlone) {
    const TemporaryFolder folder;
    const std::string bytes(200000, 'x');
    write_bytes(folder / "a.txt", bytes);
    const auto old_time = fs::file_time_type::clock::now() - std::chrono::hours(48);
    fs::last_write_time(folder / "a.txt", old_time);
    EXPECT_EQ(write_file_atomically(folder / "a.txt", bytes).value, WriteResult::unchanged);
    EXPECT_EQ(fs::last_write_time(folder / "a.txt"), old_time);
    EXPECT_EQ(write_file_atomically(folder / "a.txt", bytes.substr(1) + "y").value,
              WriteResult::written);
    EXPECT_NE(fs::last_write_time(folder / "a.txt"), old_time);
}

TEST(AtomicFile, PermissionsFollowTheUmaskOrTheOldFile) {
    const TemporaryFolder folder;
    const mode_t old_mask = ::umask(027);
    EXPECT_EQ(write_file_atomically(folder / "new", "1").value, WriteResult::written);
    write_bytes(folder / "old", "1");
    ::chmod((folder / "old").c_str(), 0606);
    EXPECT_EQ(write_file_atomically(folder / "old", "2").value, WriteResult::written);
    ::umask(old_mask);
    EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "new").permissions()), 0640u);
    EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "old").permissions()), 0606u);
}

// Whatever a link points to keeps its bytes, or its absence; the link is gone.
TEST(AtomicFile, ReplacesSymbolicLinksAndNeverTheirTargets) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "far");
    write_bytes(folder / "far/file", "of somebody else");
    fs::create_symlink("far/file", folder / "link");
    fs::create_symlink("link", folder / "chain");
    fs::create_symlink("far/absent", folder / "dangling");
    fs::create_symlink("circle", folder / "circle");
    fs::create_symlink("far", folder / "to_folder");
    for (const char* name : {"chain", "link", "dangling", "circle", "to_folder"}) {
        EXPECT_EQ(write_file_atomically(folder / name, "new").value, WriteResult::written) << name;
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / name))) << name;
        EXPECT_EQ(read_bytes(folder / name), "new") << name;
    }
    EXPECT_EQ(read_bytes(folder / "far/file"), "of somebody else");
    EXPECT_FALSE(fs::exists(folder / "far/absent"));
}

// A writer of these bytes, as a library would write them.
FileWriter writer_of(const std::string& bytes, bool complete = true) {
    return [bytes, complete](const fs::path& temporary) -> config::Outcome<bool> {
        write_bytes(temporary, bytes);
        return {complete, {}};
    };
}

// The bytes of a writer are compared with the old file: not with what a link points to.
TEST(AtomicFile, ALinkToTheSameBytesIsReplacedToo) {
    const TemporaryFolder folder;
    write_bytes(folder / "file", "same");
    for (const bool by_writer : {false, true}) {
        fs::remove(folder / "link");
        fs::create_symlink("file", folder / "link");
        AtomicFiles files;
        const auto staged = by_writer ? files.stage(folder / "link", writer_of("same"))
                                      : files.stage(folder / "link", std::string_view("same"));
        EXPECT_EQ(staged.value, WriteResult::written);
        EXPECT_TRUE(files.commit().empty());
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "link")));
    }
}

// Nor is a link that somebody puts in the place of a temporary.
TEST(AtomicFile, AWriterDoesNotFollowALinkInPlaceOfTheTemporary) {
    const TemporaryFolder folder;
    write_bytes(folder / "other", "of somebody else");
    fs::create_symlink("other", folder / "temporary");
    FileOutput output(folder / "temporary");
    output.write("new");
    EXPECT_FALSE(output.finish());
    EXPECT_EQ(output.error(), ELOOP);
    EXPECT_EQ(read_bytes(folder / "other"), "of somebody else");
}

TEST(AtomicFile, RefusesWhatIsNoFile) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "folder");
    write_bytes(folder / "file", "x");
    ::mkfifo((folder / "pipe").c_str(), 0600);
    fs::create_symlink("/proc/self/fd/1", folder / "stdout");
    const std::pair<fs::path, std::string> cases[] = {
        {folder / "folder", "it is a folder"},
        {folder / "folder/", "it is a folder"},
        {folder / "pipe", "it is not a regular file"},
        {"/dev/full", "it is not a regular file"},
        {folder / "stdout", "it is a link to a device or an open file"},
        {folder / "file/below", "Not a directory"},
        {folder / "absent/below", "No such file or directory"},
        {folder / std::string(300, 'n'), "File name too long"},
    };
    const Names before = folder.names();
    for (const auto& [path, reason] : cases) {
        const auto result = write_file_atomically(path, "new");
        EXPECT_FALSE(result.value.has_value()) << path;
        ASSERT_EQ(result.diagnostics.size(), 1u) << path;
        EXPECT_EQ(result.diagnostics[0].code, "E0301");
        EXPECT_NE(result.diagnostics[0].message.find(reason), std::string::npos)
            << result.diagnostics[0].message;
        EXPECT_NE(result.diagnostics[0].message.find(path.string()), std::string::npos);
    }
    EXPECT_EQ(folder.names(), before);
}

TEST(AtomicFile, ALongNameStillFits) {
    const TemporaryFolder folder;
    EXPECT_EQ(write_file_atomically(folder / std::string(255, 'n'), "x").value,
              WriteResult::written);
}

// Whether the file is refused for this reason.
bool is_refused(const fs::path& path, const std::string& text, std::string_view reason) {
    const auto result = write_file_atomically(path, text);
    return first_code(result.diagnostics) == "E0301" &&
           result.diagnostics[0].message.find(reason) != std::string::npos;
}

TEST(AtomicFile, ASizeLimitIsReportedAndNothingStays) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    {
        const testing::LargestFile limit(4096);
        EXPECT_TRUE(is_refused(folder / "a", std::string(100000, 'x'), "File too large"));
    }
    EXPECT_EQ(read_bytes(folder / "a"), "old");
    EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(AtomicFile, AFullDiskIsReportedAndNothingStays) {
    testing::expect_on_small_disk("64k", [](const TemporaryFolder& folder) {
        write_bytes(folder / "a", "old");
        const std::string large(1000000, 'x');
        if (!is_refused(folder / "a", large, "No space left on device")) return 1;
        if (read_bytes(folder / "a") != "old") return 2;
        return folder.names() == Names{"a"} ? 0 : 3;
    });
}

TEST(AtomicFile, AFullDiskLeavesAllFilesThatBelongTogether) {
    testing::expect_on_small_disk("64k", [](const TemporaryFolder& folder) {
        write_bytes(folder / "a", "old");
        write_bytes(folder / "b", "old");
        AtomicFiles files;
        if (files.stage(folder / "a", std::string(20000, 'x')).value != WriteResult::written)
            return 1;
        if (files.stage(folder / "b", std::string(60000, 'x')).value) return 2;
        return read_bytes(folder / "a") == "old" && read_bytes(folder / "b") == "old" ? 0 : 3;
    });
}

TEST(AtomicFile, AReadOnlyDiskIsReported) {
    testing::expect_on_small_disk("64k", [](const TemporaryFolder& folder) {
        if (::mount("none", folder.path().c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) != 0) {
            return testing::not_permitted;
        }
        return is_refused(folder / "a", "x", "Read-only file system") ? 0 : 1;
    });
}

TEST(AtomicFile, StagedFilesAppearTogetherOrNotAtAll) {
    const TemporaryFolder folder;
    {
        AtomicFiles files;
        EXPECT_TRUE(files.stage(folder / "a", "1").value);
        EXPECT_TRUE(files.stage(folder / "b", "2").value);
        EXPECT_FALSE(fs::exists(folder / "a"));
    }
    EXPECT_TRUE(folder.names().empty());
    AtomicFiles files;
    EXPECT_TRUE(files.stage(folder / "a", "1").value);
    EXPECT_TRUE(files.stage(folder / "b", "2").value);
    EXPECT_TRUE(files.commit().empty());
    EXPECT_EQ(folder.names(), (Names{"a", "b"}));
    EXPECT_EQ(read_bytes(folder / "a"), "1");
}

TEST(AtomicFile, TakesWhatAWriterWrites) {
    const TemporaryFolder folder;
    const std::string bytes(3000000, 'x');
    AtomicFiles files;
    EXPECT_EQ(files.stage(folder / "a", writer_of(bytes)).value, WriteResult::written);
    EXPECT_FALSE(fs::exists(folder / "a"));
    EXPECT_TRUE(files.commit().empty());
    EXPECT_TRUE(read_bytes(folder / "a") == bytes);

    const auto old_time = fs::file_time_type::clock::now() - std::chrono::hours(48);
    fs::last_write_time(folder / "a", old_time);
    ::chmod((folder / "a").c_str(), 0606);
    EXPECT_EQ(files.stage(folder / "a", writer_of(bytes)).value, WriteResult::unchanged);
    EXPECT_TRUE(files.commit().empty());
    EXPECT_EQ(fs::last_write_time(folder / "a"), old_time);
    // Different in the last byte, longer, shorter.
    for (const std::string& other : {bytes.substr(1) + "y", bytes + "x", bytes.substr(1)}) {
        EXPECT_EQ(files.stage(folder / "a", writer_of(other)).value, WriteResult::written);
        EXPECT_TRUE(files.commit().empty());
        EXPECT_TRUE(read_bytes(folder / "a") == other);
    }
    EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "a").permissions()), 0606u);
    EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(AtomicFile, AWriterThatFailsLeavesNothing) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    AtomicFiles files;
    const auto failed = files.stage(folder / "a", [](const fs::path& temporary) {
        write_bytes(temporary, "part");
        config::Diagnostic diagnostic;
        diagnostic.code = "E0301";
        diagnostic.message = "cannot write `" + temporary.string() + "`: no luck";
        diagnostic.where.source = temporary.string();
        return config::Outcome<bool>{{}, {diagnostic}};
    });
    ASSERT_EQ(first_code(failed.diagnostics), "E0301");
    // People are told of the file that they know.
    EXPECT_EQ(failed.diagnostics[0].message,
              "cannot write `" + (folder / "a").string() + "`: no luck");
    EXPECT_EQ(failed.diagnostics[0].where.source, (folder / "a").string());
    EXPECT_EQ(folder.names(), Names{"a"});
    EXPECT_EQ(files.stage(folder / "a", writer_of("part", false)).value, WriteResult::interrupted);
    EXPECT_EQ(folder.names(), Names{"a"});
    testing::CancelledAt cancelled("", 0);
    EXPECT_EQ(files.stage(folder / "a", writer_of("new"), &cancelled).value,
              WriteResult::interrupted);
    EXPECT_TRUE(files.commit().empty());
    EXPECT_EQ(read_bytes(folder / "a"), "old");
    for (const fs::path& path : {folder / "absent/below", fs::path("/dev/full")}) {
        EXPECT_EQ(first_code(files.stage(path, writer_of("new")).diagnostics), "E0301") << path;
    }
    EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(AtomicFile, AFolderWithoutPermissionIsReported) {
    const TemporaryFolder folder;
    constexpr auto listed = fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                            fs::perms::others_exec;
    fs::permissions(folder.path(), listed);
    const int status = in_child([&folder] {
        constexpr uid_t nobody = 65534;
        if (::geteuid() == 0 && ::setuid(nobody) != 0)
            return testing::not_permitted;  // root may write anywhere
        return is_refused(folder / "a", "x", "Permission denied") ? 0 : 1;
    });
    fs::permissions(folder.path(), fs::perms::owner_all);
    if (status == testing::not_permitted) GTEST_SKIP() << "root cannot become anybody else here";
    EXPECT_EQ(status, 0);
}

TEST(AtomicFile, AnInterruptionChangesNothing) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    const testing::CancelledAt progress("", 0);
    EXPECT_EQ(write_file_atomically(folder / "a", "new", &progress).value,
              WriteResult::interrupted);
    EXPECT_EQ(read_bytes(folder / "a"), "old");
    EXPECT_EQ(folder.names(), Names{"a"});
}

// Interrupts while the temporary exists, as the signal handler's second signal would.
class UnlinkingProgress : public Progress {
  public:
    void advance(std::string_view, double) override {}
    bool cancelled() const override {
        if (++looks_ == 2) remove_unfinished_files();
        return looks_ >= 3;
    }

  private:
    mutable int looks_ = 0;
};

TEST(AtomicFile, TheHandlerFindsTheCurrentTemporary) {
    const TemporaryFolder folder;
    const UnlinkingProgress progress;
    EXPECT_EQ(write_file_atomically(folder / "a", "new", &progress).value,
              WriteResult::interrupted);
    EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, KilledInTheMiddleLeavesTheOldOrTheNewFile) {
    const TemporaryFolder folder;
    const std::string texts[2] = {std::string(3000000, 'a'), std::string(2000000, 'b')};
    write_bytes(folder / "a", texts[0]);
    for (int round = 0; round < 8; ++round) {
        const pid_t child = ::fork();
        if (child == 0) {
            for (int i = 1;; ++i) {
                static_cast<void>(write_file_atomically(folder / "a", texts[i % 2]));
            }
        }
        std::this_thread::sleep_for(std::chrono::microseconds(3000 + 3700 * round));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        const std::string found = read_bytes(folder / "a");
        EXPECT_TRUE(found == texts[0] || found == texts[1]);
    }
    EXPECT_EQ(write_file_atomically(folder / "a", "at last").value, WriteResult::written);
    EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(AtomicFile, RemovesLeftOversOfTheDeadOnly) {
    const TemporaryFolder folder;
    // A file whose lock nobody holds, though process 1 is alive; one whose lock somebody holds, though
    // there is no such process; and names that only look alike.
    const std::string dead = ".a.skybake-1-0.tmp";
    const std::string locked = ".a.skybake-2147483646-0.tmp";
    const Names kept = {locked, ".a.skybake-x-0.tmp", ".a.skybake-5.tmp", ".b.skybake-1-0.tmp"};
    for (const std::string& name : kept) write_bytes(folder / name, "x");
    write_bytes(folder / dead, "x");
    const FileDescriptor writer(::open((folder / locked).c_str(), O_WRONLY));
    ASSERT_EQ(::flock(writer.get(), LOCK_EX), 0);
    EXPECT_EQ(write_file_atomically(folder / "a", "x").value, WriteResult::written);
    EXPECT_FALSE(fs::exists(folder / dead));
    for (const std::string& name : kept) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(AtomicFile, RemovesLeftOversWhereNothingIsWritten) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "x");
    write_bytes(folder / ".a.skybake-1-0.tmp", "y");
    EXPECT_EQ(write_file_atomically(folder / "a", "x").value, WriteResult::unchanged);
    EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(AtomicFile, ThreadsDoNotTakeEachOthersTemporaries) {
    const TemporaryFolder folder;
    std::atomic<int> failures{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&folder, &failures, t] {
            for (int i = 0; i < 20; ++i) {
                const auto result =
                    write_file_atomically(folder / "a", std::to_string(t * 100 + i));
                if (!result.value) ++failures;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(failures, 0);
    EXPECT_EQ(folder.names(), Names{"a"});
}

}  // namespace
}  // namespace skybake
