#include "bakers/math/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace skybake {
namespace {

TEST(Parallel, VisitsEachTileOnce) {
    for (const int threads : {0, 1, 2, 7}) {
        for (const int count : {0, 1, 5, 1000}) {
            std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
            parallel_for(count, threads, [&](int i) { ++visits[static_cast<std::size_t>(i)]; });
            for (const auto& visit : visits) EXPECT_EQ(visit, 1);
        }
    }
}

TEST(Parallel, CountsThreads) {
    EXPECT_EQ(thread_count(7), 7);
    EXPECT_GE(thread_count(0), 1);
}

TEST(OrderedPipeline, ConsumesInOrderWhatWasProduced) {
    for (const int threads : {0, 1, 2, 7}) {
        for (const int slots : {1, 2, 9}) {
            for (const int count : {0, 1, 5, 700}) {
                // Neither array is atomic: ThreadSanitizer sees whether the slots carry items over.
                std::vector<int> carried(static_cast<std::size_t>(slots), -1);
                std::vector<int> consumed;
                ordered_pipeline(
                    count, threads, slots,
                    [&](int i, int slot) { carried[static_cast<std::size_t>(slot)] = i * 3; },
                    [&](int i, int slot) {
                        EXPECT_EQ(carried[static_cast<std::size_t>(slot)], i * 3);
                        consumed.push_back(i);
                        return true;
                    });
                ASSERT_EQ(consumed.size(), static_cast<std::size_t>(count));
                for (int i = 0; i < count; ++i) EXPECT_EQ(consumed[static_cast<std::size_t>(i)], i);
            }
        }
    }
}

TEST(OrderedPipeline, NoTwoLivingItemsShareASlot) {
    std::mutex mutex;
    std::set<int> alive;
    const auto pause = [](int i) {
        std::this_thread::sleep_for(std::chrono::microseconds(i * 7919 % 400));
    };
    ordered_pipeline(
        300, 5, 4,
        [&](int i, int slot) {
            {
                const std::lock_guard lock(mutex);
                EXPECT_TRUE(slot >= 0 && slot < 4);
                EXPECT_TRUE(alive.insert(slot).second) << i;
            }
            pause(i);
        },
        [&](int i, int slot) {
            pause(i * 31);
            const std::lock_guard lock(mutex);
            EXPECT_EQ(alive.erase(slot), 1U) << i;
            return true;
        });
    EXPECT_TRUE(alive.empty());
}

TEST(OrderedPipeline, ProducesWhileItConsumes) {
    // Item 0 is consumed only when item 1 is being produced: without overlap this would never end.
    std::atomic<bool> second_began = false;
    bool overlapped = false;
    ordered_pipeline(
        2, 2, 2, [&](int i, int) { second_began = second_began || i == 1; },
        [&](int i, int) {
            while (i == 0 && !second_began) std::this_thread::yield();
            overlapped = overlapped || second_began;
            return true;
        });
    EXPECT_TRUE(overlapped);
}

TEST(OrderedPipeline, StopsEarly) {
    for (const int threads : {1, 2, 7}) {
        std::atomic<int> produced = 0;
        int consumed = 0;
        ordered_pipeline(
            1000000, threads, 6, [&](int, int) { ++produced; },
            [&](int i, int) {
                EXPECT_EQ(i, consumed);
                ++consumed;
                return i < 9;
            });
        EXPECT_EQ(consumed, 10);
        EXPECT_LE(produced, 10 + 6);
    }
}

}  // namespace
}  // namespace skybake
