#include "config/fields/field_reader.h"

#include <gtest/gtest.h>

#include "config/diagnostics/toml_source.h"

namespace skybake::config {
namespace {

struct ReadResult {
    std::optional<FieldValue> value;
    std::string canonical;
    std::vector<Diagnostic> diagnostics;
};

ReadResult read(const Field& field, std::string_view text, std::optional<int> channels = 3) {
    const std::optional<Value> value = parse_toml_value(text);
    EXPECT_TRUE(value) << text;
    DiagnosticList list;
    ReadResult result;
    result.value = read_field(field, "key", *value, channels, list);
    if (result.value) result.canonical = canonical_text(field, *result.value);
    result.diagnostics = list.take();
    EXPECT_EQ(result.value.has_value(), result.diagnostics.empty()) << text;
    return result;
}

std::string canonical(const Field& field, std::string_view text, std::optional<int> channels = 3) {
    return read(field, text, channels).canonical;
}

std::string code(const Field& field, std::string_view text, std::optional<int> channels = 3) {
    const ReadResult result = read(field, text, channels);
    return result.diagnostics.empty() ? "none" : result.diagnostics[0].code;
}

void expect_code(const Field& field, const char* wanted, std::initializer_list<const char*> texts) {
    for (const char* text : texts) EXPECT_EQ(code(field, text), wanted) << text;
}

constexpr Field length{.key = "l", .kind = Kind::length, .range = {0, 1e6}};
constexpr Field number{.key = "n", .kind = Kind::number, .range = {-1, 1, true, true}};
constexpr Field fraction{.key = "f", .kind = Kind::fraction, .range = {0, 1}};
constexpr Field coefficients{.key = "c", .kind = Kind::coefficients, .range = {0, 1}};
constexpr Field albedo{.key = "a", .kind = Kind::fractions, .range = {0, 1}};
constexpr Field wavelengths{.key = "w", .kind = Kind::wavelengths, .range = {1e-8, 1e-3}};
constexpr Field size{.key = "s", .kind = Kind::size, .range = {1, 16384}};
constexpr Field table{.key = "t", .kind = Kind::density_table, .range = {0, 10}};
constexpr Field words{.key = "x", .kind = Kind::text_list};
constexpr Field flag{.key = "b", .kind = Kind::flag};
constexpr Field angle{.key = "r", .kind = Kind::angle, .range = {-10, 10}};
constexpr Field coefficient{.key = "e", .kind = Kind::coefficient, .range = {0, 1}};
constexpr Field lengths{.key = "d", .kind = Kind::lengths, .range = {0, 1e6}};
constexpr Field pair{.key = "p", .kind = Kind::pair, .range = {-5, 5}};
constexpr Field bounds{.key = "o", .kind = Kind::bounds, .range = {-5, 5}};
constexpr Field heights{.key = "h", .kind = Kind::height_table, .range = {0, 10}};
constexpr Field power{.key = "2", .kind = Kind::power_of_two, .range = {1, 16}};
constexpr Field zero_or_more{
    .key = "z", .kind = Kind::number, .range = {.minimum = 0.5, .maximum = 1, .or_zero = true}};

TEST(FieldReader, SpellsEqualValuesAlike) {
    for (const char* text : {"\"8 km\"", "\"8000 m\"", "\"8e3 m\"", "\"800000 cm\""}) {
        EXPECT_EQ(canonical(length, text), "\"8000 m\"");
    }
    EXPECT_EQ(canonical(number, "0.50"), "0.5");
    EXPECT_EQ(canonical(number, "-0.0"), "0");
    EXPECT_EQ(canonical(fraction, "\"0.2 %\""), canonical(fraction, "0.002"));
    EXPECT_EQ(canonical(wavelengths, "\"0.55 um\""), "[\"550 nm\"]");
    EXPECT_EQ(canonical(size, "[256, 64]"), "[256, 64]");
    EXPECT_EQ(canonical(table, "[[\"0 km\", 1], [\"2 km\", 0.5]]"),
              "[[\"0 m\", 1], [\"2000 m\", 0.5]]");
    EXPECT_EQ(canonical(words, "\"a\""), "[\"a\"]");
    EXPECT_EQ(canonical(flag, "false"), "false");
}

TEST(FieldReader, OneValueStandsForAllChannels) {
    EXPECT_EQ(canonical(albedo, "0.3"), "[0.3, 0.3, 0.3]");
    EXPECT_EQ(canonical(albedo, "[0.3]"), "[0.3, 0.3, 0.3]");
    EXPECT_EQ(canonical(albedo, "[0.1, \"20 %\", 0.3]"), "[0.1, 0.2, 0.3]");
    EXPECT_EQ(canonical(albedo, "0.3", 1), "[0.3]");
    EXPECT_EQ(code(albedo, "[0.1, 0.2]"), "E0108");
    EXPECT_EQ(code(albedo, "[]"), "E0108");
    EXPECT_EQ(code(albedo, "[0.1, 0.2, 0.3]", 1), "E0108");
    EXPECT_EQ(code(albedo, "[0.1, 0.2, 0.3, 0.4]"), "E0108");
    EXPECT_EQ(canonical(albedo, "[0.1, 0.2]", std::nullopt), "[0.1, 0.2]");
}

TEST(FieldReader, ChecksDimensions) {
    expect_code(length, "E0107", {"\"40 deg\"", "\"4 /m\"", "8000", "\"8000\""});
    expect_code(coefficients, "E0107", {"\"4e-6 m\"", "0"});
    expect_code(number, "E0107", {"\"0.5 km\"", "\"50 %\""});
    expect_code(fraction, "E0107", {"\"1 km\""});
}

TEST(FieldReader, ChecksTypes) {
    expect_code(length, "E0103", {"true", "[\"8 km\"]"});
    expect_code(number, "E0103", {"\"0.5\"", "1979-05-27", "{ a = 1 }"});
    expect_code(fraction, "E0103", {"\"0.5\""});
    expect_code(size, "E0103", {"256", "[256.0, 64]"});
    expect_code(flag, "E0103", {"1", "\"true\""});
    expect_code(words, "E0103", {"[1]"});
    expect_code(table, "E0103", {"1"});
}

TEST(FieldReader, ChecksRangesAndFiniteness) {
    expect_code(length, "E0110", {"\"-1 m\"", "inf"});
    expect_code(number, "E0110", {"1", "-1.0", "nan"});
    expect_code(fraction, "E0110", {"\"101 %\""});
    expect_code(size, "E0110", {"[0, 64]", "[1000000000, 64]", "[-9223372036854775808, 64]"});
    expect_code(size, "E0108", {"[1, 2, 3]"});
    expect_code(length, "E0106", {"\"1e999 m\"", "\"nan m\"", "\"8 kn\"", "\"\""});
}

TEST(FieldReader, ChecksDensityTables) {
    expect_code(
        table, "E0114",
        {"[]", "[[\"0 km\", 1]]", "[[\"0 km\", 1], [\"0 km\", 1]]",
         "[[\"2 km\", 1], [\"1 km\", 1]]", "[[\"0 km\", 1], [\"1 km\"]]", "[[\"0 km\", 1], 5]"});
    expect_code(table, "E0110",
                {"[[\"-1 km\", 1], [\"1 km\", 1]]", "[[\"0 km\", -1], [\"1 km\", 1]]"});
    expect_code(table, "E0107", {"[[0, 1], [\"1 km\", 1]]"});
}

TEST(FieldReader, ReadsWhatCloudsAreMadeOf) {
    EXPECT_EQ(canonical(angle, "\"180 deg\""), "\"3.141592653589793 rad\"");
    EXPECT_EQ(code(angle, "\"1 m\""), "E0107");
    EXPECT_EQ(code(angle, "1"), "E0107");
    EXPECT_EQ(canonical(coefficient, "\"40 /km\""), "\"0.04 /m\"");
    EXPECT_EQ(code(coefficient, "[\"40 /km\"]"), "E0103");
    EXPECT_EQ(canonical(lengths, "[\"1 km\", \"2 m\", \"3 cm\"]"),
              "[\"1000 m\", \"2 m\", \"0.03 m\"]");
    EXPECT_EQ(code(lengths, "[\"1 km\", \"2 m\"]"), "E0108");
    EXPECT_EQ(code(lengths, "\"1 km\""), "E0103");
    EXPECT_EQ(canonical(pair, "[2, -0.50]"), "[2, -0.5]");
    EXPECT_EQ(code(pair, "[2, 3, 4]"), "E0108");
    EXPECT_EQ(code(pair, "[2, inf]"), "E0110");
    EXPECT_EQ(canonical(bounds, "[1, 1]"), "[1, 1]");
    EXPECT_EQ(code(bounds, "[2, 1]"), "E0113");
    EXPECT_EQ(canonical(heights, "[[0, 1], [0.50, 2]]"), "[[0, 1], [0.5, 2]]");
    EXPECT_EQ(code(heights, "[[0, 1], [1.1, 2]]"), "E0110");
    EXPECT_EQ(canonical(power, "8"), "8");
    EXPECT_EQ(code(power, "6"), "E0110");
    EXPECT_EQ(code(power, "32"), "E0110");
    EXPECT_EQ(canonical(zero_or_more, "-0.0"), "0");
    EXPECT_EQ(canonical(zero_or_more, "0.5"), "0.5");
    EXPECT_EQ(code(zero_or_more, "0.4"), "E0110");
    EXPECT_EQ(code(zero_or_more, "nan"), "E0110");
}

TEST(FieldReader, SuggestsUnits) {
    const ReadResult result = read(length, "\"8 Km\"");
    ASSERT_EQ(result.diagnostics.size(), 1u);
    EXPECT_EQ(result.diagnostics[0].message, "`key` has an unknown unit: `Km`");
    EXPECT_EQ(result.diagnostics[0].label, "units are case sensitive: write `km`");
    EXPECT_EQ(read(length, "\"0.1..0.5\"").diagnostics[0].label,
              "a range is written FIRST:LAST:COUNT, such as 0.1:0.5:5");
    // Units of other sizes are no hints: a megametre is no millimetre, a mile neither.
    for (const char* text : {"\"8 furlongs\"", "\"5 mi\"", "\"5 Mm\"", "\"5 dm\"", "\"8 mkm\""}) {
        EXPECT_EQ(read(length, text).diagnostics[0].label,
                  "the units here are nm, um, mm, cm, m, km")
            << text;
    }
}

TEST(FieldReader, ReportsEveryItemOfAList) {
    EXPECT_EQ(read(albedo, "[2, nan, 0.5]").diagnostics.size(), 2u);
}

}  // namespace
}  // namespace skybake::config
