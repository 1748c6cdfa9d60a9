// Assets that an interrupted preview has finished are not made again.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bakers/preview/bake_assets.h"
#include "bakers/preview/preview_files.h"
#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

// Counts the stages that begin, and ends the work at one of them.
class EndsAt : public StageProgress {
  public:
    explicit EndsAt(int stage) : stage_(stage) {}
    void advance(std::string_view, double) override { ++steps; }
    void begin_stage(int index, int, std::string_view) override { begun = index; }
    bool cancelled() const override { return begun == stage_; }
    int begun = 0;
    int steps = 0;

  private:
    int stage_;
};

config::Recipe two_noises(const std::string& seed) {
    return test::recipe_of("[noise.n]\nseed = " + seed +
                               "\nsize = [16, 16, 16]\n[noise.n.channels.Y]\ntype = \"worley\"\n"
                               "frequency = 2\n[noise.m]\nsize = [16, 16, 16]\n"
                               "[noise.m.channels.Y]\ntype = \"worley\"\nfrequency = 2\n"
                               "[bake.m]\nasset = \"noise_volume\"\nnoise = \"m\"\n"
                               "[bake.n]\nasset = \"noise_volume\"\nnoise = \"n\"\n",
                           {});
}

// Bakes both noises and returns how often their progress was told.
int steps_of_bake(const std::string& seed, int ends_at, AssetMemo& memo) {
    const config::Recipe recipe = two_noises(seed);
    EndsAt progress(ends_at);
    const BakeOptions options{1, Certification::off, &progress};
    const auto assets =
        bake_assets(recipe, recipe.parameters.bakes, "test", options, &memo, {&progress, 2});
    EXPECT_EQ(assets.value.has_value(), ends_at == 0);
    EXPECT_TRUE(assets.diagnostics.empty());
    return progress.steps;
}

TEST(AssetMemo, KeepsWhatWasBakedBeforeAnInterruption) {
    AssetMemo memo;
    steps_of_bake("1", 2, memo);
    EXPECT_TRUE(memo.assets.empty());
    ASSERT_EQ(memo.unfinished.size(), 1U);
    EXPECT_EQ(memo.unfinished.begin()->second.entry.name, "m");
    // Another save: the noise that has not changed is kept again.
    steps_of_bake("2", 2, memo);
    ASSERT_EQ(memo.unfinished.size(), 1U);
    AssetMemo none;
    EXPECT_LT(steps_of_bake("2", 0, memo), steps_of_bake("2", 0, none));
    EXPECT_EQ(memo.assets.size(), 2U);
    EXPECT_TRUE(memo.unfinished.empty());
}

TEST(AssetMemo, GivesWhatWasBakedBefore) {
    AssetMemo memo;
    const int steps = steps_of_bake("1", 0, memo);
    EXPECT_GT(steps, 0);
    EXPECT_EQ(steps_of_bake("1", 0, memo), 0) << "nothing has changed";
    steps_of_bake("2", 2, memo);
    EXPECT_EQ(memo.assets.size(), 2U) << "an interruption forgets nothing";
    EXPECT_EQ(steps_of_bake("1", 0, memo), 0) << "and the recipe is as it was";
}

// A memo changes no voxel: what was baked of another recipe is not what this one asks for.
TEST(AssetMemo, BakesAgainWhatHasChanged) {
    AssetMemo memo;
    steps_of_bake("1", 0, memo);
    steps_of_bake("2", 0, memo);
    AssetMemo fresh;
    steps_of_bake("2", 0, fresh);
    ASSERT_EQ(memo.assets.size(), 2U);
    ASSERT_EQ(fresh.assets.size(), 2U);
    for (const auto& [key, asset] : fresh.assets) {
        ASSERT_TRUE(memo.assets.contains(key)) << asset.entry.name;
        EXPECT_EQ(memo.assets.at(key).voxels, asset.voxels) << asset.entry.name;
    }
}

PreviewPicture picture(const std::string& name) {
    PreviewPicture made;
    made.name = name;
    made.picture = Picture(1, 1);
    return made;
}

TEST(PictureEncoder, KeepsThePicturesOfTheLastPreview) {
    PictureMemo memo;
    int made = 0;
    const auto preview_of = [&](const std::vector<std::string>& keys) {
        PictureEncoder encoder(1, &memo);
        for (const std::string& key : keys) {
            encoder.encode(key, [&] {
                ++made;
                return std::vector{picture(key)};
            });
        }
        EXPECT_TRUE(encoder.finish().empty());
        EXPECT_EQ(memo.pictures.size(), keys.size());
    };
    preview_of({"sky", "cloud"});
    preview_of({"sky", "cloud"});
    EXPECT_EQ(made, 2);
    preview_of({"sky"});
    preview_of({"sky", "cloud"});
    EXPECT_EQ(made, 3) << "what the last preview did not show is forgotten";
}

TEST(PictureEncoder, KeepsAllPicturesButTheLastOfAnInterruptedPreview) {
    PictureMemo memo;
    int made = 0;
    const auto encode = [&](PictureEncoder& encoder, const std::string& key) {
        encoder.encode(key, [&] {
            ++made;
            return std::vector{picture(key)};
        });
    };
    PictureEncoder interrupted(1, &memo);
    encode(interrupted, "sky");
    encode(interrupted, "cloud");
    interrupted.give_up();
    EXPECT_TRUE(memo.pictures.empty());
    PictureEncoder next(1, &memo);
    encode(next, "sky");
    EXPECT_EQ(made, 2);
    encode(next, "cloud");
    EXPECT_EQ(made, 3);
    EXPECT_TRUE(next.finish().empty());
    EXPECT_EQ(memo.pictures.size(), 2U);
    EXPECT_TRUE(memo.unfinished.empty());
}

}  // namespace
}  // namespace skybake
