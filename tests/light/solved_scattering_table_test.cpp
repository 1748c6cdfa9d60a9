#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/field/baked.h"

#include <gtest/gtest.h>

#include "bakers/field/interpolation.h"
#include "bakers/light/solver/solved_light.h"
#include "tests/support/bakes.h"
#include "tests/support/loops.h"

namespace skybake {
namespace {

Baked table_of(const std::string& settings, Certification certification = Certification::off) {
    return test::without_errors(test::bake_first(
        "preset = \"earth_hillaire\"\n[bake.multiple_scattering]\nmethod = \"solved\"\n" + settings,
        {.certification = certification}));
}

TEST(SolvedScatteringTable, IsDropIn) {
    const Baked table = table_of("mapping = \"hillaire\"\nsize = [32, 32]\n", Certification::quick);
    EXPECT_EQ(table.image().width, 32);
    EXPECT_EQ(table.image().height, 32);
    EXPECT_EQ(table.axes[0].formula, "x = (mu_s + 1) / 2");
    for (const float value : table.image().texels) EXPECT_GE(value, 0);
    // Day is of the size of Hillaire's.
    EXPECT_NEAR(table.image().texel(31, 0)[2], 0.07, 0.01);
    EXPECT_LT(table.certificate.texel.max, 0.02);
}

TEST(SolvedScatteringTable, MomentsBeginWithTheMeanRadiance) {
    const std::string size = "size = [24, 9]\nmapping = \"twilight\"\n";
    const Baked mean = table_of(size);
    const Baked moments = table_of(size + "content = \"moments\"\ndegree = 3\n");
    EXPECT_EQ(moments.image().height, 9 * moment_count(3));
    testing::for_each_voxel({3, 24, 9}, [&](int c, int x, int y) {
        // Solved to the same degree, 4, at least.
        EXPECT_EQ(moments.image().texel(x, y)[c], mean.image().texel(x, y)[c]);
    });
    for (const Probe& probe : moments.levels[0].probes) {
        double value[3];
        bilinear(moments.image(), probe.uvw[0], probe.uvw[1], value);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(value[c], probe.value[c], 1e-15);
        }
    }
}

// A scene's suns alone: texels are closer.
TEST(SolvedScatteringTable, ScenesCropTheSuns) {
    const Baked cropped = table_of(
        "[scene]\naltitude = [\"0 km\", \"3 km\"]\nsun_elevation = [\"20 deg\", \"70 deg\"]\n",
        Certification::quick);
    EXPECT_GT(cropped.axes[0].first, 0);
    EXPECT_LT(cropped.axes[0].last, 1);
    // The whole axis leaves some per cent.
    EXPECT_LT(cropped.certificate.lookup.rms, 0.004);
    EXPECT_NE(cropped.parameters.find("scene"), std::string::npos);
}

}  // namespace
}  // namespace skybake
