#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "bakers/field/image.h"
#include "bakers/field/interpolation.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

TEST(TexelAxis, CentresMapToThemselves) {
    for (const auto convention :
         {TexelConvention::end_points_on_texel_centres, TexelConvention::end_points_on_edges}) {
        for (const int count : {1, 2, 3, 33, 256, 16384}) {
            for (int i = 0; i<count; i += count> 300 ? 97 : 1) {
                const double x = texel_coordinate(convention, i, count);
                EXPECT_NEAR(texture_coordinate(convention, x, count), (i + 0.5) / count, 1e-15);
            }
        }
    }
}

TEST(TexelAxis, EndPoints) {
    constexpr auto kCentres = TexelConvention::end_points_on_texel_centres;
    EXPECT_EQ(texel_coordinate(kCentres, 0, 5), 0);
    EXPECT_EQ(texel_coordinate(kCentres, 4, 5), 1);
    EXPECT_EQ(texel_coordinate(kCentres, 0, 1), 0.5);
}

TEST(TexelAxis, ALookupAtATexelCentreReturnsTheTexel) {
    for (const int count : {1, 2, 3, 7, 33}) {
        Image2<float> image(count, count, 1);
        for (std::size_t i = 0; i < image.texels.size(); ++i) {
            image.texels[i] = 1.0F / static_cast<float>(i + 1);
        }
        for (int j = 0; j < count; ++j) {
            for (int i = 0; i < count; ++i) {
                double value = 0;
                bilinear(image, (i + 0.5) / count, (j + 0.5) / count, &value);
                EXPECT_NEAR(value, *image.texel(i, j), 1e-12);
            }
        }
    }
}

// A lookup in the volume whose voxels have these values.
template <class Value>
double lookup(const std::array<int, 3>& size, const std::array<double, 3>& uvw,
              const Value& value) {
    double sum = 0;
    for (const VoxelTap& tap : trilinear_taps(size, uvw)) sum += tap.weight * value(tap.voxel);
    return sum;
}

TEST(Trilinear, CentresGiveTheirVoxel) {
    const std::array<int, 3> size = {3, 4, 5};
    const auto number = [](const std::array<int, 3>& v) { return v[0] + 10.0 * v[1] + 100 * v[2]; };
    testing::for_each_voxel({3, 4, 5}, [&](int x, int y, int z) {
        const std::array<double, 3> uvw = {(x + 0.5) / 3, (y + 0.5) / 4, (z + 0.5) / 5};
        EXPECT_NEAR(lookup(size, uvw, number), number({x, y, z}), 1e-12);
    });
}

TEST(Trilinear, IsLinearBetweenCentres) {
    const auto number = [](const std::array<int, 3>& v) { return v[0] + 10.0 * v[1] + 100 * v[2]; };
    EXPECT_NEAR(lookup({8, 8, 8}, {2.75 / 8, 3.0 / 8, 4.6 / 8}, number), 2.25 + 25 + 410, 1e-11);
}

TEST(Trilinear, MeetsTheNextCopyAcrossTheSeam) {
    const auto x_only = [](const std::array<int, 3>& v) {
        return v[0] == 7 ? 1.0 : v[0] == 0 ? 3 : 9;
    };
    EXPECT_NEAR(lookup({8, 1, 1}, {0, 0.3, 0.9}, x_only), 2, 1e-12);
    EXPECT_NEAR(lookup({8, 1, 1}, {0.25 / 8, 0, 0}, x_only), 2.5, 1e-12);
    EXPECT_NEAR(lookup({8, 1, 1}, {7.75 / 8, 0, 0}, x_only), 1.5, 1e-12);
}

TEST(Trilinear, RepeatsAndHasWeightsOfOne) {
    EXPECT_TRUE(rc::check([] {
        const std::array<int, 3> size = {*rc::gen::inRange(1, 300), *rc::gen::inRange(1, 300),
                                         *rc::gen::inRange(1, 300)};
        std::array<double, 3> uvw;
        for (double& u : uvw) u = *rc::gen::inRange(-4096, 4096) / 1024.0;
        double weights = 0;
        for (const VoxelTap& tap : trilinear_taps(size, uvw)) {
            RC_ASSERT(tap.weight >= 0 && tap.weight <= 1);
            for (std::size_t a = 0; a < 3; ++a) {
                RC_ASSERT(tap.voxel[a] >= 0 && tap.voxel[a] < size[a]);
            }
            weights += tap.weight;
        }
        RC_ASSERT(std::fabs(weights - 1) < 1e-12);
        const auto wave = [&](const std::array<int, 3>& v) {
            return std::cos(v[0] + 2.0 * v[1] + 3.0 * v[2]);
        };
        const double here = lookup(size, uvw, wave);
        for (double& u : uvw) u += 1;
        RC_ASSERT(std::fabs(lookup(size, uvw, wave) - here) < 1e-10);
    }));
}

TEST(Trilinear, RoundingJustBelowTheSeamStaysInside) {
    for (const VoxelTap& tap : trilinear_taps({7, 7, 7}, {-1e-20, -1e-300, -5e-324})) {
        for (const int i : tap.voxel) EXPECT_TRUE(i == 6 || i == 0);
    }
}

}  // namespace
}  // namespace skybake
