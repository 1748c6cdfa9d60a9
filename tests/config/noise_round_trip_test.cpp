// The parameters that files carry are themselves a recipe of the same noise and the same bake: what
// verification makes voxels from again.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "config/assets/noise_volume.h"
#include "config/presets/presets.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

std::string parameters_of(const Recipe& recipe) {
    const std::vector<std::string> patterns = {"noise.shape.*", "noise.shape.channels.*.*",
                                               "bake.shape.*"};
    return parameters_toml(recipe, patterns);
}

// `aliases` only quietens a warning, so that no file carries it.
Noise without_aliases(Noise noise) {
    noise.aliases = false;
    return noise;
}

bool are_equal(const Parameters& one, const Parameters& other) {
    const auto bake_text = [](const Parameters& parameters) {
        const Bake& bake = parameters.bakes.at(0);
        return bake.name + " " + testing::to_string(bake.as<NoiseVolumeBake>());
    };
    return std::ranges::equal(one.noises, other.noises, {}, without_aliases, without_aliases) &&
           bake_text(one) == bake_text(other);
}

template <class... Names>
std::string any_of(Names... names) {
    return fmt::format("'{}'", *rc::gen::element<std::string>(names...));
}

std::string any_frequency() {
    const auto one = [] { return *rc::gen::inRange(1, 9); };
    if (*rc::gen::arbitrary<bool>()) return fmt::format("{}", one());
    return fmt::format("[{}, {}, {}]", one(), one(), one());
}

double any_number(int least, int most) { return *rc::gen::inRange(least, most) / 977.0; }

// A series or a list, with gains of either kind.
std::string any_octaves(const std::string& prefix) {
    const int count = *rc::gen::inRange(1, 5);
    std::string text;
    std::string gains;
    std::string frequencies;
    for (int i = 0; i < count; ++i) {
        gains += fmt::format("{}, ", any_number(1, 5000));
        frequencies += any_frequency() + ", ";
    }
    if (*rc::gen::arbitrary<bool>()) {
        text += fmt::format("{}frequencies = [{}]\n", prefix, frequencies);
    } else {
        text += fmt::format("{}frequency = {}\n{}octaves = {}\n{}lacunarity = {}\n", prefix,
                            any_frequency(), prefix, count, prefix, *rc::gen::inRange(1, 6));
    }
    return text + (*rc::gen::arbitrary<bool>()
                       ? fmt::format("{}gains = [{}]\n", prefix, gains)
                       : fmt::format("{}gain = {}\n", prefix, any_number(0, 3900)));
}

std::string any_seed() {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    const std::uint64_t high = *rc::gen::arbitrary<bool>() ? seed | 1ull << 63 : seed;
    return fmt::format("'{:#x}'", high);
}

std::string any_channel() {
    const std::string type =
        *rc::gen::element<std::string>("constant", "perlin", "worley", "perlin_worley", "curl");
    const bool has_perlin = type == "perlin" || type == "perlin_worley";
    const bool has_worley = type == "worley" || type == "perlin_worley";
    std::string text = fmt::format("type = '{}'\n", type);
    if (type == "constant") {
        text += fmt::format("value = {}\n", any_number(-1000000, 1000000));
    } else {
        text += any_octaves("") + fmt::format("seed = {}\n", any_seed());
    }
    if (type == "perlin_worley") text += any_octaves("worley_");
    if (has_perlin) text += "fractal = " + any_of("fbm", "rectified", "ridged", "billow") + "\n";
    if (has_worley) {
        text += "feature = " + any_of("f1", "f2", "f2_minus_f1") + "\n" + "value_form = " +
                any_of("distance", "one_minus_distance", "one_minus_distance_over_sqrt3",
                       "one_minus_distance_squared") +
                "\n";
    }
    if (type == "curl") text += "component = " + any_of("x", "y", "z") + "\n";
    if (*rc::gen::arbitrary<bool>()) {
        text += fmt::format("remap = [{}, {}, {}, {}]\n", any_number(-500, 0), any_number(1, 500),
                            any_number(-500, 500), any_number(-500, 500));
    }
    return text +
           fmt::format("invert = {}\nbias = {}\n", *rc::gen::arbitrary<bool>(), any_number(1, 976));
}

std::string any_bake() {
    const bool only_bin = *rc::gen::arbitrary<bool>();
    const auto edge = [] { return *rc::gen::inRange(1, 300); };
    std::string text = "[bake.shape]\nasset = 'noise_volume'\nnoise = 'shape'\n";
    if (*rc::gen::arbitrary<bool>())
        text += fmt::format("size = [{}, {}, {}]\n", edge(), edge(), edge());
    text += only_bin
                ? "formats = 'bin'\npixel_type = " + any_of("float", "half", "unorm8", "unorm16")
                : "formats = ['bin', 'exr', 'vdb']\npixel_type = " + any_of("float", "half");
    text += *rc::gen::arbitrary<bool>() ? "\nlayout = 'atlas'\ncolumns = 1" : "\nlayout = 'stack'";
    return text + "\nmips = " + (*rc::gen::arbitrary<bool>() ? "'all'" : "1") +
           "\ncompression = " + any_of("none", "zip", "zips", "piz") +
           "\nvdb_compression = " + any_of("none", "zip", "blosc") + "\n";
}

std::string any_recipe() {
    const std::string letters = *rc::gen::element<std::string>("Y", "R", "RGB", "RGBA");
    const bool packs = letters == "RGBA" && *rc::gen::arbitrary<bool>();
    const auto edge = [] { return *rc::gen::inRange(1, 300); };
    std::string text =
        fmt::format("[noise.shape]\nseed = {}\nsize = [{}, {}, {}]\nsampling = {}\n", any_seed(),
                    edge(), edge(), edge(), any_of("centers", "corners", "slices_at_corners"));
    if (packs) text += "pack = 'shape'\n";
    for (const char letter : letters) {
        text += fmt::format("[noise.shape.channels.{}]\n", letter) + any_channel();
    }
    return text + any_bake();
}

TEST(NoiseRoundTrip, ParametersAreARecipeOfTheSameNoise) {
    int whole = 0;
    EXPECT_TRUE(rc::check("parse(parameters(recipe)) == recipe", [&] {
        const std::string text = any_recipe();
        const Outcome<Recipe> once = parse(text);
        for (const Diagnostic& diagnostic : once.diagnostics) {
            RC_ASSERT(diagnostic.severity == Severity::warning);
        }
        if (!once.value) return;
        ++whole;
        const std::string carried = parameters_of(*once.value);
        const Outcome<Recipe> twice = parse(carried);
        RC_ASSERT(twice.value.has_value());
        RC_ASSERT(are_equal(twice.value->parameters, once.value->parameters));
        RC_ASSERT(parameters_of(*twice.value) == carried);
    }));
    EXPECT_GT(whole, 60);
}

TEST(NoiseRoundTrip, PresetsAreSpelledOut) {
    for (const Preset& preset : noise_presets()) {
        const Recipe recipe = testing::valid_with_warnings(
            "[noise.shape]\npreset = '" + std::string(preset.name) +
            "'\n[bake.shape]\nasset = 'noise_volume'\nnoise = 'shape'\n");
        const std::string carried = parameters_of(recipe);
        EXPECT_EQ(carried.find("preset"), std::string::npos);
        EXPECT_TRUE(are_equal(testing::valid_with_warnings(carried).parameters, recipe.parameters));
    }
}

// Series and lists that mean the same noise are the same bytes.
TEST(NoiseRoundTrip, EquivalentSpellingsAreOneText) {
    const std::string bake = "[bake.shape]\nasset = 'noise_volume'\nnoise = 'shape'\n";
    const auto text = [&](const std::string& keys) {
        return parameters_of(
            testing::valid("[noise.shape.channels.Y]\ntype = 'worley'\n" + keys + bake));
    };
    EXPECT_EQ(text("frequency = 4\noctaves = 3\n"),
              text("frequencies = [4, [8, 8, 8], 16]\ngains = [1, 0.5, 0.25]\n"));
    EXPECT_NE(text("frequency = 4\n"), text("frequency = 5\n"));
    EXPECT_NE(text("frequency = 4\noctaves = 2\n").find("frequencies = [4, 8]\ngains = [1, 0.5]\n"),
              std::string::npos);
}

// Another noise, another bake and a sky beside them leave a file's parameters alone.
TEST(NoiseRoundTrip, UnrelatedChangesDoNotShow) {
    const std::string text =
        "[noise.shape]\npreset = 'nubis_shape'\n[bake.shape]\nasset = 'noise_volume'\n"
        "noise = 'shape'\n";
    EXPECT_EQ(parameters_of(testing::valid(text)),
              parameters_of(testing::valid("preset = 'earth_hillaire'\n" + text +
                                           "[noise.other]\npreset = 'nubis_detail'\n"
                                           "[bake.transmittance]\n")));
}

}  // namespace
}  // namespace skybake::config
