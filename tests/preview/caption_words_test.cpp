#include "bakers/preview/pictures/asset_pictures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skybake {
namespace {

// A caption's number of stops is what --exposure takes for the same picture.
TEST(CaptionWords, TellAnExposureInTheUnitOfTheOption) {
    EXPECT_EQ(exposure_text(5.13), "exposure 5.13 (+2.4 stops)");
    EXPECT_EQ(exposure_text(0.5), "exposure 0.5 (-1.0 stops)");
    EXPECT_EQ(exposure_text(1), "exposure 1 (+0.0 stops)");
    EXPECT_EQ(exposure_text(std::exp2(12)), "exposure 4096 (+12.0 stops)");
    EXPECT_EQ(tone_text(2), "exposure 2 (+1.0 stops), tone curve film");
}

TEST(CaptionWords, TellWhereTheSunStands) {
    EXPECT_EQ(sun_text(20), "sun 20 degrees above the horizon");
    EXPECT_EQ(sun_text(-4), "sun 4 degrees below the horizon");
    EXPECT_EQ(sun_text(1), "sun 1 degree above the horizon");
    EXPECT_EQ(sun_text(0), "sun on the horizon");
    EXPECT_EQ(sun_stem(20), "sun_20");
    EXPECT_EQ(sun_stem(-4), "sun_minus_4");
    EXPECT_EQ(sun_stem(0.5), "sun_0_5");
}

}  // namespace
}  // namespace skybake
