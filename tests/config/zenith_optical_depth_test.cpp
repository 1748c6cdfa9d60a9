#include "config/sections/atmosphere.h"
#include "config/sections/layer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skybake::config {
namespace {

constexpr Length thickness{100e3};

TEST(ZenithOpticalDepth, Exponential) {
    Layer layer;
    layer.scale_height = {8000};
    EXPECT_NEAR(density_column(layer, thickness), 8000 * (1 - std::exp(-12.5)), 1e-9);
    // Where the air is far thinner than its scale height the column is its thickness.
    layer.scale_height = {1e9};
    EXPECT_NEAR(density_column(layer, Length{1}), 1, 1e-9);
}

TEST(ZenithOpticalDepth, TentCutAtGroundAndTop) {
    Layer layer;
    layer.profile = Profile::tent;
    layer.center_altitude = {25e3};
    layer.half_width = {15e3};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 15e3);
    EXPECT_DOUBLE_EQ(density_column(layer, Length{25e3}), 7.5e3);
    layer.center_altitude = {0};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 7.5e3);
    layer.center_altitude = {-7.5e3};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 0.5 * 7.5e3 * 0.5);
    layer.center_altitude = {-20e3};
    EXPECT_EQ(density_column(layer, thickness), 0);
}

TEST(ZenithOpticalDepth, SlabCutAtGroundAndTop) {
    Layer layer;
    layer.profile = Profile::slab;
    layer.bottom_altitude = {-1e3};
    layer.top_altitude = {2e3};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 2e3);
    layer.top_altitude = {1e9};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 100e3);
    layer.bottom_altitude = {200e3};
    EXPECT_EQ(density_column(layer, thickness), 0);
}

TEST(ZenithOpticalDepth, Tabulated) {
    Layer layer;
    layer.profile = Profile::tabulated;
    layer.table = {{{0}, 1}, {{1000}, 3}, {{2000}, 0}};
    EXPECT_DOUBLE_EQ(density_column(layer, thickness), 2000 + 1500);
    EXPECT_DOUBLE_EQ(density_column(layer, Length{500}), 500 * 1.5);
}

TEST(ZenithOpticalDepth, MultipliesByExtinction) {
    Layer layer;
    layer.profile = Profile::slab;
    layer.bottom_altitude = {0};
    layer.top_altitude = {1000};
    layer.extinction = {{1e-3}, {2e-3}, {0}};
    Atmosphere atmosphere;
    atmosphere.ground_radius = {1e6};
    atmosphere.top_radius = {1.1e6};
    atmosphere.ground_albedo = {0, 0, 0};
    EXPECT_EQ(zenith_optical_depth(layer, atmosphere), (std::vector<double>{1, 2, 0}));
}

}  // namespace
}  // namespace skybake::config
