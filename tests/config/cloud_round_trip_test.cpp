// The parameters that files carry are themselves a recipe of the same cloud, the same volume and
// the same occupancy.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "config/assets/assets.h"
#include "config/presets/presets.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

std::string to_string(const Bake& bake) {
    std::string text = "of the sky";
    visit_asset(bake, [&text](const auto& asset) {
        if constexpr (requires { testing::to_string(asset); }) text = testing::to_string(asset);
    });
    return bake.name + " " + text;
}

bool are_equal(const Parameters& one, const Parameters& other) {
    return one.noises == other.noises &&
           std::ranges::equal(one.clouds, other.clouds, {}, testing::without_places,
                              testing::without_places) &&
           std::ranges::equal(one.bakes, other.bakes, {}, to_string, to_string);
}

bool coin() { return *rc::gen::arbitrary<bool>(); }

double any_number(double low, double high) {
    return low + (high - low) * *rc::gen::inRange(0, 1000) / 999.0;
}

std::string any_pair(double low, double high) {
    return fmt::format("[{}, {}]", any_number(low, high), any_number(low, high));
}

template <class... Names>
std::string any_of(Names... names) {
    return fmt::format("'{}'", *rc::gen::element<std::string>(names...));
}

std::string any_scale() {
    const auto one = [] { return *rc::gen::inRange(1, 5); };
    return coin() ? fmt::format("{}", one()) : fmt::format("[{}, {}, {}]", one(), one(), one());
}

std::string any_map(const std::string& key) {
    std::string text = fmt::format("[clouds.c.{}]\nfile = {}\n", key,
                                   any_of("a.png", "../b c.exr", "/maps/./d.png", "é.png"));
    if (coin()) text += "channel = " + any_of("R", "Y", "coverage") + "\n";
    if (coin()) text += "wrap = " + any_of("repeat", "clamp") + "\n";
    if (coin()) text += "filter = " + any_of("nearest", "linear") + "\n";
    if (coin()) text += "color_space = " + any_of("linear", "srgb") + "\n";
    if (coin()) text += fmt::format("factor = {}\nclamp = true\n", any_number(1, 9));
    return text;
}

std::string any_height_profile() {
    const std::string type = *rc::gen::element<std::string>(
        "thesis", "cumulus", "stratus", "stratocumulus", "blended", "tabulated");
    std::string text = fmt::format("[clouds.c.height_profile]\ntype = '{}'\n", type);
    if (type == "thesis" && coin()) {
        text += fmt::format("bottom_sharpness = {}\ntop_falloff = {}\n", any_number(0, 90),
                            any_number(0, 9));
    }
    if (type == "blended" && coin()) text += fmt::format("cloud_type = {}\n", any_number(0, 1));
    if (type == "tabulated") {
        text += fmt::format("table = [[{}, {}], [{}, {}], [1, 0]]\n", any_number(0, 0.4),
                            any_number(-5, 5), any_number(0.5, 0.9), any_number(0, 5));
    }
    return text + (type == "blended" && coin() ? any_map("type_map") : "");
}

std::string any_tower(const std::string& header) {
    std::string text = header + "\ncenter = " + any_pair(-16, 16) +
                       "\nsigma = " + any_pair(1e-6, 16) +
                       fmt::format("\namplitude = {}\n", any_number(0, 10));
    if (coin()) text += fmt::format("rotation = '{} deg'\n", any_number(-720, 720));
    if (coin()) text += fmt::format("correlation = {}\n", any_number(-0.999999, 0.999999));
    return text;
}

std::string any_lengths(double from, double to) {
    return fmt::format("['{} m', '{} km', '{} m']", any_number(from, to), any_number(from, to),
                       any_number(from, to));
}

std::string any_towers() {
    const bool listed = coin();
    const int count = *rc::gen::inRange(0, 13);
    std::string text;
    for (int i = 0; i < count; ++i) {
        const std::string header =
            listed ? "[[clouds.c.towers]]"
                   : fmt::format("[clouds.c.towers.{}{}]", coin() ? "" : "t", 3 * i);
        text += any_tower(header);
    }
    return text;
}

std::string any_grown_cloud() {
    std::string text = "[clouds.c]\nshape = 'convection'\nextent = " + any_lengths(4, 9) +
                       fmt::format("\n[clouds.c.convection]\ncells = [{}, 30, {}]\n",
                                   *rc::gen::element(8, 30, 40), *rc::gen::inRange(8, 65));
    if (coin()) text += fmt::format("mixed_layer = '{} m'\n", any_number(1, 99));
    if (coin()) text += fmt::format("inversion = '{} km'\n", any_number(0.001, 9));
    if (coin()) text += fmt::format("instability = {}\n", any_number(-20, 20));
    if (coin()) text += fmt::format("temperature = {}\n", any_number(240, 308));
    if (coin()) text += fmt::format("humidity = '{} %'\n", any_number(0, 100));
    if (coin()) text += "wind = " + any_pair(-200, 200) + "\n";
    if (coin()) text += "wind_above = " + any_pair(-200, 200) + "\n";
    if (coin()) text += fmt::format("patches = {}\n", *rc::gen::inRange(0, 10001));
    if (coin()) text += "patch_width = ['3 m', '3 km']\n";
    if (coin()) text += fmt::format("warmth = {}\n", any_number(0, 20));
    if (coin()) text += fmt::format("seed = {}\n", *rc::gen::inRange(0, 1 << 30));
    if (coin()) text += fmt::format("relief = {}\n", any_number(0, 1));
    return text + (coin() ? fmt::format("minutes = {}\n", any_number(0.1, 600)) : "");
}

std::string any_cloud() {
    if (*rc::gen::inRange(0, 4) == 0) return any_grown_cloud();
    std::string text = fmt::format(
        "[clouds.c]\nnoise = {}\nextent = ['{} km', '{} m', '{} cm']\nbase_altitude = '{} m'\n",
        any_of("n", "d"), any_number(4, 99), any_number(4e3, 9.9e4), any_number(0.1, 99),
        any_number(-1e8, 1e8));
    if (coin()) text += "noise_scale = " + any_scale() + "\n";
    if (coin()) text += fmt::format("coverage = '{} %'\n", any_number(0, 100));
    if (coin()) text += fmt::format("threshold = {}\n", any_number(0, 3));
    if (coin()) text += fmt::format("edge_softness = {}\n", coin() ? 0 : any_number(1e-6, 3));
    const bool at_bake = coin();
    if (at_bake && coin()) text += "threshold_at = 'bake'\n";
    if (at_bake && coin()) text += fmt::format("full_at = {}\n", any_number(1e-6, 3));
    if (!at_bake) text += "threshold_at = 'runtime'\n";
    if (coin()) text += "channels = " + any_of("density", "noise") + "\n";
    if (coin()) text += fmt::format("extinction_scale = '{} /km'\n", any_number(0, 99));
    if (coin()) {
        text += fmt::format("detail = 'd'\ndetail_scale = {}\nerosion = {}\nwisp_height = {}\n",
                            any_scale(), any_pair(0, 0.95), any_number(0, 1));
    }
    text += any_height_profile() + any_towers();
    if (coin()) text += any_map("coverage_map");
    return text;
}

std::string any_files(bool has_levels) {
    std::string text =
        coin()
            ? "formats = 'bin'\npixel_type = " + any_of("float", "half", "unorm8", "unorm16") + "\n"
            : "formats = ['vdb', 'exr']\npixel_type = " + any_of("float", "half") + "\n";
    if (coin()) text += "layout = 'atlas'\ncolumns = 1\n";
    if (has_levels) text += "mips = 'all'\n";
    return text + "compression = " + any_of("none", "zip", "zips", "piz") +
           "\nvdb_compression = " + any_of("none", "zip", "blosc") + "\n";
}

std::string any_size() {
    const auto edge = [] { return *rc::gen::inRange(1, 300); };
    return coin() ? fmt::format("size = [{}, {}, {}]\n", edge(), edge(), edge())
                  : fmt::format("voxel_size = '{} m'\n", any_number(7, 900));
}

// Powers of two, which cells and their levels divide.
std::string any_divisible_size() {
    const auto edge = [] { return 1 << *rc::gen::inRange(0, 9); };
    return fmt::format("size = [{}, {}, {}]\n", edge(), edge(), edge());
}

std::string any_bakes() {
    const bool divisible = coin();
    std::string text = "[bake.o]\nasset = 'occupancy'\nof = 'v'\n" + any_files(divisible && coin());
    text += fmt::format("cell = {}\n", divisible ? *rc::gen::element(1, 2, 4, 8, 16) : 1);
    if (coin()) text += "filter = " + any_of("nearest", "trilinear", "tricubic") + "\n";
    if (coin()) text += "rule = " + any_of("exact", "thesis") + "\n";
    if (coin()) text += "contents = ['maximum', 'occupied', 'leap']\n";
    text += "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\n" + any_files(coin());
    return text + (divisible ? any_divisible_size() : any_size());
}

TEST(CloudRoundTrip, ParametersAreARecipeOfTheSameCloud) {
    const std::string noises =
        "[noise.n.channels.Y]\ntype = 'worley'\nfrequency = 2\n[noise.d]\npreset = "
        "'nubis_detail'\n";
    EXPECT_TRUE(rc::check("parse(parameters(recipe)) == recipe", [&] {
        const std::string text = noises + any_cloud() + any_bakes();
        const Outcome<Recipe> once = parse(text);
        RC_LOG() << text;
        for (const Diagnostic& diagnostic : once.diagnostics) {
            RC_LOG() << diagnostic.code << " " << diagnostic.message << "\n";
        }
        RC_ASSERT(once.value.has_value());
        const std::string carried = all_parameters(*once.value);
        const Outcome<Recipe> twice = parse(carried);
        RC_ASSERT(twice.value.has_value());
        RC_ASSERT(are_equal(twice.value->parameters, once.value->parameters));
        RC_ASSERT(all_parameters(*twice.value) == carried);
    }));
}

TEST(CloudRoundTrip, PresetsAreSpelledOut) {
    for (const Preset& preset : cloud_presets()) {
        const Recipe recipe = testing::valid_with_warnings(
            "[noise.shape]\npreset = 'nubis_shape'\n[noise.detail]\npreset = 'nubis_detail'\n"
            "[clouds.c]\npreset = '" +
            std::string(preset.name) +
            "'\n[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [512, 512, 256]\n");
        const std::string carried = all_parameters(recipe);
        EXPECT_EQ(carried.find("preset"), std::string::npos);
        EXPECT_TRUE(are_equal(testing::valid_with_warnings(carried).parameters, recipe.parameters));
    }
}

// Lists and tables that mean the same towers are the same bytes.
TEST(CloudRoundTrip, EquivalentSpellingsAreOneText) {
    const auto text = [](const std::string& keys) {
        return all_parameters(testing::valid(testing::cloud_recipe(keys)));
    };
    const std::string one = "center = [0, 0.50]\nsigma = [1, 1]\namplitude = 1\n";
    EXPECT_EQ(text("[[clouds.c.towers]]\n" + one), text("[clouds.c.towers.0]\n" + one));
    EXPECT_EQ(text("extinction_scale = '40 /km'\ncoverage = '50 %'\n"),
              text("extinction_scale = '0.04 /m'\ncoverage = 0.5\n"));
    EXPECT_EQ(text("noise_scale = 2\n"), text("noise_scale = [2, 2, 2]\n"));
    EXPECT_NE(text("coverage = 0.5\n"), text("coverage = 0.6\n"));
}

}  // namespace
}  // namespace skybake::config
