// Voxels in memory: which assets share them, and that they are those that are made on demand.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/field/pixel_type.h"
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

Baked baked(const test::CloudCase& any, const config::CloudVolumeBake& bake,
            const BakeOptions& options) {
    const CloudInputs inputs = {&any.base, nullptr, std::nullopt, any.detail_noise(), any.maps, {}};
    return *bake_cloud_volume(any.cloud, bake, inputs, options, {}).value;
}

// Halves that others read too are held as they were made.
TEST(HeldClouds, AreHeldAsHalvesForTheirOwnFileOnly) {
    const test::CloudCase any = named(test::plain_case({16, 16, 8}));
    const config::CloudVolumeBake bake = bake_of(any);
    Intermediates shared(kPlenty);
    BakeOptions options = options_with(kPlenty);
    options.intermediates = &shared;
    const auto expected = expect(shared, any);
    std::vector<float> alone(16 * 16 * 8);
    std::vector<float> whole(alone.size());
    baked(any, bake, options).levels.front().voxels->fill({{}, any.size}, {alone.data()});
    held(shared, any)->fill({{}, any.size}, {whole.data()});
    EXPECT_NE(alone, whole);
    round_values(whole.data(), whole.size(), bake.pixel_type);
    EXPECT_EQ(alone, whole);
    EXPECT_EQ(baked(any, bake, options).levels.front().voxels, held(shared, any));
    Intermediates others(kPlenty);
    options.intermediates = &others;
    const auto one = expect(others, any);
    const auto other = expect(others, any);
    EXPECT_EQ(baked(any, bake, options).levels.front().voxels, held(others, any));
}

TEST(HeldClouds, HaveTheBytesOfThoseMadeOnDemand) {
    const test::CloudCase any = test::plain_case({32, 24, 17});
    config::CloudVolumeBake bake = bake_of(any);
    bake.mips = 3;
    std::vector<std::vector<std::string>> hashes;
    for (const std::int64_t bytes : {std::int64_t{0}, kPlenty}) {
        const Baked volume = baked(any, bake, options_with(bytes));
        std::vector<std::string>& of_levels = hashes.emplace_back();
        for (const Level& level : volume.levels) of_levels.push_back(level.content_hash);
    }
    EXPECT_EQ(hashes[0].size(), 3U);
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace skybake
