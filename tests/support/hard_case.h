// Hard cases are tests that also say how well they did: `ctest -L hard` prints the table of all.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace skybake::test {

// Holds `error` to `bound` and adds a row to the table: the case's number and name in physics
// terms, what it was held against, the error reached.
inline void hold(const std::string& name, const std::string& against, double error, double bound) {
    char row[512];
    std::snprintf(row, sizeof row, "%-46s %-52s %9.2g  (bound %.0e)", name.c_str(), against.c_str(),
                  error, bound);
    EXPECT_LE(error, bound) << row;
    if (const char* folder = std::getenv("SKYBAKE_HARD_CASES")) {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        std::ofstream(std::string(folder) + "/" + info->name(), std::ios::app) << row << '\n';
    }
}

// Holds what `bake(threads)` returns on 2 and 7 threads to what it returns on one.
template <class Bake>
void hold_on_threads(const std::string& what, const Bake& bake) {
    const auto one = bake(1);
    int different = 0;
    for (const int threads : {2, 7}) different += bake(threads) != one ? 1 : 0;
    hold("21 " + what + " on 1, 2 and 7 threads", "same bits (count of differences)", different, 0);
}

}  // namespace skybake::test
