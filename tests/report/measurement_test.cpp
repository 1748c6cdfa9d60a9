#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

#include "bakers/report/measurement.h"

namespace skybake {

namespace {

void write(const MemoryFile& file, const std::string& text) {
    std::ofstream stream(file.path(), std::ios::binary | std::ios::trunc);
    stream << text;
    EXPECT_TRUE(stream.good());
}

TEST(MemoryFile, HoldsWhatIsWrittenToItsPath) {
    const MemoryFile file;
    EXPECT_EQ(file.bytes(), 0u);
    write(file, "seven b");
    EXPECT_EQ(file.bytes(), 7u);
    std::string text;
    std::ifstream(file.path(), std::ios::binary) >> text;
    EXPECT_EQ(text, "seven");
    write(file, "b");
    EXPECT_EQ(file.bytes(), 1u);
}

TEST(MemoryFile, IsNoOtherMemoryFile) {
    const MemoryFile first;
    const MemoryFile second;
    write(first, "12345");
    EXPECT_EQ(first.bytes(), 5u);
    EXPECT_EQ(second.bytes(), 0u);
}

TEST(ThreadTime, SleepCostsNothing) {
    const double start = thread_cpu_seconds();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_LT(thread_cpu_seconds() - start, 0.02);
}

using Front = std::vector<bool>;

TEST(ParetoFront, KeepsWhatNothingBeats) {
    EXPECT_EQ(pareto_front({{1, 9}, {2, 4}, {3, 5}, {4, 1}, {5, 1}}),
              Front({true, true, false, true, false}));
}

TEST(ParetoFront, EqualChoicesShareTheirFate) {
    EXPECT_EQ(pareto_front({{1, 2}, {1, 2}, {2, 2}}), Front({true, true, false}));
}

TEST(ParetoFront, OfNothingIsEmptyAndOfOneIsThatOne) {
    EXPECT_TRUE(pareto_front({}).empty());
    EXPECT_EQ(pareto_front({{0, 0}}), Front({true}));
}

TEST(ParetoFront, WhatIsNotFiniteIsNeverOnIt) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(pareto_front({{1, nan}, {2, 1}, {nan, 0}}), Front({false, true, false}));
}

TEST(ParetoFront, CostsWithinTheNoiseAreTheSameWhereErrorsDiffer) {
    EXPECT_EQ(pareto_front({{1, 2}, {1.04, 1}}, 0.05), Front({false, true}));
    EXPECT_EQ(pareto_front({{1, 2}, {1.06, 1}}, 0.05), Front({true, true}));
    EXPECT_EQ(pareto_front({{1, 1}, {1.04, 1}}, 0.05), Front({true, false}));
}

}  // namespace

}  // namespace skybake
