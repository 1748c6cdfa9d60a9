// Keys of clouds whose towers live and drift, of flipbooks, and of what is made from a sequence.
#include <gtest/gtest.h>

#include "config/assets/asset_kind.h"
#include "config/assets/flipbook.h"
#include "config/sections/frames.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_of;
using testing::cloud_recipe;

const std::string tower = "[[clouds.c.towers]]\ncenter = [0, 0]\nsigma = [1, 1]\namplitude = 1\n";

TEST(TowerLife, IsNoneUnlessItIsGiven) {
    const Cloud plain = cloud_of(tower);
    EXPECT_EQ(plain.period, 0);
    EXPECT_FALSE(plain.towers[0].lives());
    EXPECT_FALSE(towers_move(plain));
    const Cloud given = cloud_of("period = 48\ntime = -3\ndrift = [0.5, -2]\n" + tower +
                                 "life = [0.4, 0.3, 0.2]\nborn = 0.25\ngrows_from = 0.5\n");
    EXPECT_EQ(given.period, 48);
    EXPECT_EQ(given.time, -3);
    EXPECT_EQ(given.drift, (std::array<double, 2>{0.5, -2}));
    EXPECT_EQ(given.towers[0].life, (std::array<double, 3>{0.4, 0.3, 0.2}));
    EXPECT_EQ(given.towers[0].born, 0.25);
    EXPECT_EQ(given.towers[0].grows_from, 0.5);
    EXPECT_TRUE(towers_move(given));
}

// --- Frames -------------------------------------------------------------------------------------

const std::string living = "period = 12\n" + tower + "life = [0.4, 0.3, 0.3]\n";

std::string frames_of(const std::string& cloud, const std::string& keys) {
    return cloud_recipe(cloud) + "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\n" +
           "size = [16, 32, 8]\nframes = 12\n" + keys;
}

TEST(CloudFrames, MoveTheCloud) {
    const Recipe recipe = valid(frames_of("time = 30\n" + living, ""));
    ASSERT_EQ(recipe.parameters.bakes.size(), 12u);
    EXPECT_EQ(at_frame(recipe.parameters, 1).clouds[0].time, 6);
    EXPECT_EQ(at_frame(recipe.parameters, 12).clouds[0].time, 17);
    EXPECT_EQ(at_frame(recipe.parameters, 0).clouds[0].time, 30);
}

// The middle of frame n and the next one is an odd frame of a loop of twice as many.
TEST(CloudFrames, HaveFramesBetweenThem) {
    const Recipe recipe = valid(frames_of("time = 30\n" + living, ""));
    const Parameters between = after_frame(recipe.parameters, 3);
    EXPECT_EQ(between.clouds[0].period, 24);
    EXPECT_EQ(between.clouds[0].time, 2 * 8 + 1);
    EXPECT_EQ(between.noises[0].period, 0) << "what stands still stands still";
}

TEST(CloudFrames, AreNamedInTheirOrder) {
    EXPECT_EQ(frame_name("v", 7, 48), "v_0007");
    EXPECT_EQ(frame_name("v", 9999, 9999), "v_9999");
    EXPECT_EQ(frame_name("v", 7, 10000), "v_00007");
    EXPECT_EQ(sequence_name("a_b_0001"), "a_b");
}

// Only the first frame has the scene, and only it depends on how many follow.
TEST(CloudFrames, HaveOneSceneForAll) {
    const Recipe recipe =
        valid(frames_of(living, "formats = ['vdb', 'usda']\nframes_per_second = 30\n"));
    const AssetFiles& first = files_of(recipe.parameters.bakes[0]);
    EXPECT_EQ(first.formats, (std::vector{FileFormat::vdb, FileFormat::usda}));
    EXPECT_EQ(first.frames, 12);
    EXPECT_EQ(first.frames_per_second, 30);
    for (std::size_t i = 1; i < 12; ++i) {
        const AssetFiles& files = files_of(recipe.parameters.bakes[i]);
        EXPECT_EQ(files.formats, std::vector{FileFormat::vdb});
        EXPECT_EQ(files.frames, 0);
    }
    EXPECT_EQ(files_of(valid(frames_of(living, "")).parameters.bakes[0]).frames, 0)
        << "without a scene no frame knows how many there are";
}

// Occupancy of a sequence is a sequence.
TEST(CloudFrames, AreWhatTheirOccupancyIsMadeFrom) {
    const Recipe recipe = valid(frames_of(living, "[bake.o]\nasset = 'occupancy'\nof = 'v'\n"));
    const Parameters& parameters = recipe.parameters;
    ASSERT_EQ(parameters.bakes.size(), 24u);
    const Bake& seventh = parameters.bakes[18];
    EXPECT_EQ(seventh.name, "o_0007");
    EXPECT_EQ(seventh.as<OccupancyBake>().of, "v_0007");
    EXPECT_EQ(frame_of(parameters, seventh), 7);
    const auto of_one = valid(frames_of(living, "[bake.o]\nasset = 'occupancy'\nof = 'v_0003'\n"));
    ASSERT_EQ(of_one.parameters.bakes.size(), 13u);
    EXPECT_EQ(frame_of(of_one.parameters, of_one.parameters.bakes[12]), 3);
}

// --- Flipbooks ----------------------------------------------------------------------------------

const std::string book = "[bake.b]\nasset = 'flipbook'\nof = 'v'\n";

TEST(Flipbook, HoldsAllFrames) {
    const Recipe recipe = valid(frames_of(living, book));
    ASSERT_EQ(recipe.parameters.bakes.size(), 13u);
    const auto& flipbook = recipe.parameters.bakes[12].as<FlipbookBake>();
    EXPECT_EQ(flipbook.sequence, "v");
    EXPECT_EQ(flipbook.length, 12);
    EXPECT_EQ(flipbook.slice, 4);
    EXPECT_EQ(flipbook.layout, SheetLayout::atlas);
    EXPECT_EQ(first_frame(recipe.parameters, flipbook).name, "v_0001");
    EXPECT_EQ(frame_size(first_frame(recipe.parameters, flipbook)),
              (std::array<int, 3>{16, 32, 8}));
}

}  // namespace
}  // namespace skybake::config
