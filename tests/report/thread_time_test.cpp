#include "bakers/report/measurement.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace skybake {
namespace {

TEST(ThreadTime, SleepCostsNothing) {
    const double start = thread_cpu_seconds();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_LT(thread_cpu_seconds() - start, 0.02);
}

}  // namespace
}  // namespace skybake
