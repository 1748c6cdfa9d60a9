// Flipbooks hold the frames of a sequence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "bakers/assets/flipbook/flipbook_sequence.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/stored_voxels.h"
#include "config/assets/flipbook.h"
#include "config/recipe/recipe.h"
#include "config/sections/frames.h"
#include "tests/support/atmospheres.h"
#include "tests/support/outcomes.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using test::recipe_of;

Baked baked(const config::Recipe& recipe, const config::Bake& bake,
            Certification certification = Certification::quick) {
    SCOPED_TRACE(bake.name);
    return test::without_errors(
        bake_asset(recipe, bake, {.threads = 2, .certification = certification}));
}

std::vector<std::vector<float>> values_of(const Level& level, const VoxelBox& box,
                                          std::size_t channels) {
    return testing::planes_of(*level.voxels, box, channels);
}

const std::string waves =
    "[noise.n]\nperiod = 6\ndrift = [1, 0, 0]\n[noise.n.channels.R]\ntype = 'perlin'\n"
    "frequency = [3, 2, 2]\n[noise.n.channels.G]\ntype = 'alligator'\nfrequency = [3, 4, 2]\n"
    "[noise.n.channels.B]\ntype = 'worley'\nfrequency = 2\n";

const std::string volume =
    "[bake.v]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [20, 16, 6]\nframes = 6\n";
const std::string map =
    "[bake.v]\nasset = 'weather_map'\nnoise = 'n'\nsize = [20, 16]\ncovered = 0.4\nframes = 6\n"
    "pixel_type = 'float'\nformats = ['exr']\n";
const std::string cloud =
    "[clouds.c]\nnoise = 'n'\nextent = ['2 km', '2 km', '1 km']\nperiod = 6\n"
    "[[clouds.c.towers]]\ncenter = [0.5, 0.5]\nsigma = [0.2, 0.2]\namplitude = 2\n"
    "life = [0.4, 0.3, 0.2]\n"
    "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [20, 16, 6]\nframes = 6\n"
    "pixel_type = 'float'\n";

std::string book(const std::string& keys = "") {
    return "[bake.b]\nasset = 'flipbook'\nof = 'v'\nformats = ['exr']\npixel_type = 'float'\n" +
           keys;
}

// A layer is the frame of its number, bit for bit, and no other.
TEST(Flipbook, HasTheFramesInTheirOrder) {
    for (const std::string& frames : {volume, map, cloud}) {
        const config::Recipe recipe = recipe_of(waves + frames + book());
        const std::vector<config::Bake>& bakes = recipe.parameters.bakes;
        ASSERT_EQ(bakes.size(), 7u);
        const Baked flipbook = baked(recipe, bakes[6]);
        const std::size_t channels = flipbook.channel_names.size();
        ASSERT_EQ(flipbook.levels.at(0).size, (std::array<int, 3>{20, 16, 6}));
        for (int i = 0; i < 6; ++i) {
            const Baked frame = baked(recipe, bakes[static_cast<std::size_t>(i)]);
            const int slice = frame.levels.at(0).size[2] / 2;
            const auto wanted = values_of(frame.levels[0], {{0, 0, slice}, {20, 16, 1}}, channels);
            for (int layer = 0; layer < 6; ++layer) {
                const bool equal =
                    values_of(flipbook.levels[0], {{0, 0, layer}, {20, 16, 1}}, channels) == wanted;
                EXPECT_EQ(equal, layer == i) << layer;
            }
        }
        // Boxes of several layers are their layers.
        const auto both = values_of(flipbook.levels[0], {{3, 2, 2}, {5, 4, 2}}, channels);
        const auto second = values_of(flipbook.levels[0], {{3, 2, 3}, {5, 4, 1}}, channels);
        for (std::size_t c = 0; c < channels; ++c) {
            EXPECT_TRUE(std::equal(second[c].begin(), second[c].end(), both[c].begin() + 20));
        }
    }
}

TEST(Flipbook, TakesTheSliceThatItIsGiven) {
    const config::Recipe recipe = recipe_of(waves + volume + book("slice = 5\n"));
    const Baked flipbook = baked(recipe, recipe.parameters.bakes[6]);
    const Baked frame = baked(recipe, recipe.parameters.bakes[0]);
    EXPECT_EQ(values_of(flipbook.levels.at(0), {{0, 0, 0}, {20, 16, 1}}, 3),
              values_of(frame.levels.at(0), {{0, 0, 5}, {20, 16, 1}}, 3));
}

TEST(Flipbook, RepeatsOnlyIfItsFramesAreALoop) {
    for (const int length : {6, 5, 12}) {
        const config::Recipe recipe =
            recipe_of(waves + map + book("length = " + std::to_string(length) + "\n"));
        const Baked flipbook = baked(recipe, recipe.parameters.bakes[6]);
        EXPECT_EQ(flipbook.axes.at(2).wrap == AxisWrap::repeat, length != 5) << length;
        EXPECT_EQ(flipbook.levels.at(0).repeats[2], length != 5);
    }
}

// The probes tell a sheet that is turned over, shifted by a frame or by a texel, or empty.
TEST(Flipbook, HasProbesThatTellWrongFiles) {
    const config::Recipe recipe = recipe_of(waves + map + book());
    const Baked flipbook = baked(recipe, recipe.parameters.bakes[6]);
    ASSERT_EQ(flipbook.levels.size(), 1u);
    const Level& level = flipbook.levels[0];
    for (const char* wrong : {"zeros", "flip_u", "flip_v", "flip_w", "shift_w", "filter"}) {
        EXPECT_NE(std::find(level.catches.begin(), level.catches.end(), wrong), level.catches.end())
            << wrong;
    }
    for (const std::array<int, 3>& shift : {std::array{0, 0, 1}, {0, 0, 5}, {1, 0, 0}, {0, 1, 0}}) {
        int missed = 0;
        for (const Probe& probe : level.probes) {
            std::array<int, 3> at{};
            for (std::size_t i = 0; i < 3; ++i) {
                const double place = probe.uvw[i] * level.size[i] - 0.5 + shift[i];
                at[i] = (static_cast<int>(std::lround(place)) % level.size[i] + level.size[i]) %
                        level.size[i];
            }
            const auto found = values_of(level, {at, {1, 1, 1}}, 3);
            for (std::size_t c = 0; c < 3; ++c) {
                if (std::fabs(double{found[c][0]} - probe.value[c]) > 0.05) ++missed;
            }
        }
        EXPECT_GT(missed, 3);
    }
}

// The mean of 2 x 2 texels of each layer of a channel by itself.
std::vector<float> halved(const std::vector<float>& finer, std::array<int, 3> size) {
    const auto area = static_cast<std::size_t>(size[0] * size[1]);
    std::vector<float> means;
    for (std::size_t plane = 0; plane * area < finer.size(); ++plane) {
        const float* texels = finer.data() + plane * area;
        for (int y = 0; y + 1 < size[1]; y += 2) {
            for (int x = 0; x + 1 < size[0]; x += 2) {
                const float* at = texels + y * size[0] + x;
                const double sum =
                    double{at[0]} + double{at[1]} + double{at[size[0]]} + double{at[size[0] + 1]};
                means.push_back(static_cast<float>(sum / 4));
            }
        }
    }
    return means;
}

// Each level is the mean of the one before, layer by layer, down to one texel; no frame is mixed with
// another. In levels of a volume they would be.
TEST(Flipbook, HasLevelsThatKeepFramesApart) {
    for (const std::string& frames : {volume, map, cloud}) {
        const config::Recipe recipe =
            recipe_of(waves + frames + book("mapping = 'layers'\nmips = 3\n"));
        const Baked flipbook = baked(recipe, recipe.parameters.bakes[6]);
        const std::size_t channels = flipbook.channel_names.size();
        EXPECT_EQ(flipbook.mapping, "layers");
        ASSERT_EQ(flipbook.levels.size(), 3u);
        for (std::size_t i = 1; i < 3; ++i) {
            const std::array<int, 3> finer = flipbook.levels[i - 1].size;
            ASSERT_EQ(flipbook.levels[i].size, (std::array{finer[0] / 2, finer[1] / 2, 6}));
            const auto before = values_of(flipbook.levels[i - 1], {{}, finer}, channels);
            const auto found =
                values_of(flipbook.levels[i], {{}, flipbook.levels[i].size}, channels);
            for (std::size_t c = 0; c < channels; ++c) {
                const std::vector<float> wanted = halved(before[c], finer);
                ASSERT_EQ(found[c].size(), wanted.size());
                for (std::size_t k = 0; k < wanted.size(); ++k) {
                    ASSERT_NEAR(found[c][k], wanted[k], 1e-7) << i;
                }
            }
            const VoxelBox first{{}, {finer[0] / 2, finer[1] / 2, 1}};
            const MipSource mixed(flipbook.levels[i - 1].voxels, finer, next_mip_size(finer));
            EXPECT_NE(values_of(flipbook.levels[i], first, channels),
                      testing::planes_of(mixed, first, channels));
        }
        EXPECT_FALSE(flipbook.levels[2].probes.empty());
    }
}

// Odd edges, one frame, and levels down to one texel.
TEST(Flipbook, HasLevelsDownToOneTexel) {
    const std::string odd =
        "[bake.v]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [7, 5, 3]\nframes = 6\n";
    const config::Recipe recipe =
        recipe_of(waves + odd + book("mapping = 'layers'\nmips = 'all'\nlength = 1\n"));
    const Baked flipbook = baked(recipe, recipe.parameters.bakes[6]);
    ASSERT_EQ(flipbook.levels.size(), 3u);
    EXPECT_EQ(flipbook.levels[1].size, (std::array{3, 2, 1}));
    EXPECT_EQ(flipbook.levels[2].size, (std::array{1, 1, 1}));
    // Texels of an uneven level are weighed by what they cover, so that the mean stays.
    const auto texels = values_of(flipbook.levels[0], {{}, {7, 5, 1}}, 3);
    const auto last = values_of(flipbook.levels[2], {{}, {1, 1, 1}}, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(last[c][0], std::accumulate(texels[c].begin(), texels[c].end(), 0.0) / 35,
                    1e-6);
    }
}

// The probes of layers that are no loop do not ask for what is before the first or after the last.
TEST(Flipbook, HasProbesWithinLayersThatAreNoLoop) {
    const auto range_of_frames = [](const std::string& keys) {
        const config::Recipe recipe = recipe_of(waves + map + book(keys));
        std::array<double, 2> range{9, -9};
        for (const Probe& probe : baked(recipe, recipe.parameters.bakes[6]).levels.at(0).probes) {
            range[0] = std::min(range[0], probe.at.at(2).second);
            range[1] = std::max(range[1], probe.at.at(2).second);
        }
        return range;
    };
    const std::array<double, 2> layers = range_of_frames("mapping = 'layers'\nlength = 5\n");
    EXPECT_GE(layers[0], 0);
    EXPECT_LE(layers[1], 4);
    const std::array<double, 2> loop = range_of_frames("mapping = 'layers'\n");
    EXPECT_LT(loop[0], 0);
    EXPECT_GT(loop[1], 5);
}

// In a smooth motion the middle of two frames is off by the square of the time between them.
TEST(Flipbook, StatesTheErrorOfBlending) {
    std::array<double, 2> rms{};
    for (const std::size_t i : {0u, 1u}) {
        const std::string frames = i == 0 ? "16" : "32";
        const config::Recipe recipe = recipe_of(
            "[noise.n]\nperiod = " + frames + "\n[noise.n.channels.Y]\ntype = 'perlin'\n" +
            "frequency = [3, 2, 1]\n[bake.v]\nasset = 'noise_volume'\nnoise = 'n'\n" +
            "size = [24, 20, 1]\nframes = " + frames + "\n" + book());
        const Baked flipbook = baked(recipe, recipe.parameters.bakes.back(), Certification::full);
        EXPECT_EQ(flipbook.certificate.texel.max, 0) << "floats are stored as they are";
        EXPECT_EQ(flipbook.certificate.lookup_points, (i == 0 ? 16 : 32) * 24 * 20);
        rms[i] = flipbook.certificate.lookup.rms;
    }
    EXPECT_GT(rms[0], 0.001);
    EXPECT_NEAR(rms[0] / rms[1], 4, 1);
}

// Every frame of a weather map covers the same share, and frame N is frame 0.
TEST(MovingWeather, CoversTheSameShareAndLoops) {
    const config::Recipe recipe = recipe_of(waves + map);
    for (int frame = 1; frame <= 6; ++frame) {
        const auto at = [&](int number) {
            const auto made = make_frame(config::at_frame(recipe.parameters, number),
                                         recipe.parameters.bakes[0], {});
            return values_of(made.value.value().levels[0], {{}, {20, 16, 1}}, 3);
        };
        const auto values = at(frame);
        EXPECT_EQ(at(frame + 6), values);
        EXPECT_NE(at(frame + 1), values);
        for (const std::vector<float>& channel : values) {
            const auto above = std::ranges::count_if(channel, [](float v) { return v > 0; });
            EXPECT_EQ(above, 128) << frame;
        }
    }
}

}  // namespace
}  // namespace skybake
