#include "bakers/report/measurement.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

namespace skybake {
namespace {

TEST(ThreadTime, SleepCostsNothing) {
    const double start = thread_cpu_seconds();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_LT(thread_cpu_seconds() - start, 0.02);
}

TEST(ThreadTime, JobsAreRunInTurn) {
    std::string order;
    const auto medians = interleaved_medians({[&] { order += 'a'; }, [&] { order += 'b'; }}, 3,
                                             [](int, std::size_t) { return true; });
    EXPECT_EQ(order, "ababab");
    ASSERT_EQ(medians.size(), 2u);
    for (const double seconds : medians) EXPECT_GE(seconds, 0);
}

TEST(ThreadTime, MoreWorkTakesLonger) {
    volatile double sink = 0;
    const auto work = [&](int count) {
        return [&sink, count] {
            for (int i = 0; i < count; ++i) sink = sink + 1;
        };
    };
    const auto medians = interleaved_medians({work(100000), work(1000000)}, 5,
                                             [](int, std::size_t) { return true; });
    EXPECT_GT(medians[1], 3 * medians[0]);
}

TEST(ThreadTime, StopsWhenTold) {
    int runs = 0;
    const auto medians =
        interleaved_medians({[&] { ++runs; }}, 5, [](int round, std::size_t) { return round < 2; });
    EXPECT_TRUE(medians.empty());
    EXPECT_EQ(runs, 2);
}

}  // namespace
}  // namespace skybake
