#include "bakers/io/files/output_folder.h"

#include <atomic>
#include <thread>

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

TEST(FolderLock, AFolderThatIsGoneIsAnError) {
    const TemporaryFolder folder;
    const auto lock = FolderLock::acquire(folder / "none", nothing, never);
    ASSERT_FALSE(lock.value.has_value());
    EXPECT_EQ(lock.diagnostics.at(0).code, "E0302");
}

}  // namespace
}  // namespace skybake
