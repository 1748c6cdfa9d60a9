// [sweep] and --vary: what varies, in which order, how it is spelled, and what is refused.
#include "config/sweep/sweep.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <set>

#include "tests/config/recipes.h"
#include "tests/support/outcomes.h"
#include "tests/support/refused.h"

namespace skybake::config {
namespace {

using testing::codes_and_places;

using Strings = std::vector<std::string>;

const std::string clouds =
    "[noise.n]\n"
    "[noise.n.channels.Y]\ntype = 'worley'\n"
    "[clouds.c]\nnoise = 'n'\nextent = ['6 km', '6 km', '3 km']\n"
    "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [32, 32, 16]\n";

Sweep sweep_of(const std::string& lines) { return valid(clouds + "[sweep]\n" + lines).sweep; }

Strings errors_of(const std::string& lines) {
    // Line 1 is the first of [sweep].
    return codes_and_places(parse("[sweep]\n" + lines + clouds).diagnostics);
}

// The plain values of one axis with one path.
Strings values_of(const Sweep& sweep, std::size_t axis = 0) {
    Strings values;
    for (const auto& row : sweep.axes.at(axis).rows) values.push_back(row.at(0).plain);
    return values;
}

Strings swept(const std::string& line) { return values_of(sweep_of(line)); }

Outcome<Sweep> varied(const std::string& text, const Strings& vary, const Strings& zip = {},
                      const std::optional<std::string>& sobol = {}) {
    const TemporaryFolder folder;
    return load_sweep(folder.write("r.toml", text), {}, {vary, zip, sobol});
}

TEST(Sweep, WithoutATableNothingVaries) {
    const Recipe recipe = valid(clouds);
    EXPECT_EQ(variant_count(recipe.sweep), 0);
    EXPECT_TRUE(swept_paths(recipe.sweep).empty());
}

TEST(Sweep, RangesAreEvenAndWithoutNoise) {
    EXPECT_EQ(swept("'clouds.c.threshold' = { from = 0.2, to = 0.5, count = 7 }"),
              (Strings{"0.2", "0.25", "0.3", "0.35", "0.4", "0.45", "0.5"}));
    EXPECT_EQ(swept("'clouds.c.threshold' = { from = 0, to = 1, count = 4 }"),
              (Strings{"0", "0.33333333333", "0.66666666667", "1"}));
    EXPECT_EQ(swept("'clouds.c.threshold' = { from = 1, to = 0, count = 3 }"),
              (Strings{"1", "0.5", "0"}));
    EXPECT_EQ(
        swept("'clouds.c.base_altitude' = { from = '-0.3 km', to = '0.7 km', count = 11 }").at(3),
        "0 km");
    EXPECT_EQ(swept("'noise.n.seed' = { from = 1, to = 4, count = 4 }"),
              (Strings{"1", "2", "3", "4"}));
}

TEST(Sweep, LogRangesHaveEqualRatios) {
    EXPECT_EQ(swept("'clouds.c.threshold' = { from = 1e-3, to = 1, count = 4, scale = 'log' }"),
              (Strings{"0.001", "0.01", "0.1", "1"}));
    EXPECT_EQ(swept("'noise.n.seed' = { from = 1, to = 64, count = 7, scale = 'log' }"),
              (Strings{"1", "2", "4", "8", "16", "32", "64"}));
}

TEST(Sweep, QuantitiesKeepTheUnitThatTheEndsShare) {
    const Sweep shared =
        sweep_of("'clouds.c.base_altitude' = { from = '1 km', to = '2 km', count = 3 }");
    EXPECT_EQ(values_of(shared), (Strings{"1 km", "1.5 km", "2 km"}));
    EXPECT_EQ(shared.axes[0].rows[1][0].toml, "\"1.5 km\"");
    EXPECT_EQ(swept("'clouds.c.base_altitude' = { from = '500 m', to = '1 km', count = 3 }"),
              (Strings{"500 m", "750 m", "1 km"}));
}

// The ends are as given, all values lie between them in order, and none has more than 12 digits.
void check_range(double from, double to, int count, bool log) {
    const Sweep sweep = sweep_of(
        "'clouds.c.threshold' = { from = " + std::to_string(from) + ", to = " + std::to_string(to) +
        ", count = " + std::to_string(count) + (log ? ", scale = 'log' }" : " }"));
    const Strings values = values_of(sweep);
    RC_ASSERT(values.size() == static_cast<std::size_t>(count));
    double before = std::stod(values[0]);
    RC_ASSERT(std::fabs(before - from) < 1e-9);
    RC_ASSERT(std::fabs(std::stod(values.back()) - to) < 1e-9);
    for (int i = 1; i < count; ++i) {
        const std::string& text = values[static_cast<std::size_t>(i)];
        const double value = std::stod(text);
        const bool in_order = from < to ? value > before : value < before;
        RC_ASSERT(in_order);
        before = value;
        if (i + 1 < count) RC_ASSERT(text.size() <= 17u);  // 12 digits, "0.0000", no more
        const double share = double(i) / (count - 1);
        const double expected =
            log ? from * std::pow(to / from, share) : from + (to - from) * share;
        RC_ASSERT(std::fabs(value - expected) <= 1e-11 * std::max(from, to));
    }
}

TEST(Sweep, RangesStayBetweenTheirEndsInOrder) {
    EXPECT_TRUE(rc::check("ends, order, digits", [] {
        const int from = *rc::gen::inRange(1, 1'000'000);
        const int to = *rc::gen::distinctFrom(rc::gen::inRange(1, 1'000'000), from);
        check_range(from * 1e-4, to * 1e-4, *rc::gen::inRange(2, 60), *rc::gen::arbitrary<bool>());
    }));
}

TEST(Sweep, ListsTakeWhatTheKeyTakes) {
    const Sweep sweep = sweep_of(
        "'bake.v.size' = [[8, 8, 4], [16, 16, 8]]\n"
        "'clouds.c.threshold_at' = ['bake', 'runtime']\n"
        "'clouds.c.base_altitude' = ['1 km', '2000 m']\n"
        "'preset' = ['earth', 'mars']");
    EXPECT_EQ(values_of(sweep, 0), (Strings{"[8, 8, 4]", "[16, 16, 8]"}));
    EXPECT_EQ(values_of(sweep, 1), (Strings{"bake", "runtime"}));
    EXPECT_EQ(sweep.axes[1].rows[1][0].toml, "\"runtime\"");
    EXPECT_EQ(values_of(sweep, 3), (Strings{"earth", "mars"}));
    EXPECT_EQ(variant_count(sweep), 16);
}

TEST(Sweep, AxesCrossInTheOrderOfWritingAndTheLastVariesFastest) {
    const Sweep sweep = sweep_of("'noise.n.seed' = [7, 8]\n'clouds.c.coverage' = [0.1, 0.2, 0.3]");
    EXPECT_EQ(swept_paths(sweep), (Strings{"noise.n.seed", "clouds.c.coverage"}));
    ASSERT_EQ(variant_count(sweep), 6);
    EXPECT_EQ(variant_settings(sweep, 0), (Strings{"noise.n.seed=7", "clouds.c.coverage=0.1"}));
    EXPECT_EQ(variant_settings(sweep, 1), (Strings{"noise.n.seed=7", "clouds.c.coverage=0.2"}));
    EXPECT_EQ(variant_settings(sweep, 3), (Strings{"noise.n.seed=8", "clouds.c.coverage=0.1"}));
    std::set<Strings> all;
    for (int i = 0; i < 6; ++i) all.insert(variant_settings(sweep, i));
    EXPECT_EQ(all.size(), 6u);
}

TEST(Sweep, ZippedPathsWalkTogether) {
    const Sweep sweep = sweep_of(
        "'noise.n.seed' = [7, 8]\n'clouds.c.wisp_height' = [0.5, 0.6]\n"
        "'clouds.c.coverage' = { from = 0.1, to = 0.2, count = 2 }\n"
        "zip = ['noise.n.seed', 'clouds.c.coverage']");
    EXPECT_EQ(swept_paths(sweep),
              (Strings{"noise.n.seed", "clouds.c.coverage", "clouds.c.wisp_height"}));
    ASSERT_EQ(variant_count(sweep), 4);
    EXPECT_EQ(variant_settings(sweep, 3),
              (Strings{"noise.n.seed=8", "clouds.c.coverage=0.2", "clouds.c.wisp_height=0.6"}));
}

TEST(Sweep, SobolPointsCoverTheRangesWithoutACount) {
    const Sweep sweep = sweep_of(
        "'clouds.c.coverage' = { from = 0, to = 1 }\n"
        "'clouds.c.base_altitude' = { from = '1 km', to = '2 km' }\n"
        "'noise.n.seed' = { from = 1, to = 4 }\nsobol = 8");
    ASSERT_EQ(variant_count(sweep), 8);
    EXPECT_EQ(
        variant_settings(sweep, 0),
        (Strings{"clouds.c.coverage=0", "clouds.c.base_altitude=\"1 km\"", "noise.n.seed=1"}));
    EXPECT_EQ(variant_settings(sweep, 2),
              (Strings{"clouds.c.coverage=0.75", "clouds.c.base_altitude=\"1.25 km\"",
                       "noise.n.seed=2"}));
    std::multiset<std::string> seeds;
    for (int i = 0; i < 8; ++i) seeds.insert(variant_values(sweep, i).at(2).plain);
    for (const char* seed : {"1", "2", "3", "4"}) EXPECT_EQ(seeds.count(seed), 2u) << seed;
}

// Whether a value is in range depends on the variant, which fails alone.
TEST(Sweep, ValuesOutOfRangeAreForTheVariants) {
    const TemporaryFolder folder;
    const auto path =
        folder.write("r.toml", clouds + "[sweep]\n'clouds.c.coverage' = [0.5, 1.5]\n");
    const auto sweep = test::without_errors(load_sweep(path, {}, {}));
    EXPECT_TRUE(load_variant(path, {}, sweep, 0).value);
    EXPECT_EQ(test::expect_refused(load_variant(path, {}, sweep, 1), "E0110").where.source,
              "--vary `clouds.c.coverage=1.5`");
}

TEST(Sweep, TooManyVariantsAreRefusedBeforeTheyAreMade) {
    const std::string range = "' = { from = 0.1, to = 1, count = 1000 }\n";
    std::string lines;
    for (const char* key : {"coverage", "threshold", "wisp_height", "edge_softness"}) {
        lines += "'clouds.c." + std::string(key) + range;
    }
    EXPECT_EQ(errors_of(lines), (Strings{"E0137 5:1"}));
    std::string layers;
    std::string sweep;
    for (int i = 0; i < 65; ++i) {
        const std::string name = "noise.n" + std::to_string(i);
        layers += "[" + name + ".channels.Y]\ntype = 'worley'\n";
        sweep += "'" + name + ".seed' = [1]\n";
    }
    const Outcome<Recipe> many = parse("[sweep]\n" + sweep + layers);
    EXPECT_EQ(codes_and_places(many.diagnostics), (Strings{"E0137 66:1"}));
}

TEST(Sweep, TheCommandLineVariesToo) {
    const auto sweep = test::without_errors(
        varied(clouds, {"clouds.c.coverage=0.2:0.8:4", "noise.n.seed=1,2,3",
                        "clouds.c.base_altitude=1 km:100km:3:log", "bake.v.size=[8,8,4],[16,16,8]",
                        "clouds.c.threshold=[0.1, 0.2]"}));
    EXPECT_EQ(variant_count(sweep), 4 * 3 * 3 * 2 * 2);
    EXPECT_EQ(values_of(sweep, 0), (Strings{"0.2", "0.4", "0.6", "0.8"}));
    EXPECT_EQ(values_of(sweep, 2), (Strings{"1 km", "10 km", "100km"}));
    EXPECT_EQ(values_of(sweep, 3), (Strings{"[8, 8, 4]", "[16, 16, 8]"}));
}

// A number that is too large is a count at fault, not the name of a scale.
TEST(Sweep, ACountThatIsNoneIsNamedSo) {
    for (const char* count : {"99999999999999999999", "-1", "2x"}) {
        const auto sweep = varied(clouds, {std::string("clouds.c.coverage=0.1:0.3:") + count});
        ASSERT_EQ(sweep.diagnostics.size(), 1u) << count;
        EXPECT_NE(sweep.diagnostics[0].message.find(".count`"), std::string::npos)
            << sweep.diagnostics[0].message;
    }
}

TEST(Sweep, AnOptionReplacesTheRecipesEntry) {
    const std::string recipe = clouds +
                               "[sweep]\n'clouds.c.coverage' = { from = 0.1, to = 0.4, count = 4, "
                               "scale = 'log' }\n'noise.n.seed' = [1, 2]\n";
    const auto listed = test::without_errors(varied(recipe, {"clouds.c.coverage=0.5,0.6"}));
    EXPECT_EQ(swept_paths(listed), (Strings{"noise.n.seed", "clouds.c.coverage"}));
    EXPECT_EQ(values_of(listed, 1), (Strings{"0.5", "0.6"}));
    const auto ranged = test::without_errors(varied(recipe, {"clouds.c.coverage=0:1:3"}));
    EXPECT_EQ(values_of(ranged, 1), (Strings{"0", "0.5", "1"}));
}

TEST(Sweep, OptionsZipAndSetPoints) {
    const auto sweep = test::without_errors(varied(
        clouds, {"clouds.c.coverage=0.5,0.6", "noise.n.seed=1,2", "clouds.c.threshold=0:0.5"},
        {"clouds.c.coverage,noise.n.seed"}, "4"));
    EXPECT_EQ(variant_count(sweep), 8);
}

TEST(Sweep, MalformedOptionsAreRefused) {
    for (const char* text : {"", "=", "a", "noise.n.seed", "noise.n.seed=", "noise.n.seed=1,,2",
                             "noise.n.seed=1:", "noise.n.seed=1:2:3:4:5",
                             "noise.n.seed=1:2:log:log", "=1,2", "noise..n=1"}) {
        const auto sweep = varied(clouds, {text});
        EXPECT_FALSE(sweep.value) << text;
        EXPECT_EQ(codes_and_places(sweep.diagnostics), (Strings{"E0122 0:0"})) << text;
    }
    const std::string wrong_unit = "clouds.c.base_altitude=1 km:2 deg:3";
    EXPECT_EQ(test::expect_refused(varied(clouds, {wrong_unit}), "E0107").where.source,
              "--vary `" + wrong_unit + "`");
}

// A sweep's values are no part of the parameters: `bake` of such a recipe bakes its own values.
TEST(Sweep, IsNoParameterOfTheRecipe) {
    const Recipe with = valid(clouds + "[sweep]\n'clouds.c.coverage' = [0.25]\n");
    EXPECT_EQ(testing::all_parameters(with), testing::all_parameters(valid(clouds)));
    EXPECT_EQ(with.values.size(), valid(clouds).values.size());
    ASSERT_EQ(with.sweep_values.size(), 1u);
    EXPECT_EQ(with.sweep_values[0].path, "sweep.\"clouds.c.coverage\"");
    EXPECT_EQ(with.sweep_values[0].written, "[0.25]");
}

TEST(Sweep, AVariantIsTheRecipeWithItsValues) {
    const TemporaryFolder folder;
    const auto path = folder.write(
        "r.toml", clouds + "[clouds.\"c=d\"]\nnoise = 'n'\nextent = ['6 km', '6 km', '1 km']\n");
    SweepOptions options;
    options.vary = {"clouds.\"c=d\".coverage=0.25,0.75"};
    const std::vector<std::string> settings = {"noise.n.seed=9"};
    const auto sweep = load_sweep(path, settings, options);
    EXPECT_FALSE(sweep.value && load_variant(path, settings, *sweep.value, 0).value)
        << "names of clouds are bare keys";
    options.vary = {"clouds.c.coverage=0.25,0.75"};
    const auto plain =
        test::without_errors(load_sweep(folder.write("s.toml", clouds), settings, options));
    const auto variant =
        test::without_errors(load_variant(folder.path() / "s.toml", settings, plain, 1));
    EXPECT_EQ(variant.parameters.clouds.at(0).coverage, 0.75);
    EXPECT_EQ(variant.parameters.noises.at(0).seed, 9u);
    EXPECT_TRUE(variant.sweep_values.empty());
}

}  // namespace
}  // namespace skybake::config
