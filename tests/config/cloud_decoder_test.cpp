#include <gtest/gtest.h>

#include "config/assets/asset_kind.h"
#include "config/assets/flipbook.h"
#include "config/sections/frames.h"
#include "tests/config/clouds.h"

namespace skybake::config {

namespace {

using testing::cloud_of;
using testing::cloud_recipe;

TEST(CloudDecoder, ReadsEveryKey) {
    const Cloud cloud = cloud_of(
        "noise_scale = [4, 5, 1]\ndetail = 'd'\ndetail_scale = 16\nerosion = [0, 0.95]\n"
        "wisp_height = 1\nbase_altitude = '-1.2 km'\ncoverage = '5 %'\nthreshold = 0.35\n"
        "edge_softness = 0\nthreshold_at = 'runtime'\nchannels = 'noise'\n"
        "extinction_scale = '0 /m'\n"
        "height_profile = { type = 'tabulated', table = [[0, 0.0], [0.25, 2]] }\n"
        "coverage_map = { file = 'maps/../a.png', channel = 'R', wrap = 'clamp', "
        "factor = 2, clamp = true, filter = 'nearest', color_space = 'srgb' }\n"
        "[[clouds.c.towers]]\ncenter = [0.2, -3]\nsigma = [0.03, 0.06]\nrotation = '180 deg'\n"
        "correlation = -0.5\namplitude = 0.4\n");
    Cloud expected;
    expected.name = "c";
    expected.noise = "n";
    expected.noise_scale = {4, 5, 1};
    expected.detail = "d";
    expected.detail_scale = {16, 16, 16};
    expected.erosion = {0, 0.95};
    expected.wisp_height = 1;
    expected.extent = {{{1000}, {2000}, {500}}};
    expected.base_altitude = {-1200};
    expected.height_profile = {HeightProfileType::tabulated, 50, 4, 1, {{0, 0}, {0.25, 2}}};
    expected.coverage = 0.05;
    expected.coverage_map = {"maps/../a.png",
                             "a.png",
                             "R",
                             MapWrap::clamp,
                             MapFilter::nearest,
                             MapColorSpace::srgb,
                             2,
                             true,
                             {},
                             {}};
    expected.threshold = 0.35;
    expected.threshold_at = ThresholdAt::runtime;
    expected.channels = CloudChannels::noise;
    Tower& tower = expected.towers.emplace_back();
    tower.name = "0";
    tower.center = {0.2, -3};
    tower.sigma = {0.03, 0.06};
    tower.rotation = {3.141592653589793};
    tower.correlation = -0.5;
    tower.amplitude = 0.4;
    EXPECT_TRUE(testing::without_places(cloud) == expected);
    const Cloud blended = cloud_of(
        "height_profile = { type = 'blended', cloud_type = 0.5 }\ntype_map = { file = 't.png' }\n");
    EXPECT_EQ(blended.height_profile.cloud_type, 0.5);
    EXPECT_EQ(blended.type_map.path, "t.png");
    EXPECT_EQ(blended.type_map.wrap, MapWrap::repeat);
    EXPECT_EQ(blended.type_map.filter, MapFilter::linear);
}

TEST(CloudDecoder, TowersHaveNames) {
    const Cloud cloud =
        cloud_of("[clouds.c.towers.big]\ncenter = [0, 0]\nsigma = [1, 1]\namplitude = 1\n");
    EXPECT_EQ(cloud.towers.at(0).name, "big");
}

// Maps are looked for as includes are: beside the file that names them.
TEST(CloudDecoder, MapsLieBesideTheirRecipe) {
    const testing::TemporaryFolder folder;
    folder.write("parts/map.toml", "clouds.c.coverage_map.file = '../maps/a.png'\n");
    folder.write("parts/type.toml", "clouds.c.type_map.file = 'b.png'\n");
    const auto file = folder.write(
        "main.toml", "include = ['parts/map.toml', 'parts/type.toml']\n" +
                         cloud_recipe("height_profile.type = 'blended'") +
                         "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]\n");
    const auto outcome =
        load_recipe(file, std::vector<std::string>{"clouds.c.type_map.file=c.png"});
    ASSERT_TRUE(outcome.value);
    const Cloud& cloud = outcome.value->parameters.clouds.at(0);
    EXPECT_EQ(cloud.coverage_map.path, folder.path() / "maps/a.png");
    EXPECT_EQ(cloud.coverage_map.file, "../maps/a.png");
    EXPECT_EQ(cloud.type_map.path, folder.path() / "c.png") << "settings: beside the recipe";
    const auto& inputs = outcome.value->inputs;
    ASSERT_EQ(inputs.size(), 5u);
    EXPECT_EQ(inputs[3], cloud.coverage_map.path);
    EXPECT_EQ(inputs[4], cloud.type_map.path);
}

// Keys of clouds whose towers live and drift, of flipbooks, and of what is made from a sequence.

const std::string tower = "[[clouds.c.towers]]\ncenter = [0, 0]\nsigma = [1, 1]\namplitude = 1\n";

TEST(TowerLife, IsNoneUnlessItIsGiven) {
    const Cloud plain = cloud_of(tower);
    EXPECT_EQ(plain.period, 0);
    EXPECT_FALSE(plain.towers[0].lives());
    EXPECT_FALSE(cloud_moves(plain));
    const Cloud given = cloud_of("period = 48\ntime = -3\ndrift = [0.5, -2]\n" + tower +
                                 "life = [0.4, 0.3, 0.2]\nborn = 0.25\ngrows_from = 0.5\n");
    EXPECT_EQ(given.period, 48);
    EXPECT_EQ(given.time, -3);
    EXPECT_EQ(given.drift, (std::array<double, 2>{0.5, -2}));
    EXPECT_EQ(given.towers[0].life, (std::array<double, 3>{0.4, 0.3, 0.2}));
    EXPECT_EQ(given.towers[0].born, 0.25);
    EXPECT_EQ(given.towers[0].grows_from, 0.5);
    EXPECT_TRUE(cloud_moves(given));
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
