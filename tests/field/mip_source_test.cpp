#include "bakers/field/stored_voxels.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <memory>

#include "tests/support/any_values.h"
#include "tests/support/comparisons.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::FunctionVoxels;
using testing::planes_of;
using testing::sample_voxel;
using Size = std::array<int, 3>;

// A coarse voxel by the header's words: the integral of the finer ones, each constant over its
// width, over [i n/m, (i + 1) n/m).
double by_definition(const FunctionVoxels::Function& finer, const Size& n, const Size& m,
                     const std::array<int, 3>& voxel, int channel) {
    std::array<std::vector<std::pair<int, double>>, 3> weights;  // finer voxel, share
    for (std::size_t a = 0; a < 3; ++a) {
        const double width = static_cast<double>(n[a]) / m[a];
        const double begin = voxel[a] * width;
        for (int i = 0; i < n[a]; ++i) {
            const double overlap = std::min(begin + width, i + 1.0) - std::max<double>(begin, i);
            if (overlap > 1e-12) weights[a].push_back({i, overlap / width});
        }
    }
    double sum = 0;
    for (const auto& [z, wz] : weights[2]) {
        for (const auto& [y, wy] : weights[1]) {
            for (const auto& [x, wx] : weights[0]) {
                sum += wx * wy * wz * double{finer(x, y, z, channel)};
            }
        }
    }
    return sum;
}

TEST(MipSource, HalvesSizesDownToOne) {
    EXPECT_EQ(next_mip_size({8, 7, 1}), (Size{4, 3, 1}));
    EXPECT_EQ(next_mip_size({16384, 3, 2}), (Size{8192, 1, 1}));
    EXPECT_EQ(next_mip_size({1, 1, 1}), (Size{1, 1, 1}));
}

TEST(MipSource, IsItsDefinitionAndKeepsTheMean) {
    EXPECT_TRUE(rc::check([] {
        const Size size = {*rc::gen::inRange(1, 14), *rc::gen::inRange(1, 14),
                           *rc::gen::inRange(1, 14)};
        const auto finer = std::make_shared<FunctionVoxels>(sample_voxel);
        const Size half = next_mip_size(size);
        const MipSource coarser(finer, size, half);
        const auto values = planes_of(coarser, {{}, half}, 2);
        std::size_t at = 0;
        testing::for_each_voxel(half, [&](int x, int y, int z) {
            for (int c = 0; c < 2; ++c) {
                const double wanted = by_definition(sample_voxel, size, half, {x, y, z}, c);
                RC_ASSERT(std::fabs(values[static_cast<std::size_t>(c)][at] - wanted) < 1e-7);
            }
            ++at;
        });
        RC_ASSERT(std::fabs(test::mean_of(values[0]) -
                            test::mean_of(planes_of(*finer, {{}, size}, 1)[0])) < 0x1p-24);
    }));
}

TEST(MipSource, BoxesEqualTheWhole) {
    EXPECT_TRUE(rc::check([] {
        const Size size = {*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40),
                           *rc::gen::inRange(1, 40)};
        const Size half = next_mip_size(size);
        const MipSource coarser(std::make_shared<FunctionVoxels>(sample_voxel), size, half);
        const auto whole = planes_of(coarser, {{}, half}, 2);
        RC_ASSERT(testing::is_part_of(whole, coarser, half, test::any_box(half)));
    }));
}

// So many channels and rows that finer slices come in several parts.
TEST(MipSource, LargeBoxesInParts) {
    const Size size = {256, 300, 40};
    const Size half = next_mip_size(size);
    const MipSource coarser(std::make_shared<FunctionVoxels>(sample_voxel), size, half);
    const auto whole = planes_of(coarser, {{}, half}, 4);
    for (const std::array<int, 3>& voxel : {Size{0, 0, 0}, Size{127, 149, 19}, Size{64, 75, 10}}) {
        EXPECT_TRUE(testing::is_part_of(whole, coarser, half, {voxel, {1, 1, 1}}));
    }
    std::vector<float> second(whole[1].size());
    coarser.fill({{}, half}, {nullptr, second.data(), nullptr, nullptr});
    EXPECT_EQ(second, whole[1]);
}

// A chain keeps the mean down to its last voxel, which is the mean.
TEST(MipSource, ChainsEndInTheMean) {
    for (const Size& first : {Size{16, 16, 16}, Size{13, 6, 1}, Size{1, 9, 27}}) {
        std::shared_ptr<const VoxelSource> level = std::make_shared<FunctionVoxels>(sample_voxel);
        Size size = first;
        const double wanted = test::mean_of(planes_of(*level, {{}, size}, 1)[0]);
        int levels = 1;
        while (size != Size{1, 1, 1}) {
            level = std::make_shared<MipSource>(level, size, next_mip_size(size));
            size = next_mip_size(size);
            ++levels;
            EXPECT_NEAR(test::mean_of(planes_of(*level, {{}, size}, 1)[0]), wanted,
                        levels * 0x1p-24);
        }
        EXPECT_EQ(levels, first[0] == 16 ? 5 : first[0] == 13 ? 4 : 5);
    }
}

}  // namespace
}  // namespace skybake
