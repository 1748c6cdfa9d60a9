#include "bakers/field/image.h"

#include <gtest/gtest.h>

#include "bakers/field/interpolation.h"

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

}  // namespace
}  // namespace skybake
