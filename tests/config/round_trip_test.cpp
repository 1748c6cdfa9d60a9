// The parameters that files carry are themselves a recipe of the same things: of every recipe that
// tests bake, which have every key and every choice, of the examples, and of the presets.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "config/assets/assets.h"
#include "config/presets/presets.h"
#include "config/sections/particles.h"
#include "config/sections/volume.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

namespace fs = std::filesystem;

// `aliases` only quietens a warning, so that no file carries it.
Noise without_aliases(Noise noise) {
    noise.aliases = false;
    return noise;
}

std::string to_string(const Bake& bake) {
    std::string text;
    visit_asset(bake, [&text](const auto& asset) {
        if constexpr (requires { testing::to_string(asset); }) text = testing::to_string(asset);
    });
    return bake.name + " " + text;
}

VolumeFile without_place(VolumeFile volume) {
    volume.file_place = {};
    return volume;
}

bool are_equal(const Parameters& one, const Parameters& other) {
    return one.wavelengths == other.wavelengths && one.color == other.color &&
           one.atmosphere == other.atmosphere && one.particles == other.particles &&
           std::ranges::equal(one.volumes, other.volumes, {}, without_place, without_place) &&
           std::ranges::equal(one.noises, other.noises, {}, without_aliases, without_aliases) &&
           std::ranges::equal(one.clouds, other.clouds, {}, testing::without_places,
                              testing::without_places) &&
           std::ranges::equal(one.bakes, other.bakes, {}, to_string, to_string);
}

void expect_round_trip(const std::string& text, const fs::path& folder = {}) {
    const Recipe once = test::without_errors(parse_recipe(text, "test.toml", folder));
    const std::string carried = all_parameters(once);
    const Recipe twice = test::without_errors(parse_recipe(carried, "carried.toml", folder));
    EXPECT_TRUE(are_equal(twice.parameters, once.parameters));
    EXPECT_EQ(all_parameters(twice), carried);
    EXPECT_EQ(carried.find("preset ="), std::string::npos);
}

TEST(RoundTrip, ParametersAreTheSameRecipe) {
    int count = 0;
    for (const fs::path& folder :
         {fs::path(SKYBAKE_EXAMPLES) / "../tests/recipes",
          fs::path(SKYBAKE_EXAMPLES) / "../tests/fuzz/corpus/recipe", fs::path(SKYBAKE_EXAMPLES)}) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            if (entry.path().extension() != ".toml") continue;
            std::ifstream file(entry.path(), std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(file), {}};
            if (!parse_recipe(text, "test.toml", entry.path().parent_path()).value) continue;
            SCOPED_TRACE(entry.path().string());
            expect_round_trip(text, entry.path().parent_path());
            ++count;
        }
    }
    EXPECT_GT(count, 50);
}

TEST(RoundTrip, PresetsAreSpelledOut) {
    for (const Preset& preset : noise_presets()) {
        SCOPED_TRACE(preset.name);
        expect_round_trip("[noise.shape]\npreset = '" + std::string(preset.name) +
                          "'\n[bake.shape]\nasset = 'noise_volume'\nnoise = 'shape'\n");
    }
    for (const Preset& preset : cloud_presets()) {
        SCOPED_TRACE(preset.name);
        expect_round_trip(
            "[noise.shape]\npreset = 'nubis_shape'\n[noise.detail]\npreset = 'nubis_detail'\n"
            "[clouds.c]\npreset = '" +
            std::string(preset.name) +
            "'\n[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [512, 512, 256]\n");
    }
    for (const std::string_view preset : preset_names()) {
        SCOPED_TRACE(preset);
        expect_round_trip("preset = '" + std::string(preset) + "'\n[bake.transmittance]\n");
    }
}

// Every digit counts, and every bit of a seed; towers keep the order of their numbers or names.
TEST(RoundTrip, NothingIsRounded) {
    std::string towers;
    for (const char* name : {"2", "10", "t10", "t9", "0"}) {
        towers += fmt::format(
            "[clouds.c.towers.{}]\ncenter = [0.1234567890123, -0.3]\nsigma = [1e-6, {}]\n"
            "amplitude = {}\nrotation = '-719.99 deg'\ncorrelation = -0.999999\n",
            name, 1.0 / 3, 2.0 / 7);
    }
    expect_round_trip(fmt::format(
        "[noise.n]\nseed = '0xfedcba9876543210'\n[noise.n.channels.Y]\ntype = 'perlin_worley'\n"
        "frequencies = [[1, 2, 3], 5, [8, 8, 8]]\ngains = [{}, 1e-3, 4999.123456789]\n"
        "worley_frequency = 3\nworley_octaves = 3\nworley_gain = {}\nseed = '0x8000000000000001'\n"
        "remap = [-{}, {}, 0.1, 0.7]\nbias = {}\n[noise.d]\npreset = 'nubis_detail'\n"
        "[clouds.c]\nnoise = 'n'\ndetail = 'd'\nerosion = [0.95, {}]\ndetail_scale = [1, 2, 3]\n"
        "extent = ['{} km', '4321.0987 m', '12345 cm']\nextinction_scale = '{} /km'\n"
        "coverage = {}\nthreshold = {}\n[clouds.c.height_profile]\ntype = 'tabulated'\n"
        "table = [[{}, -5], [0.5, {}], [1, 0]]\n{}"
        "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nvoxel_size = '{} m'\n",
        1.0 / 3, 2.0 / 3, 1.0 / 7, 1.0 / 9, 1.0 / 11, 1.0 / 13, 29.0 / 3, 100.0 / 7, 1.0 / 17,
        1.0 / 19, 1.0 / 21, 10.0 / 23, towers, 700.0 / 3));
}

// Different spellings of one thing are the same bytes.
TEST(RoundTrip, EquivalentSpellingsAreOneText) {
    const auto of_cloud = [](const std::string& keys) {
        return all_parameters(valid(testing::cloud_recipe(keys)));
    };
    const std::string one = "center = [0, 0.50]\nsigma = [1, 1]\namplitude = 1\n";
    EXPECT_EQ(of_cloud("[[clouds.c.towers]]\n" + one), of_cloud("[clouds.c.towers.0]\n" + one));
    EXPECT_EQ(of_cloud("extinction_scale = '40 /km'\ncoverage = '50 %'\n"),
              of_cloud("extinction_scale = '0.04 /m'\ncoverage = 0.5\n"));
    EXPECT_EQ(of_cloud("noise_scale = 2\n"), of_cloud("noise_scale = [2, 2, 2]\n"));
    EXPECT_NE(of_cloud("coverage = 0.5\n"), of_cloud("coverage = 0.6\n"));
    const auto of_noise = [](const std::string& keys) {
        return all_parameters(valid(testing::volume_recipe("", "type = 'worley'\n" + keys)));
    };
    EXPECT_EQ(of_noise("frequency = 4\noctaves = 3\n"),
              of_noise("frequencies = [4, [8, 8, 8], 16]\ngains = [1, 0.5, 0.25]\n"));
    EXPECT_NE(of_noise("frequency = 4\n"), of_noise("frequency = 5\n"));
    EXPECT_NE(
        of_noise("frequency = 4\noctaves = 2\n").find("frequencies = [4, 8]\ngains = [1, 0.5]\n"),
        std::string::npos);
}

}  // namespace
}  // namespace skybake::config
