#include "config/recipe/merge.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "config/diagnostics/toml_source.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

Table table_of(const std::string& text) {
    const Source source{Source::Kind::file, 0, "test.toml", text};
    DiagnosticList list;
    std::optional<Table> table = parse_toml(source, list);
    EXPECT_TRUE(table) << text;
    return table ? std::move(*table) : Table{};
}

std::string spelled(Table table) { return value_to_string(Value{std::move(table), {}}); }

// What becomes of the keys of a section that a later source gives, too.
std::string merged(const std::string& base, const std::string& over,
                   const std::string& section = "") {
    const std::string head = section.empty() ? "" : "[" + section + "]\n";
    Table result = table_of(head + base);
    merge(result, table_of(head + over));
    const Table* table = &result;
    for (const std::string& name : split_path(section).value_or(std::vector<std::string>{})) {
        table = as_table(find_entry(*table, name)->value);
    }
    return spelled(*table);
}

std::string merged_layer(const std::string& base, const std::string& over) {
    return merged(base, over, "atmosphere.layers.x");
}
std::string merged_bake(const std::string& base, const std::string& over) {
    return merged(base, over, "bake.transmittance");
}
std::string merged_channel(const std::string& base, const std::string& over) {
    return merged(base, over, "noise.n.channels.R");
}

TEST(Merge, TablesMergeKeyByKeyAndArraysReplace) {
    EXPECT_EQ(merged("a = 1\nb = 2", "b = 3\nc = 4"), "{ a = 1, b = 3, c = 4 }");
    EXPECT_EQ(merged("[t]\na = 1\nb = 2", "[t]\nb = 3"), "{ t = { a = 1, b = 3 } }");
    EXPECT_EQ(merged("a = [1, 2, 3]", "a = [4]"), "{ a = [4] }");
    EXPECT_EQ(merged("a = 1", "[a]\nb = 2"), "{ a = { b = 2 } }");
    EXPECT_EQ(merged("[a]\nb = 2", "a = 1"), "{ a = 1 }");
}

TEST(Merge, ATableThatStandsForAnArrayReplaces) {
    Table base = table_of("a.x = 1");
    Table over = table_of("a.y = 2");
    find_entry(over, "a")->value.replaces = true;
    merge(base, over);
    EXPECT_EQ(spelled(base), "{ a = { y = 2 } }");
    Table more = table_of("a.z = 3");
    merge(base, more);
    EXPECT_EQ(spelled(base), "{ a = { y = 2, z = 3 } }");
    EXPECT_TRUE(find_entry(base, "a")->value.replaces) << "what lies below it stays replaced";
}

TEST(Merge, TakingAwayWhatKeysNeedDropsThem) {
    EXPECT_EQ(merged("detail = 'd'\nerosion = 1\nthreshold = 1", "detail = ''", "clouds.c"),
              "{ detail = \"\", threshold = 1 }");
    EXPECT_EQ(merged("detail = 'd'\nerosion = 1", "detail = 'e'", "clouds.c"),
              "{ detail = \"e\", erosion = 1 }");
}

TEST(Merge, AnExclusiveKeyDropsTheOthers) {
    EXPECT_EQ(merged_layer("extinction = 1", "absorption = 2"), "{ absorption = 2 }");
    EXPECT_EQ(merged_layer("absorption = 1", "single_scattering_albedo = 2"),
              "{ single_scattering_albedo = 2 }");
    EXPECT_EQ(merged_layer("extinction = 1\nscattering = 3", "extinction = 2"),
              "{ extinction = 2, scattering = 3 }");
    EXPECT_EQ(merged_bake("size = 1", "max_error = 2"), "{ max_error = 2 }");
    EXPECT_EQ(merged_bake("max_error = 1", "size = 2"), "{ size = 2 }");
}

TEST(Merge, AnotherProfileOrPhaseDropsTheKeysOfTheOldOne) {
    EXPECT_EQ(merged_layer("profile = 'exponential'\nscale_height = 1", "profile = 'tent'"),
              "{ profile = \"tent\" }");
    EXPECT_EQ(merged_layer("profile = 'tent'\nhalf_width = 1", "profile = 'tent'"),
              "{ half_width = 1, profile = \"tent\" }");
    EXPECT_EQ(merged_layer("phase = 'cornette_shanks'\ng = 1", "phase = 'rayleigh'"),
              "{ phase = \"rayleigh\" }");
    EXPECT_EQ(merged_layer("phase = 'cornette_shanks'\ng = 1", "phase = 'henyey_greenstein'"),
              "{ g = 1, phase = \"henyey_greenstein\" }");
}

TEST(Merge, AListOfFrequenciesAndASeriesDropEachOther) {
    EXPECT_EQ(merged_channel("frequency = 1\noctaves = 2\nlacunarity = 3", "frequencies = [4]"),
              "{ frequencies = [4] }");
    EXPECT_EQ(merged_channel("frequencies = [4]", "octaves = 2"), "{ octaves = 2 }");
    EXPECT_EQ(merged_channel("frequency = 1\noctaves = 2", "octaves = 3"),
              "{ frequency = 1, octaves = 3 }");
    EXPECT_EQ(merged_channel("gain = 1\nfrequency = 2", "gains = [1]"),
              "{ frequency = 2, gains = [1] }");
    EXPECT_EQ(merged_channel("type = 'perlin_worley'\nworley_gain = 1\nfrequency = 3\nfractal = 2",
                             "type = 'worley'"),
              "{ frequency = 3, type = \"worley\" }");
}

TEST(Merge, AnotherAssetStartsItsSectionAfresh) {
    EXPECT_EQ(merged_bake("size = 1\ncontent = 2", "asset = 'multiple_scattering'"),
              "{ asset = \"multiple_scattering\" }");
    EXPECT_EQ(merged_bake("size = 1", "asset = 'transmittance'"),
              "{ asset = \"transmittance\", size = 1 }");
}

TEST(Merge, LayersOfDifferentNamesDoNotTouch) {
    EXPECT_EQ(
        merged("[atmosphere.layers.a]\nextinction = 1", "[atmosphere.layers.b]\nabsorption = 2"),
        "{ atmosphere = { layers = { a = { extinction = 1 }, b = { absorption = 2 } } } }");
}

// Random tables of plain keys: no key excludes another.
Table any_table(int depth) {
    Table table;
    for (const char* key : {"a", "b", "c"}) {
        const int what = *rc::gen::inRange(0, depth > 0 ? 3 : 2);
        if (what == 0) continue;
        Value value;
        if (what == 1) value.data = std::int64_t{*rc::gen::inRange(0, 9)};
        if (what == 2) value.data = any_table(depth - 1);
        table.push_back({key, {}, value});
    }
    return table;
}

TEST(Merge, IsAssociativeForTablesAndIdempotent) {
    EXPECT_TRUE(rc::check("(a + b) + c == a + (b + c) where tables stay tables", [] {
        // A number between two tables forgets what the first one said, in one order only, so the
        // law is asked of tables of one shape.
        const Table a = any_table(0);
        const Table b = any_table(0);
        const Table c = any_table(0);
        Table left = a;
        merge(left, b);
        merge(left, c);
        Table right = b;
        merge(right, c);
        Table sum = a;
        merge(sum, right);
        RC_ASSERT(spelled(left) == spelled(sum));
    }));
    EXPECT_TRUE(rc::check("a + a == a, and nothing is a neutral element", [] {
        const Table a = any_table(3);
        Table twice = a;
        merge(twice, a);
        RC_ASSERT(spelled(twice) == spelled(a));
        Table over_nothing;
        merge(over_nothing, a);
        RC_ASSERT(spelled(over_nothing) == spelled(a));
        Table with_nothing = a;
        merge(with_nothing, {});
        RC_ASSERT(spelled(with_nothing) == spelled(a));
    }));
    EXPECT_TRUE(rc::check("the result is sorted, and the later source wins", [] {
        Table sum = any_table(3);
        const Table over = any_table(3);
        merge(sum, over);
        for (std::size_t i = 1; i < sum.size(); ++i) RC_ASSERT(sum[i - 1].key < sum[i].key);
        for (const Entry& entry : over) {
            if (as_table(entry.value)) continue;
            RC_ASSERT(value_to_string(find_entry(sum, entry.key)->value) ==
                      value_to_string(entry.value));
        }
    }));
}

}  // namespace
}  // namespace skybake::config
