// Voxels in memory: which assets share them, and that they are those that are made on demand.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "tests/clouds/clouds.h"

namespace skybake {
namespace {

config::CloudVolumeBake bake_of(const test::CloudCase& any) {
    config::CloudVolumeBake bake;
    bake.size = any.size;
    bake.pixel_type = config::PixelType::half;
    return bake;
}

BakeOptions options_with(std::int64_t held_voxel_bytes) {
    return {.certification = Certification::off, .held_voxel_bytes = held_voxel_bytes};
}

constexpr std::int64_t kPlenty = 1 << 24;

// A case whose cloud names its noises, as a recipe does.
test::CloudCase named(test::CloudCase any) {
    any.base.name = "base";
    any.cloud.noise = any.base.name;
    if (any.detail) {
        any.detail->name = "detail";
        any.cloud.detail = any.detail->name;
    }
    return any;
}

Intermediates::Expected expect(Intermediates& shared, const test::CloudCase& any) {
    config::Parameters parameters;
    parameters.clouds = {any.cloud};
    parameters.noises = {any.base};
    if (any.detail) parameters.noises.push_back(*any.detail);
    config::CloudVolumeBake bake = bake_of(any);
    bake.cloud = any.cloud.name;
    return shared.expect(needs_of_voxels(parameters, bake));
}

std::shared_ptr<const VoxelSource> held(Intermediates& shared, const test::CloudCase& any) {
    BakeOptions options = options_with(kPlenty);
    options.intermediates = &shared;
    const Baked volume = hold_cloud_volume(
        any.cloud, bake_of(any),
        {&any.base, nullptr, std::nullopt, any.detail_noise(), any.maps, {}}, options, {});
    return volume.levels.front().voxels;
}

TEST(HeldClouds, AreSharedAsLongAsSomebodyNeedsThem) {
    const test::CloudCase any = named(test::plain_case({16, 16, 8}));
    Intermediates shared(kPlenty);
    Intermediates::Expected expected = expect(shared, any);
    auto first = held(shared, any);
    EXPECT_EQ(held(shared, any), first);
    EXPECT_EQ(shared.kept_bytes(), 16 * 16 * 8 * 4);
    const std::weak_ptr<const VoxelSource> seen = first;
    first.reset();
    EXPECT_FALSE(seen.expired());
    expected = {};
    EXPECT_TRUE(seen.expired());
    EXPECT_NE(held(shared, any), nullptr);
}

TEST(HeldClouds, AreNotSharedByOtherClouds) {
    using Change = std::function<void(test::CloudCase&)>;
    const std::vector<Change> changes = {
        [](test::CloudCase& any) { any.cloud.threshold += 0.01; },
        [](test::CloudCase& any) { any.cloud.coverage -= 0.01; },
        [](test::CloudCase& any) {
            any.cloud.height_profile.table.push_back({0.5, 0.5});
        },
        [](test::CloudCase& any) {
            any.cloud.towers.push_back(test::tower(0.5, 0.5, 0.1, 0.1, 1));
        },
        [](test::CloudCase& any) { any.base.seed += 1; },
        [](test::CloudCase& any) { any.base.channels.front().octaves.gains.front() *= 2; },
        [](test::CloudCase& any) { any.detail = any.base; },
        [](test::CloudCase& any) { any.size[2] *= 2; },
    };
    const test::CloudCase any = test::plain_case({16, 16, 8});
    Intermediates shared(kPlenty);
    const auto expected = expect(shared, named(any));
    const auto first = held(shared, named(any));
    for (const Change& change : changes) {
        test::CloudCase other = any;
        change(other);
        const auto also_expected = expect(shared, named(other));
        EXPECT_NE(held(shared, named(other)), first);
    }
    EXPECT_EQ(held(shared, named(any)), first);
}

test::CloudCase with_map(const std::string& path) {
    test::CloudCase any = named(test::plain_case({16, 16, 8}));
    any.cloud.coverage_map.path = path;
    any.maps.coverage =
        cloud::MapLookup({1, 1, {0.5F}, {}}, config::MapWrap::repeat, config::MapFilter::linear);
    return any;
}

TEST(HeldClouds, AreSharedByEqualMapsOnly) {
    Intermediates shared(kPlenty);
    const auto expected = expect(shared, with_map("a.png"));
    const auto others_expected = expect(shared, with_map("b.png"));
    const auto first = held(shared, with_map("a.png"));
    EXPECT_EQ(held(shared, with_map("a.png")), first);
    EXPECT_NE(held(shared, with_map("b.png")), first);
}

// Halves that others read too are held as they were made, whoever makes them.
TEST(HeldClouds, AreHeldAsHalvesForTheirOwnFileOnly) {
    const test::CloudCase any = named(test::plain_case({16, 16, 8}));
    config::CloudVolumeBake bake = bake_of(any);
    bake.pixel_type = config::PixelType::half;
    const auto values_of = [](const VoxelSource& source) {
        std::vector<float> values(16 * 16 * 8);
        source.fill({{}, {16, 16, 8}}, {values.data()});
        return values;
    };
    Intermediates shared(kPlenty);
    BakeOptions options = options_with(kPlenty);
    options.intermediates = &shared;
    const auto expected = expect(shared, any);
    for (const int others : {0, 1}) {
        const auto expected_too = others > 0 ? expect(shared, any) : Intermediates::Expected();
        const auto outcome = bake_cloud_volume(
            any.cloud, bake, {&any.base, nullptr, std::nullopt, any.detail_noise(), any.maps, {}},
            options, {});
        ASSERT_TRUE(outcome.value);
        EXPECT_EQ(shared.made(), others);
        const auto of_file = values_of(*outcome.value->levels.front().voxels);
        EXPECT_EQ(of_file == values_of(*held(shared, any)), others > 0);
    }
    const auto last = bake_cloud_volume(
        any.cloud, bake, {&any.base, nullptr, std::nullopt, any.detail_noise(), any.maps, {}},
        options, {});
    EXPECT_EQ(last.value->levels.front().voxels, held(shared, any));
}

TEST(HeldClouds, HaveTheBytesOfThoseMadeOnDemand) {
    const test::CloudCase any = test::plain_case({32, 24, 17});
    config::CloudVolumeBake bake = bake_of(any);
    bake.mips = 3;
    std::vector<std::vector<std::string>> hashes;
    for (const std::int64_t bytes : {std::int64_t{0}, kPlenty}) {
        const auto outcome = bake_cloud_volume(
            any.cloud, bake, {&any.base, nullptr, std::nullopt, any.detail_noise(), any.maps, {}},
            options_with(bytes), {});
        ASSERT_TRUE(outcome.value);
        std::vector<std::string>& of_levels = hashes.emplace_back();
        for (const Level& level : outcome.value->levels) of_levels.push_back(level.content_hash);
    }
    EXPECT_EQ(hashes[0].size(), 3U);
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace skybake
