#include "bakers/io/folder_lock.h"

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/io/files.h"

namespace skybake {
namespace {

using namespace skybake::testing;

constexpr auto never = [] { return false; };
constexpr auto nothing = [] {};

TEST(FolderLock, IsHeldByOneAtATime) {
    const TemporaryFolder folder;
    std::atomic<int> inside{0};
    std::atomic<int> most{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] {
            const auto lock = FolderLock::acquire(folder.path(), nothing, never);
            ASSERT_TRUE(lock.value.has_value());
            most = std::max(most.load(), ++inside);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            --inside;
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(most, 1);
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
