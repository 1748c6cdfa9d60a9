// Sequences: frames are assets of their own, which are baked again one by one.
#include <algorithm>

#include "bakers/assets/registry/registry.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/workspace/bake_folder.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace {

using namespace skybake::testing;

using States = std::vector<AssetState>;

// A cloud whose tower lives, and what is made of it.
std::string sequence(int frames, const std::string& born = "0.1") {
    return "[noise.n]\nperiod = 8\n[noise.n.channels.Y]\ntype = \"alligator\"\nfrequency = 2\n"
           "[clouds.c]\nnoise = \"n\"\nextent = [\"1 km\", \"1 km\", \"1 km\"]\nperiod = 8\n"
           "[[clouds.c.towers]]\ncenter = [0.5, 0.4]\n"
           "sigma = [0.2, 0.15]\namplitude = 1\nlife = [0.4, 0.2, 0.3]\nborn "
           "= " +
           born + "\n[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [16, 16, 8]\n" +
           "formats = [\"vdb\"]\nframes = " + std::to_string(frames) + "\n";
}

int count(const States& states, AssetState state) {
    return static_cast<int>(std::count(states.begin(), states.end(), state));
}

TEST(Frames, OfALongerSequenceAreKept) {
    const TemporaryFolder folder;
    EXPECT_EQ(count(TestBake(recipe_of(sequence(8)), folder.path()).states(), AssetState::baked),
              8);
    const States longer = TestBake(recipe_of(sequence(16)), folder.path()).states();
    ASSERT_EQ(longer.size(), 16u);
    EXPECT_EQ(count(longer, AssetState::up_to_date), 8);
    EXPECT_EQ(longer[7], AssetState::up_to_date);
    EXPECT_EQ(longer[8], AssetState::baked);
    EXPECT_EQ(
        count(TestBake(recipe_of(sequence(8, "0.2")), folder.path()).states(), AssetState::baked),
        8)
        << "another birth changes all frames";
}

// The scene of a sequence belongs to its first frame, which alone is made again when others follow.
TEST(Frames, WithASceneAreKeptButTheFirst) {
    const TemporaryFolder folder;
    const std::string scene = "formats = [\"vdb\", \"usda\"]\n";
    const auto with_scene = [&](int frames) {
        std::string text = sequence(frames);
        text.replace(text.find("formats = [\"vdb\"]\n"), 18, scene);
        return recipe_of(text);
    };
    TestBake(with_scene(8), folder.path()).states();
    EXPECT_TRUE(std::filesystem::exists(folder / "c.usda"));
    EXPECT_FALSE(std::filesystem::exists(folder / "c_0001.usda"));
    EXPECT_NE(read_bytes(folder / "c.usda").find("8: @./c_0008.vdb@"), std::string::npos);
    const States longer = TestBake(with_scene(16), folder.path()).states();
    EXPECT_NE(longer[0], AssetState::up_to_date);
    EXPECT_EQ(count(longer, AssetState::up_to_date), 7);
    EXPECT_NE(read_bytes(folder / "c.usda").find("16: @./c_0016.vdb@"), std::string::npos);
}

TEST(Frames, GoOnAfterAnInterruption) {
    const TemporaryFolder folder, whole;
    TestBake clean(recipe_of(sequence(8)), whole.path());
    ASSERT_EQ(count(clean.states(), AssetState::baked), 8);
    {
        TestBake bake(recipe_of(sequence(8)), folder.path());
        bake.observer.cancel_at = "c_0004";
        bake.bake.frame_by_frame = true;
        EXPECT_FALSE(bake_folder(bake.bake, bake.observer).value);
        EXPECT_TRUE(std::filesystem::exists(folder / "c_0003.vdb"));
        EXPECT_FALSE(std::filesystem::exists(folder / "c_0004.vdb"));
        EXPECT_EQ(read_manifest(folder.path()).value->assets.size(), 3u);
    }
    TestBake again(recipe_of(sequence(8)), folder.path());
    again.bake.frame_by_frame = true;
    const auto outcome = bake_folder(again.bake, again.observer);
    ASSERT_TRUE(outcome.value);
    EXPECT_TRUE(outcome.diagnostics.empty()) << "nothing is said of frames that are to come";
    ASSERT_EQ(outcome.value->assets.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(outcome.value->assets[i].state,
                  i < 3 ? AssetState::up_to_date : AssetState::baked);
    }
    ASSERT_EQ(again.observer.reasons.size(), 8u) << "the plan is told once";
    for (int frame = 1; frame <= 8; ++frame) {
        const std::string file = "c_000" + std::to_string(frame) + ".vdb";
        EXPECT_EQ(read_bytes(folder / file), read_bytes(whole / file)) << file;
    }
}

// One plan and one manifest for all frames: otherwise a sequence costs the square of its frames.
TEST(Frames, ShareOneManifest) {
    const TemporaryFolder folder;
    TestBake bake(recipe_of(sequence(8)), folder.path());
    bake.bake.frame_by_frame = true;
    ASSERT_TRUE(bake.run().value);
    EXPECT_EQ(std::count(bake.observer.begun.begin(), bake.observer.begun.end(), "manifest.json"),
              1);
    EXPECT_EQ(read_manifest(folder.path()).value->assets.size(), 8U);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()),
                            std::filesystem::directory_iterator()),
              9);
}

// An asset that is made of a frame is made of that frame's voxels.
TEST(Frames, HaveGridsOfTheirOwn) {
    const std::string grids =
        "[bake.o]\nasset = \"occupancy\"\nof = \"c\"\ncell = 2\ncontents = [\"maximum\"]\n"
        "pixel_type = \"float\"\n";
    const config::Recipe recipe = recipe_of(sequence(8) + grids);
    ASSERT_EQ(recipe.parameters.bakes.size(), 16u);
    const auto largest = [&](std::size_t index) {
        BakeOptions options;
        options.threads = 1;
        options.certification = Certification::off;
        const auto baked = bake_asset(recipe, recipe.parameters.bakes[index], options);
        return baked.value ? baked.value->levels[0].statistics[0].max : -1;
    };
    for (std::size_t frame : {1u, 4u, 6u}) {
        const double volume = largest(frame);
        EXPECT_GT(volume, 0);
        // A filtered sample is at most the largest voxel, which half of the cells hold.
        EXPECT_NEAR(largest(8 + frame), volume, 1e-3 * volume) << frame;
    }
    EXPECT_NE(largest(8 + 1), largest(8 + 4));
}

}  // namespace
}  // namespace skybake
