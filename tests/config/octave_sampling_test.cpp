#include "config/sections/noise.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace skybake::config {
namespace {

using Triple = std::array<int, 3>;

TEST(OctaveSampling, CellsNeedFourVoxels) {
    EXPECT_FALSE(is_coarse({8, 8, 8}, {32, 32, 32}));
    EXPECT_TRUE(is_coarse({8, 8, 9}, {32, 32, 32}));
    EXPECT_TRUE(is_coarse({8, 8, 8}, {31, 32, 32}));
    EXPECT_FALSE(is_coarse({8, 8, 8}, {32, 32, 1})) << "a picture has no cells along z";
    EXPECT_TRUE(is_coarse({1048576, 1, 1}, {16384, 16384, 16384}));
}

TEST(OctaveSampling, PerlinNoiseDiesAtTheLattice) {
    const Triple cube{32, 32, 32};
    EXPECT_FALSE(is_zero_everywhere({32, 32, 32}, cube, NoiseSampling::centers));
    EXPECT_TRUE(is_zero_everywhere({64, 64, 64}, cube, NoiseSampling::centers));
    EXPECT_TRUE(is_zero_everywhere({32, 32, 32}, cube, NoiseSampling::corners));
    EXPECT_FALSE(is_zero_everywhere({16, 32, 32}, cube, NoiseSampling::corners));
    EXPECT_FALSE(is_zero_everywhere({32, 32, 32}, cube, NoiseSampling::slices_at_corners));
    EXPECT_TRUE(is_zero_everywhere({64, 64, 32}, cube, NoiseSampling::slices_at_corners));
    EXPECT_TRUE(is_zero_everywhere({1, 1, 1}, {1, 1, 1}, NoiseSampling::corners));
    EXPECT_FALSE(is_zero_everywhere({1, 1, 1}, {1, 1, 1}, NoiseSampling::centers));
    EXPECT_TRUE(is_zero_everywhere({2, 2, 2}, {1, 1, 1}, NoiseSampling::centers));
}

// Against the definition, voxel by voxel and axis by axis.
bool by_definition(const Triple& frequency, const Triple& size, NoiseSampling sampling) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool corners = sampling == NoiseSampling::corners ||
                             (sampling == NoiseSampling::slices_at_corners && axis == 2);
        for (long i = 0; i < size[axis]; ++i) {
            const long numerator =
                corners ? 2 * i * frequency[axis] : (2 * i + 1) * frequency[axis];
            if (numerator % (2L * size[axis]) != 0) return false;
        }
    }
    return true;
}

TEST(OctaveSampling, AgreesWithEveryVoxel) {
    EXPECT_TRUE(rc::check("zero everywhere, by definition", [] {
        const auto sampling = static_cast<NoiseSampling>(*rc::gen::inRange(0, 3));
        Triple size{};
        Triple frequency{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            size[axis] = *rc::gen::inRange(1, 40);
            // Half of all frequencies are multiples of the size, where it happens.
            const int factor = *rc::gen::inRange(1, 5);
            frequency[axis] =
                *rc::gen::arbitrary<bool>() ? factor * size[axis] : *rc::gen::inRange(1, 100);
        }
        RC_ASSERT(is_zero_everywhere(frequency, size, sampling) ==
                  by_definition(frequency, size, sampling));
    }));
}

}  // namespace
}  // namespace skybake::config
