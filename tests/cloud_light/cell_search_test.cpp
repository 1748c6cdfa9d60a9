// `max_error` chooses the largest cell that is near enough, by the certificate of each cell.
#include "bakers/assets/cloud_light/cloud_light_truth.h"
#include "bakers/field/baked.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "tests/cloud_light/layers.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

using cloud_light::CloudLayer;

CloudLightBake bake_of(CloudLightContents contents, double max_error) {
    CloudLightBake bake;
    bake.of = "cloud";
    bake.contents = contents;
    bake.pixel_type = config::PixelType::half;
    bake.max_error = max_error;
    if (config::is_per_sun(contents)) bake.sun_elevations = {{0.9}, {0.4}, {0.2}};
    return bake;
}

Outcome<int> chosen(const CloudLayer& layer, const CloudLightBake& bake, int threads = 2) {
    return largest_cell(layer, bake, "light", {.threads = threads});
}

// The RMS error that the asset of a cell claims.
double claimed(const CloudLayer& layer, CloudLightBake bake, int cell) {
    bake.cell = cell;
    const BakeOptions options{.threads = 2, .certification = Certification::quick};
    const auto outcome = bake_cloud_light(test::volume_of(layer), layer, bake, options, {});
    return outcome.value.value().certificate.lookup.rms;
}

void expect_largest(const CloudLayer& layer, const CloudLightBake& bake, int largest) {
    const Outcome<int> cell = chosen(layer, bake);
    ASSERT_TRUE(cell.value);
    EXPECT_LE(claimed(layer, bake, *cell.value), *bake.max_error) << *cell.value;
    for (int larger = *cell.value + 1; larger <= largest; ++larger) {
        EXPECT_GT(claimed(layer, bake, larger), *bake.max_error) << larger;
    }
    std::printf("max_error %.3g: cell %d, RMS %.3g\n", *bake.max_error, *cell.value,
                claimed(layer, bake, *cell.value));
}

TEST(CellSearch, FindsTheLargestCellThatIsNearEnough) {
    const CloudLayer layer = test::lone_cloud({24, 20, 12}, {4, 3, 2}, {17, 15, 10});
    for (const double max_error : {0.2, 0.1, 0.04}) {
        expect_largest(layer, bake_of(CloudLightContents::optical_depth, max_error), 11);
    }
    expect_largest(layer, bake_of(CloudLightContents::transmittance, 0.1), 11);
    expect_largest(layer, bake_of(CloudLightContents::shadow, 0.1), 19);
}

TEST(CellSearch, AsksForMoreTexelsWhereLessErrorIsAllowed) {
    const CloudLayer layer = test::lone_cloud({24, 20, 12}, {4, 3, 2}, {17, 15, 10});
    int before = config::most_cloud_light_cell;
    for (const double max_error : {0.3, 0.1, 0.03}) {
        const Outcome<int> cell =
            chosen(layer, bake_of(CloudLightContents::optical_depth, max_error));
        ASSERT_TRUE(cell.value);
        EXPECT_LE(*cell.value, before);
        before = *cell.value;
    }
    EXPECT_LT(before, 8);
}

// More points than the certificate's decide on harmonics, so that a larger cell may claim less.
TEST(CellSearch, KeepsHarmonicsWithinTheError) {
    const CloudLayer layer = test::lone_cloud({8, 8, 6}, {2, 3, 2}, {6, 7, 5});
    const CloudLightBake bake = bake_of(CloudLightContents::sky_visibility, 0.08);
    const Outcome<int> cell = chosen(layer, bake);
    ASSERT_TRUE(cell.value);
    EXPECT_LE(claimed(layer, bake, *cell.value), 0.08);
}

TEST(CellSearch, DoesNotDependOnThreads) {
    const CloudLayer layer = test::rough_layer({17, 13, 9}, 0.3);
    const CloudLightBake bake = bake_of(CloudLightContents::optical_depth, 0.05);
    EXPECT_EQ(chosen(layer, bake, 1).value, chosen(layer, bake, 5).value);
}

// Nothing is lost of light in empty air. Two texels are left along each axis, for one would be looked
// up in a single place.
TEST(CellSearch, TakesTheLargestCellOfAnEmptyLayer) {
    const CloudLightBake bake = bake_of(CloudLightContents::optical_depth, 1e-6);
    EXPECT_EQ(chosen(test::layer_of({70, 80, 66}, 0), bake).value, config::most_cloud_light_cell);
    EXPECT_EQ(chosen(test::layer_of({9, 9, 7}, 0), bake).value, 6);
    EXPECT_TRUE(
        chosen(test::layer_of({1, 1, 1}, 1), bake_of(CloudLightContents::optical_depth, 0.5))
            .value);
}

TEST(CellSearch, SaysHowNearTheBestCellIs) {
    const std::string message =
        test::expect_refused(chosen(test::rough_layer({16, 16, 8}, 0.3),
                                    bake_of(CloudLightContents::optical_depth, 1e-7)),
                             "E0403")
            .message;
    EXPECT_TRUE(message.starts_with(
        "`light`: no cell meets max_error = 1e-07; the best, 1, has an RMS error of "))
        << message;
}

// Values that a half cannot hold are errors, as they are in a bake.
TEST(CellSearch, ReportsWhatThePixelTypeCannotHold) {
    test::expect_refused(
        chosen(test::layer_of({8, 8, 8}, 1, 1e5), bake_of(CloudLightContents::optical_depth, 0.5)),
        "E0402");
}

}  // namespace
}  // namespace skybake
