#include "bakers/report/sweep.h"

#include <gtest/gtest.h>

namespace skybake {
namespace {

using Size = std::array<int, 2>;
using Sizes = std::vector<Size>;

TEST(Sweep, SizesAroundAreScaledWithinTheLimit) {
    EXPECT_EQ(sizes_around({256, 64}, {{0.25, 0.25}, {1, 1}, {4, 4}, {8, 8}}, 1 << 18),
              (Sizes{{64, 16}, {256, 64}, {1024, 256}}));
}

TEST(Sweep, SmallSizesAreNeitherRepeatedNorEmpty) {
    EXPECT_EQ(sizes_around({3, 1}, {{0.25, 0.25}, {0.5, 0.5}, {1, 1}}, 100),
              (Sizes{{2, 1}, {3, 1}}));
}

TEST(Sweep, SizeWithinHalvesBothAxes) {
    EXPECT_EQ(size_within({256, 64}, 1 << 14), (Size{256, 64}));
    EXPECT_EQ(size_within({1024, 256}, 1 << 14), (Size{256, 64}));
    EXPECT_EQ(size_within({8192, 1}, 16), (Size{16, 1}));
}

TEST(Sweep, SizeTextIsWidthTimesHeight) { EXPECT_EQ(size_text({256, 64}), "256x64"); }

}  // namespace
}  // namespace skybake
