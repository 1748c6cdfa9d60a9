#include "bakers/report/sweeps/sweep.h"

#include <gtest/gtest.h>

namespace skybake {
namespace {

using Size = std::array<int, 2>;
using Sizes = std::vector<Size>;
using VolumeSize = std::array<int, 3>;
using VolumeSizes = std::vector<VolumeSize>;

TEST(Sweep, SizesAroundAreScaledWithinTheLimit) {
    EXPECT_EQ(sizes_around<2>({256, 64}, {{0.25, 0.25}, {1, 1}, {4, 4}, {8, 8}}, 1 << 18),
              (Sizes{{64, 16}, {256, 64}, {1024, 256}}));
    EXPECT_EQ(sizes_around<3>({96, 32, 5}, {{0.5, 0.5, 0.5}, {1, 1, 1}, {2, 2, 2}}, 16000),
              (VolumeSizes{{48, 16, 3}, {96, 32, 5}}));
}

TEST(Sweep, SmallSizesAreNeitherRepeatedNorEmpty) {
    EXPECT_EQ(sizes_around<2>({3, 1}, {{0.25, 0.25}, {0.5, 0.5}, {1, 1}}, 100),
              (Sizes{{2, 1}, {3, 1}}));
    EXPECT_EQ(sizes_around<3>({1, 2, 3}, {{0.5, 0.5, 0.5}, {2, 2, 2}}, 100),
              (VolumeSizes{{1, 2, 2}, {2, 4, 6}}));
}

// 2^33 texels are more than an int counts.
TEST(Sweep, SizeWithinHalvesAllAxes) {
    EXPECT_EQ(size_within<2>({256, 64}, 1 << 14), (Size{256, 64}));
    EXPECT_EQ(size_within<2>({1024, 256}, 1 << 14), (Size{256, 64}));
    EXPECT_EQ(size_within<2>({8192, 1}, 16), (Size{16, 1}));
    EXPECT_EQ(size_within<3>({2048, 2048, 2048}, 1 << 21), (VolumeSize{128, 128, 128}));
    EXPECT_EQ(size_within<3>({512, 512, 1}, 1 << 16), (VolumeSize{256, 256, 1}));
}

TEST(Sweep, SizeTextIsWidthTimesHeightTimesDepth) {
    EXPECT_EQ(size_text(Size{256, 64}), "256x64");
    EXPECT_EQ(size_text(VolumeSize{128, 64, 1}), "128x64x1");
}

}  // namespace
}  // namespace skybake
