#include "bakers/light/multiple_scattering_mapping.h"

#include <gtest/gtest.h>

namespace skybake {
namespace {

using config::MultipleScatteringMapping;

TEST(MultipleScatteringMapping, RoundTripsAndEndPoints) {
    for (const auto mapping :
         {MultipleScatteringMapping::hillaire, MultipleScatteringMapping::twilight}) {
        for (const int size : {2, 3, 32, 33}) {
            for (int i = 0; i < size; ++i) {
                const double x = static_cast<double>(i) / (size - 1);
                EXPECT_NEAR(sun_coordinate(mapping, sun_cos_zenith_at(mapping, x)), x, 1e-12);
            }
        }
        EXPECT_EQ(sun_cos_zenith_at(mapping, 0), -1);
        EXPECT_EQ(sun_cos_zenith_at(mapping, 0.5), 0);
        EXPECT_EQ(sun_cos_zenith_at(mapping, 1), 1);
    }
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::hillaire, 0.75), 0.5);
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::twilight, 0.75), 0.25);
    EXPECT_EQ(sun_cos_zenith_at(MultipleScatteringMapping::twilight, 0.25), -0.25);
}

}  // namespace
}  // namespace skybake
