#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/field/baked.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bakers/air/optical_depth.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/field/interpolation.h"
#include "tests/support/bakes.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

Baked bake(const std::string& section, const std::string& preset = "earth_hillaire",
           BakeOptions options = {1, Certification::quick, nullptr}) {
    return test::without_errors(test::bake_first(
        "preset = \"" + preset + "\"\n[bake.table]\nasset = \"transmittance\"\n" + section,
        options));
}

TEST(TransmittanceTable, FirstRowIsTheGroundAndFirstColumnStraightUp) {
    const Baked table = bake("size = [256, 64]\n");
    const Medium earth = test::preset_medium("earth_hillaire");
    const Spectrum up = optical_depth_to_top(earth, 0, 6360);
    const Spectrum horizon = optical_depth_to_top(earth, 0, 0);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(table.image().texel(0, 0)[c], static_cast<float>(std::exp(-up[c])));
        EXPECT_FLOAT_EQ(table.image().texel(255, 0)[c], static_cast<float>(std::exp(-horizon[c])));
        EXPECT_EQ(table.image().texel(0, 63)[c], 1.0F);
    }
    EXPECT_EQ(table.channel_names, (std::vector<std::string>{"R", "G", "B"}));
}

TEST(TransmittanceTable, CertifiesTexelsAndLookups) {
    const Baked table = bake("size = [256, 64]\n");
    ASSERT_TRUE(table.certified);
    EXPECT_LT(table.certificate.texel.max, 1e-7);
    EXPECT_GT(table.certificate.texel.max, 1e-9);
    EXPECT_LT(table.certificate.lookup.rms, 2.5e-4);  // 1.3e-4 to 1.9e-4 by the points chosen
    EXPECT_GT(table.certificate.lookup.rms, 1e-4);
    EXPECT_EQ(table.certificate.lookup_points, 384);
}

TEST(TransmittanceTable, HalfAndOpticalDepth) {
    const Baked half = bake("size = [256, 64]\npixel_type = \"half\"\n");
    EXPECT_GT(half.range.below_normal, 0);
    EXPECT_NEAR(half.certificate.texel.max, 0x1p-12, 0x1p-13);
    const Baked depth = bake("size = [256, 64]\ncontent = \"optical_depth\"\n");
    const Baked transmittance = bake("size = [256, 64]\n");
    for (std::size_t i = 0; i < depth.image().texels.size(); ++i) {
        EXPECT_NEAR(std::exp(-depth.image().texels[i]), transmittance.image().texels[i], 1e-6);
    }
}

TEST(TransmittanceTable, UeMappingHasNoHalfTexel) {
    const Baked table = bake("size = [64, 16]\nmapping = \"ue\"\n");
    const Medium earth = test::preset_medium("earth_hillaire");
    const TransmittanceRay ray = transmittance_ray({6360, 100}, {10.5 / 64, 3.5 / 16});
    const Spectrum tau = optical_depth_to_top(earth, ray.altitude_km, ray.s_km);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(table.image().texel(10, 3)[c], static_cast<float>(std::exp(-tau[c])));
    }
}

TEST(TransmittanceTable, MaxErrorTakesTheSmallestTableThatHolds) {
    const Baked table = bake("max_error = \"1 %\"\n");
    EXPECT_LE(table.certificate.lookup.max, 0.01);
    EXPECT_LT(table.image().texels.size(), 256U * 64 * 3);
    EXPECT_GT(table.image().texels.size(), 100U);
}

TEST(TransmittanceTable, MaxErrorOutOfReachFailsWithTheFigure) {
    test::expect_refused(
        test::bake_first("preset = \"earth_hillaire\"\n[bake.transmittance]\nmax_error = 2e-7\n"
                         "pixel_type = \"half\"\n"),
        "E0403");
}

TEST(TransmittanceTable, DepthBeyondHalfIsRefused) {
    test::expect_refused(
        test::bake_first(
            "preset = \"earth_hillaire\"\n[atmosphere.layers.rayleigh]\nscattering = \"1 /m\"\n"
            "[bake.transmittance]\ncontent = \"optical_depth\"\npixel_type = \"half\"\n"),
        "E0402");
}

TEST(TransmittanceTable, ScatteringAndPhaseLeaveItAlone) {
    const auto parameters = [](const std::string& more) {
        return test::bake_first("preset = \"earth_hillaire\"\n" + more + "[bake.transmittance]\n",
                                {1, Certification::off})
            .value->parameters;
    };
    const std::string plain = parameters("");
    EXPECT_EQ(plain, parameters("[atmosphere.layers.mie]\ng = 0.5\nscattering = \"1e-6 /m\"\n"));
    EXPECT_EQ(plain, parameters("[atmosphere]\nground_albedo = 0.9\n"));
    EXPECT_NE(plain, parameters("[atmosphere.layers.mie]\nscale_height = \"1.3 km\"\n"));
}

}  // namespace
}  // namespace skybake
