#include "bakers/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
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

}  // namespace
}  // namespace skybake
