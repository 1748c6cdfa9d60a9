#include "config/text/text.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

namespace skybake::config {
namespace {

const std::vector<std::string_view> known = {"scale_height", "scattering", "phase", "profile", "g"};

TEST(Suggest, CountsEdits) {
    EXPECT_EQ(edit_distance("", ""), 0);
    EXPECT_EQ(edit_distance("", "abc"), 3);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
    EXPECT_EQ(edit_distance("hieght", "height"), 1);  // a swap
}

TEST(Suggest, FindsTheNearestName) {
    EXPECT_EQ(nearest_name("scale_hieght", known), "scale_height");
    EXPECT_EQ(nearest_name("scatering", known), "scattering");
    EXPECT_EQ(nearest_name("Phase", known), "phase");
    EXPECT_EQ(did_you_mean("profil", known), "did you mean `profile`?");
}

TEST(Suggest, StaysSilentWhereNothingIsNear) {
    EXPECT_EQ(nearest_name("temperature", known), std::nullopt);
    EXPECT_EQ(nearest_name("", known), std::nullopt);
    EXPECT_EQ(nearest_name("x", known), std::nullopt);
    EXPECT_EQ(nearest_name(std::string(1000, 'a'), known), std::nullopt);
    EXPECT_EQ(did_you_mean("temperature", known), "");
}

TEST(Suggest, DistanceIsSymmetricAndZeroForEquals) {
    EXPECT_TRUE(rc::check("a distance", [](const std::string& a, const std::string& b) {
        RC_ASSERT(edit_distance(a, b) == edit_distance(b, a));
        RC_ASSERT((edit_distance(a, b) == 0) == (a == b));
        RC_ASSERT(edit_distance(a, b) <= static_cast<int>(std::max(a.size(), b.size())));
    }));
}

}  // namespace
}  // namespace skybake::config
