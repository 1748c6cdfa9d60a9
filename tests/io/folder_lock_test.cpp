#include "bakers/io/files/output_folder.h"

#include <atomic>
#include <optional>
#include <thread>

#include "bakers/io/files/temporary_file.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

using namespace skybake::testing;

constexpr auto never = [] { return false; };
constexpr auto nothing = [] {};

// The first that gets it keeps it until all others have said that they wait.
TEST(FolderLock, IsHeldByOneAtATime) {
    constexpr int kThreads = 4;
    const TemporaryFolder folder;
    std::atomic<int> entered{0};
    std::atomic<int> waiting{0};
    std::atomic<int> inside{0};
    std::atomic<int> most{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i) {
        threads.emplace_back([&] {
            const auto lock = FolderLock::acquire(
                folder.path(), [&] { ++waiting; }, never);
            ASSERT_TRUE(lock.value.has_value());
            most = std::max(most.load(), ++inside);
            if (++entered == 1) {
                while (waiting < kThreads - 1) std::this_thread::yield();
            }
            --inside;
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(most, 1);
    EXPECT_EQ(entered, kThreads);
}

TEST(FolderLock, WaitingEndsWithAnInterruption) {
    const TemporaryFolder folder;
    const auto lock = FolderLock::acquire(folder.path(), nothing, never);
    int told = 0;
    const auto second = FolderLock::acquire(
        folder.path(), [&] { ++told; }, [&] { return told > 0; });
    EXPECT_FALSE(second.value.has_value());
    EXPECT_TRUE(second.diagnostics.empty());
    EXPECT_EQ(told, 1);
}

// Whoever waited holds the lock of the folder that has the name now, not of one that had it.
TEST(FolderLock, OfAFolderThatWasReplacedDoesNotCount) {
    const TemporaryFolder parent;
    const auto folder = parent / "folder";
    std::filesystem::create_directory(folder);
    std::optional<FolderLock> first = std::move(FolderLock::acquire(folder, nothing, never).value);
    ASSERT_TRUE(first);
    const auto replace = [&] {
        std::filesystem::rename(folder, parent / "earlier");
        std::filesystem::create_directory(folder);
        first.reset();
    };
    const auto second = FolderLock::acquire(folder, replace, never);
    ASSERT_TRUE(second.value.has_value());
    bool waited = false;
    const auto third = FolderLock::acquire(
        folder, [&] { waited = true; }, [] { return true; });
    EXPECT_TRUE(waited) << "two processes would work in one folder";
    EXPECT_FALSE(third.value.has_value());
}

// Linux closes the descriptors of a killed process in ascending order. If the lock went before the
// temporaries', the next process would take these for those of a living one.
TEST(FolderLock, IsTheLastThatAKilledProcessCloses) {
    const TemporaryFolder folder;
    const auto lock = FolderLock::acquire(folder.path(), nothing, never);
    ASSERT_TRUE(lock.value.has_value());
    const TemporaryFile temporary(folder / "a");
    int descriptor_of_lock = -1;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code gone;
        if (std::filesystem::read_symlink(entry.path(), gone) != folder.path()) continue;
        descriptor_of_lock = std::stoi(entry.path().filename().string());
    }
    EXPECT_GT(descriptor_of_lock, temporary.descriptor());
}

TEST(FolderLock, AFolderThatIsGoneIsAnError) {
    const TemporaryFolder folder;
    const auto lock = FolderLock::acquire(folder / "none", nothing, never);
    ASSERT_FALSE(lock.value.has_value());
    EXPECT_EQ(lock.diagnostics.at(0).code, "E0302");
}

}  // namespace
}  // namespace skybake
