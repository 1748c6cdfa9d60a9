#include "tests/support/sky_truth.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/path_tracer/path_media.h"
#include "tests/support/temporary_folder.h"

namespace skybake {
namespace {

// The directions of the stored truth, all of them and no others.
TEST(SkyTruth, DirectionsAreThoseOfTheStoredTruth) {
    const auto stored = test::sky_truth_of(SKYBAKE_TEST_DATA "/truth_sky_setH0_h0.5.csv");
    const std::vector<SkyTruthDirection> directions = sky_truth_directions(0.5);
    ASSERT_EQ(directions.size(), 178U);
    ASSERT_EQ(stored.size(), 3 * directions.size());
    for (std::size_t i = 0; i < stored.size(); ++i) {
        const SkyTruth& value = stored[i];
        EXPECT_EQ(value.direction, directions[i % directions.size()]);
        EXPECT_EQ(value.channel, static_cast<int>(i / directions.size()));
        double sum = 0;
        for (const double order : value.orders) sum += order;
        EXPECT_NEAR(sum, value.radiance, 1e-5 * value.radiance);
    }
}

TEST(SkyTruth, TextKeepsEveryBit) {
    const SkyMedium medium = test::preset_sky("earth_hillaire");
    const std::vector<SkyTruthDirection> directions = {{0.5, 30, 60, 90}, {0, 96, 89.5, 180}};
    const std::vector<SkyTruth> values = trace_sky_truth(medium, directions, {3, 300}, 1);
    ASSERT_EQ(values.size(), 6U);
    EXPECT_EQ(values[4].direction, directions[1]);
    EXPECT_EQ(values[4].channel, 1);
    EXPECT_GT(values[0].radiance, 0);
    EXPECT_GT(values[0].standard_error, 0);
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "t.csv") << sky_truth_csv(values, "paths=300");
    EXPECT_EQ(test::sky_truth_of(folder / "t.csv"), values);
}

}  // namespace
}  // namespace skybake
