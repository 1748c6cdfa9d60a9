#include "bakers/field/finish_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/field/survey_volume.h"
#include "tests/field/looked_up.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::FunctionVoxels;
using testing::looked_up;
using testing::plain_volume;
using testing::sample_voxel;
using UnitPlace = std::array<double, 3>;

// A level that has been surveyed and has its probes.
Level probed(const std::array<int, 3>& size, int channels, PixelType type,
             FunctionVoxels::Function function, bool nearest = false, int threads = 1) {
    Baked volume = plain_volume(size, channels, type, std::move(function));
    const std::vector<std::array<double, 2>> ranges(static_cast<std::size_t>(channels), {0, 1});
    BakeOptions options;
    options.threads = threads;
    EXPECT_TRUE(survey_level(volume, 0, ranges, options).empty());
    Level& level = volume.levels[0];
    level.nearest = nearest;
    EXPECT_FALSE(add_volume_probes("shape", 3, {}, type, options, level).has_value());
    return level;
}

bool catches(const Level& level, const std::string& fault) {
    return std::find(level.catches.begin(), level.catches.end(), fault) != level.catches.end();
}

TEST(VolumeProbes, AreTheStoredVoxelsLookedUpDirectly) {
    for (const std::array<int, 3>& size :
         {std::array<int, 3>{8, 6, 10}, {1, 1, 1}, {3, 1, 2}, {16, 16, 16}}) {
        for (const PixelType type : {PixelType::float32, PixelType::half, PixelType::unorm8}) {
            const Level level = probed(size, 3, type, sample_voxel);
            EXPECT_GE(level.probes.size(), 16u);
            for (const Probe& probe : level.probes) {
                ASSERT_EQ(probe.value.size(), 3u);
                ASSERT_EQ(probe.tolerance.size(), 3u);
                ASSERT_EQ(probe.at.size(), 3u);
                for (const double u : probe.uvw) EXPECT_TRUE(u >= 0 && u <= 1) << u;
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_GT(probe.tolerance[c], 0);
                    EXPECT_NEAR(probe.value[c],
                                looked_up(sample_voxel, size, type, static_cast<int>(c), probe.uvw),
                                1e-12);
                }
            }
        }
    }
}

// A runtime that gets an axis backwards, swaps two, is half a voxel off or clamps at the seam must
// fail: on each axis some probes are apart from what it finds by more than they tolerate.
TEST(VolumeProbes, CatchWrongLookups) {
    const std::array<int, 3> size = {16, 16, 16};
    const Level level = probed(size, 1, PixelType::half, sample_voxel);
    const auto caught = [&](const auto& change) {
        int count = 0;
        for (const Probe& probe : level.probes) {
            const double found =
                looked_up(sample_voxel, size, PixelType::half, 0, change(probe.uvw));
            count += std::fabs(found - probe.value[0]) > probe.tolerance[0] ? 1 : 0;
        }
        return count;
    };
    EXPECT_EQ(caught([](const UnitPlace& p) { return p; }), 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto moved = [axis](UnitPlace p, double by) {
            p[axis] += by;
            return p;
        };
        EXPECT_GE(caught([&](UnitPlace p) {
                      p[axis] = 1 - p[axis];
                      return p;
                  }),
                  8);
        EXPECT_GE(caught([&](const UnitPlace& p) { return moved(p, 0.5 / 16); }), 8);
        EXPECT_GE(caught([&](UnitPlace p) {
                      std::swap(p[axis], p[(axis + 1) % 3]);
                      return p;
                  }),
                  8);
        EXPECT_GE(caught([&](UnitPlace p) {  // clamped
                      p[axis] = std::min(std::max(p[axis], 0.5 / 16), 15.5 / 16);
                      return p;
                  }),
                  3);
        // Filtering in steps of 1/256 voxel, rounded either way, passes.
        EXPECT_EQ(caught([&](UnitPlace p) {
                      for (std::size_t k = 0; k < 3; ++k) {
                          p[k] = std::floor(p[k] * 16 * 256 + (k == axis ? 0.9 : 0)) / (16 * 256);
                      }
                      return p;
                  }),
                  0);
    }
    for (const char* fault :
         {"zeros", "flip_u", "flip_v", "flip_w", "swap_uv", "swap_uw", "swap_vw", "shift_u",
          "shift_v", "shift_w", "wrap_u", "wrap_v", "wrap_w", "filter"}) {
        EXPECT_TRUE(catches(level, fault)) << fault;
    }
}

// A blob of a few voxels in a quarter of a million: that it is empty elsewhere proves nothing.
TEST(VolumeProbes, LieWhereSparseVolumesAreNotEmpty) {
    const auto blob = [](int x, int y, int z, int) {
        const int apart = std::max({std::abs(x - 41), std::abs(y - 9), std::abs(z - 50)});
        return apart < 2 ? 1.0F - 0.25F * static_cast<float>(apart) : 0.0F;
    };
    const Level level = probed({64, 64, 64}, 1, PixelType::half, blob);
    int within = 0;
    for (const Probe& probe : level.probes) {
        within += probe.value[0] > 16 * probe.tolerance[0] ? 1 : 0;
    }
    EXPECT_GE(within, 12);
    for (const char* fault : {"zeros", "flip_u", "flip_v", "flip_w", "swap_uv", "swap_uw",
                              "swap_vw", "shift_u", "shift_v", "shift_w", "filter"}) {
        EXPECT_TRUE(catches(level, fault)) << fault;
    }
}

TEST(VolumeProbes, OfNearestVoxelsTellLinearLookups) {
    const auto cell = [](int x, int y, int z, int) { return (x * y + z) % 3 == 0 ? 1.0F : 0.0F; };
    const Level level = probed({8, 8, 4}, 1, PixelType::unorm8, cell, true);
    for (const Probe& probe : level.probes) {
        EXPECT_TRUE(probe.value[0] == 0 || probe.value[0] == 1) << probe.value[0];
    }
    EXPECT_TRUE(catches(level, "filter"));
    EXPECT_TRUE(catches(level, "flip_u"));
    EXPECT_TRUE(catches(level, "shift_w"));
}

// A fault that changes no lookup cannot be caught, and is not said to be.
TEST(VolumeProbes, LeaveOutFaultsThatChangeNothing) {
    const Level constant =
        probed({8, 8, 8}, 1, PixelType::half, [](int, int, int, int) { return 0.5F; });
    EXPECT_EQ(constant.catches, std::vector<std::string>{"zeros"});
    const Level empty =
        probed({8, 8, 8}, 1, PixelType::half, [](int, int, int, int) { return 0.0F; });
    EXPECT_TRUE(empty.catches.empty());
    EXPECT_GE(empty.probes.size(), 16u);
    // The same backwards along x.
    const Level mirrored = probed({8, 8, 8}, 1, PixelType::half, [](int x, int y, int z, int) {
        return sample_voxel(std::min(x, 7 - x), y, z, 0);
    });
    EXPECT_FALSE(catches(mirrored, "flip_u"));
    EXPECT_TRUE(catches(mirrored, "flip_v"));
    EXPECT_TRUE(catches(mirrored, "shift_u"));
    EXPECT_TRUE(catches(mirrored, "swap_uv"));
    // The same with x and y exchanged.
    const Level square = probed({8, 8, 8}, 1, PixelType::half, [](int x, int y, int z, int) {
        return sample_voxel(std::min(x, y), std::max(x, y), z, 0);
    });
    EXPECT_FALSE(catches(square, "swap_uv"));
    EXPECT_TRUE(catches(square, "swap_uw"));
    EXPECT_TRUE(catches(square, "flip_u"));
    // The same all along z.
    const Level column = probed({8, 8, 8}, 1, PixelType::half,
                                [](int x, int y, int, int) { return sample_voxel(x, y, 0, 0); });
    for (const char* fault : {"flip_w", "shift_w", "wrap_w"}) {
        EXPECT_FALSE(catches(column, fault)) << fault;
    }
    EXPECT_TRUE(catches(column, "swap_uw"));
}

TEST(VolumeProbes, AreTheSameForAnyNumberOfThreads) {
    const Level one = probed({16, 12, 9}, 3, PixelType::half, sample_voxel, false, 1);
    const Level two = probed({16, 12, 9}, 3, PixelType::half, sample_voxel, false, 2);
    ASSERT_EQ(one.probes.size(), two.probes.size());
    EXPECT_EQ(one.catches, two.catches);
    for (std::size_t i = 0; i < one.probes.size(); ++i) {
        EXPECT_EQ(one.probes[i].uvw, two.probes[i].uvw);
        EXPECT_EQ(one.probes[i].value, two.probes[i].value);
        EXPECT_EQ(one.probes[i].tolerance, two.probes[i].tolerance);
    }
}

}  // namespace
}  // namespace skybake
