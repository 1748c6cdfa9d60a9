// A preview takes what was baked before and bakes nothing again.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bakers/preview/bake_assets.h"
#include "bakers/workspace/copy_asset.h"
#include "tests/incremental/bakes.h"
#include "tests/support/cancelled_at.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using namespace skybake::testing;

struct Shown {
    PreviewAssets assets;
    std::vector<std::string> ready;
    int steps = 0;
};

Shown shown(const config::Recipe& recipe, const std::vector<fs::path>& folders,
            Certification certification = Certification::quick) {
    BakedFolders source(folders);
    AssetMemo memo;
    memo.sources = {&source};
    CancelledAt progress("", 1 << 20);
    auto assets =
        bake_assets(recipe, recipe.parameters.bakes, "test", {1, certification, &progress}, &memo);
    EXPECT_TRUE(assets.value);
    return {std::move(*assets.value), memo.ready, progress.seen};
}

void expect_equal(const PreviewAssets& one, const PreviewAssets& other) {
    ASSERT_EQ(one.assets.size(), other.assets.size());
    for (std::size_t i = 0; i < one.assets.size(); ++i) {
        EXPECT_EQ(one.assets[i].entry.name, other.assets[i].entry.name);
        EXPECT_EQ(one.assets[i].entry.content_hash, other.assets[i].entry.content_hash);
        EXPECT_EQ(one.assets[i].table.texels, other.assets[i].table.texels);
        EXPECT_EQ(one.assets[i].voxels, other.assets[i].voxels);
    }
}

class BakedBefore : public ::testing::Test {
  protected:
    void bake(Certification certification) {
        TestBake bake(recipe_, folder_ / "out");
        bake.bake.certification = certification;
        ASSERT_TRUE(bake.run().value);
    }

    TemporaryFolder folder_;
    config::Recipe recipe_ = testing::recipe_of(small_recipe);
};

TEST_F(BakedBefore, APreviewAfterABakeBakesNothing) {
    bake(Certification::quick);
    const Shown baked = shown(recipe_, {});
    EXPECT_GT(baked.steps, 0);
    EXPECT_TRUE(baked.ready.empty());
    const Shown found = shown(recipe_, {folder_ / "absent", folder_ / "out"});
    EXPECT_EQ(found.steps, 0);
    EXPECT_EQ(found.ready.size(), 3U);
    expect_equal(found.assets, baked.assets);
}

TEST_F(BakedBefore, WhatHasChangedIsBaked) {
    bake(Certification::quick);
    const config::Recipe changed =
        testing::recipe_of(small_recipe, {}, {"atmosphere.ground_albedo=0.125"});
    const Shown found = shown(changed, {folder_ / "out"});
    EXPECT_EQ(found.ready, (std::vector<std::string>{"transmittance", "shape"}));
    expect_equal(found.assets, shown(changed, {}).assets);
}

// An asset that was measured less than a preview measures does not serve it; one measured more does.
TEST_F(BakedBefore, ABetterCertificateServes) {
    std::erase_if(recipe_.parameters.bakes, [](const config::Bake& bake) {
        return bake.name == "multiple_scattering";  // it takes seconds to measure in full
    });
    bake(Certification::full);
    EXPECT_EQ(shown(recipe_, {folder_ / "out"}).ready.size(), 2U);
    bake(Certification::off);
    EXPECT_TRUE(shown(recipe_, {folder_ / "out"}).ready.empty());
    EXPECT_EQ(shown(recipe_, {folder_ / "out"}, Certification::off).ready.size(), 2U);
}

TEST_F(BakedBefore, ADamagedFileIsNotShown) {
    bake(Certification::quick);
    const Shown whole = shown(recipe_, {});
    for (const char* name : {"transmittance.exr", "shape.bin", "shape.exr"}) {
        std::string bytes = read_bytes(folder_ / "out" / name);
        bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
        write_bytes(folder_ / "out" / name, bytes);
        expect_equal(shown(recipe_, {folder_ / "out"}).assets, whole.assets);
    }
    EXPECT_EQ(shown(recipe_, {folder_ / "out"}).ready.size(), 1U);
    fs::remove(folder_ / "out/multiple_scattering.exr");
    EXPECT_TRUE(shown(recipe_, {folder_ / "out"}).ready.empty());
    EXPECT_EQ(read_bytes(folder_ / "out/manifest.json").empty(), false) << "the folder stays";
}

TEST(OfKind, IsTheTableWhoseLightHasTheSmallestErrorInSkies) {
    PreviewAssets assets;
    for (const std::optional<double> median : {std::optional<double>(), {0.05}, {0.01}, {0.03}}) {
        assets.assets.emplace_back().entry.kind = "multiple_scattering";
        if (!median) continue;
        assets.assets.back().entry.error.emplace().sky.emplace().median = *median;
    }
    EXPECT_EQ(assets.of_kind("multiple_scattering"), &assets.assets[2]);
    EXPECT_EQ(assets.of_kind("transmittance"), nullptr);
    assets.assets.resize(1);
    EXPECT_EQ(assets.of_kind("multiple_scattering"), &assets.assets[0]);
}

}  // namespace
}  // namespace skybake
