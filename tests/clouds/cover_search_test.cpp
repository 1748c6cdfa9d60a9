// The coverage that gives a cloud a cover, against a search that fills every voxel at every step.
#include "bakers/clouds/cover_search.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>

#include "bakers/field/pixel_type.h"
#include "tests/clouds/clouds.h"
#include "tests/noise/every_target.h"

namespace skybake::cloud {
namespace {

using test::CloudCase;

// Counts the columns that hold cloud as they are stored.
std::int64_t columns_at(CloudCase any, const CoverRequest& request, double coverage) {
    any.cloud.coverage = coverage;
    const CloudField field(any.plan());
    std::vector<float> values(static_cast<std::size_t>(VoxelBox{{}, any.size}.count()));
    std::vector<float*> channels(static_cast<std::size_t>(field.plan().channels), nullptr);
    channels.front() = values.data();
    field.fill({{}, any.size}, channels);
    const auto slice =
        static_cast<std::size_t>(any.size[0]) * static_cast<std::size_t>(any.size[1]);
    std::vector<bool> covered(slice);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float stored = round_to_pixel_type(double{values[i]}, request.pixel_type);
        if (stored > request.level) covered[i % slice] = true;
    }
    return std::count(covered.begin(), covered.end(), true);
}

// The count that is nearest to the wanted one, among those of all coverages in [0, 1].
std::int64_t nearest_count(const CloudCase& any, const CoverRequest& request, std::int64_t wanted) {
    double low = 0;
    double high = 1;
    std::int64_t at_low = columns_at(any, request, low);
    std::int64_t at_high = columns_at(any, request, high);
    while (at_low < wanted && wanted < at_high) {
        const double middle = (low + high) / 2;
        if (middle <= low || middle >= high) break;
        const std::int64_t count = columns_at(any, request, middle);
        (count <= wanted ? low : high) = middle;
        (count <= wanted ? at_low : at_high) = count;
    }
    return std::abs(wanted - at_low) <= std::abs(at_high - wanted) ? at_low : at_high;
}

TEST(CoverSearch, IsExactForAnyCloud) {
    EXPECT_TRUE(rc::check([] {
        CloudCase any = test::any_cloud();
        any.size = {*rc::gen::inRange(1, 24), *rc::gen::inRange(1, 16), *rc::gen::inRange(1, 8)};
        CoverRequest request;
        request.share = test::any_number(0, 1);
        request.pixel_type =
            *rc::gen::element(PixelType::float32, PixelType::half, PixelType::unorm8);
        if (any.cloud.threshold_at == config::ThresholdAt::runtime) {
            request.level = static_cast<float>(any.cloud.threshold);
        }
        const FoundCover found = find_cover(any.plan(), request, {.threads = 2});
        const double columns = double{1} * any.size[0] * any.size[1];
        const auto wanted = static_cast<std::int64_t>(std::llround(request.share * columns));
        const std::int64_t counted = columns_at(any, request, found.coverage);
        const std::int64_t nearest = nearest_count(any, request, wanted);
        RC_ASSERT(std::abs(counted - wanted) <= std::abs(nearest - wanted));
        RC_ASSERT(found.share == static_cast<double>(counted) / columns);
    }));
}

CloudCase billows() {
    CloudCase any = test::plain_case({64, 48, 12});
    any.cloud.erosion = {0.3, 0.2};
    any.detail = test::noise_of({test::perlin({{6, 6, 6}})});
    return any;
}

TEST(CoverSearch, IsTheSameOnAnyMachine) {
    const CloudPlan plan = billows().plan();
    const FoundCover one = find_cover(plan, {0.4, 0, PixelType::half}, {.threads = 1});
    EXPECT_EQ(std::llround(one.share * 64 * 48), std::llround(0.4 * 64 * 48));
    EXPECT_EQ(find_cover(plan, {0.4, 0, PixelType::half}, {.threads = 3}).coverage, one.coverage);
    test::on_every_target([&](const char* name) {
        EXPECT_EQ(find_cover(plan, {0.4, 0, PixelType::half}, {.threads = 2}).coverage,
                  one.coverage)
            << name;
    });
}

// Noise below the threshold holds no cloud even at full coverage.
TEST(CoverSearch, SaysWhatCanBeReached) {
    CloudCase any = billows();
    any.cloud.threshold = 0.5;
    const FoundCover found = find_cover(any.plan(), {1, 0, PixelType::float32}, {});
    EXPECT_EQ(found.coverage, 1);
    EXPECT_EQ(found.share, found.reach[1]);
    EXPECT_LT(found.share, 1);
    EXPECT_EQ(found.reach[0], 0);
    EXPECT_EQ(find_cover(any.plan(), {0, 0, PixelType::float32}, {}).share, 0);
}

}  // namespace
}  // namespace skybake::cloud
