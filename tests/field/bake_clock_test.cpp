#include "bakers/math/bake_clock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace skybake {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Takes some time that is above 0 on any clock.
void work() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

double sum_of(const BakeSeconds& spent) { return spent.made() + spent.certificate; }

TEST(BakeClock, BooksAllTimeOnceWhateverIsNested) {
    const Clock::time_point before = Clock::now();
    BakeClock clock;
    const Clock::time_point begun = Clock::now();
    work();
    {
        const BakeTime light(BakePart::light);
        work();
        const BakeTime colors(BakePart::colors);
        work();
    }
    work();
    const double least = seconds_since(begun);
    const BakeSeconds spent = clock.seconds();
    EXPECT_GE(sum_of(spent), least - 1e-9);
    EXPECT_LE(sum_of(spent), seconds_since(before));
    EXPECT_GE(spent.light, 0.002);
    EXPECT_GE(spent.colors, 0.002);
    EXPECT_GE(spent.texels, 0.004);
    EXPECT_EQ(spent.certificate, 0);
}

TEST(BakeClock, BooksOnACertificateWhatIsMadeForIt) {
    BakeClock clock;
    {
        const BakeTime certificate(BakePart::certificate);
        const BakeTime light(BakePart::light);
        work();
    }
    EXPECT_EQ(clock.seconds().light, 0);
    EXPECT_GE(clock.seconds().certificate, 0.002);
}

TEST(BakeClock, IsThatOfItsThread) {
    BakeClock clock;
    std::thread([] {
        const BakeTime light(BakePart::light);
        work();
    }).join();
    EXPECT_EQ(clock.seconds().light, 0);
    {
        BakeClock inner;
        const BakeTime light(BakePart::light);
        work();
        EXPECT_GT(inner.seconds().light, 0);
    }
    EXPECT_EQ(clock.seconds().light, 0);
    EXPECT_GE(clock.seconds().texels, 0.004);
}

}  // namespace
}  // namespace skybake
