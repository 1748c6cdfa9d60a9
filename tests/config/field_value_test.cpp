#include "config/fields/field_value.h"

#include <gtest/gtest.h>

#include <limits>

#include "config/fields/fields.h"

namespace skybake::config {
namespace {

TEST(FieldValue, SpellsInBaseUnits) {
    constexpr Choice choices[] = {{0, "one", ""}, {1, "two", ""}};
    const Field choice{.key = "x", .kind = Kind::choice, .choices = choices};
    const Field length{.key = "x", .kind = Kind::length};
    const Field coefficients{.key = "x", .kind = Kind::coefficients};
    const Field wavelengths{.key = "x", .kind = Kind::wavelengths};
    EXPECT_EQ(canonical_text(choice, ChoiceIndex{1}), "\"two\"");
    EXPECT_EQ(canonical_text(length, 1500.0), "\"1500 m\"");
    EXPECT_EQ(canonical_text(coefficients, std::vector<double>{1e-6, 0}),
              "[\"1e-06 /m\", \"0 /m\"]");
    EXPECT_EQ(canonical_text(wavelengths, std::vector<double>{5.5e-7}), "[\"550 nm\"]");
    EXPECT_EQ(canonical_text(length, std::string("a\"b")), "\"a\\\"b\"");
    EXPECT_EQ(canonical_text(length, std::vector<DensityPoint>{{{0}, 1}, {{10}, 0.5}}),
              "[[\"0 m\", 1], [\"10 m\", 0.5]]");
}

TEST(FieldValue, SpellsWhatNoisesHave) {
    constexpr Choice choices[] = {{0, "one", ""}, {1, "two", ""}};
    const Field list{.key = "x", .kind = Kind::choice_list, .choices = choices};
    const Field voxels{.key = "x", .kind = Kind::voxels};
    const Field frequency{.key = "x", .kind = Kind::frequency};
    const Field seed{.key = "x", .kind = Kind::seed};
    const Field remap{.key = "x", .kind = Kind::remap};
    const Field clamp{.key = "x", .kind = Kind::clamp};
    using Triple = std::array<int, 3>;
    EXPECT_EQ(canonical_text(list, std::vector{ChoiceIndex{1}, ChoiceIndex{0}}),
              "[\"two\", \"one\"]");
    EXPECT_EQ(canonical_text(voxels, Triple{4, 4, 4}), "[4, 4, 4]");
    EXPECT_EQ(canonical_text(frequency, Triple{4, 4, 4}), "4");
    EXPECT_EQ(canonical_text(frequency, Triple{4, 4, 8}), "[4, 4, 8]");
    EXPECT_EQ(canonical_text(frequency, std::vector{Triple{4, 4, 8}, Triple{9, 9, 9}}),
              "[[4, 4, 8], 9]");
    EXPECT_EQ(canonical_text(remap, std::array<double, 4>{0.25, 1, 0, 1}), "[0.25, 1, 0, 1]");
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(canonical_text(clamp, std::array<double, 2>{0, 1}), "[0, 1]");
    EXPECT_EQ(canonical_text(clamp, std::array<double, 2>{-infinity, infinity}), "false");
    EXPECT_EQ(canonical_text(seed, std::uint64_t{9223372036854775807u}), "9223372036854775807");
    EXPECT_EQ(canonical_text(seed, std::uint64_t{9223372036854775808u}), "\"9223372036854775808\"");
}

TEST(FieldValue, NamesOrigins) {
    const Source file{Source::Kind::file, 0, "earth.toml", ""};
    const Source preset{Source::Kind::preset, 0, "preset earth", ""};
    EXPECT_EQ(origin({&file, 14, 1, 1}), "earth.toml:14");
    EXPECT_EQ(origin({&preset, 14, 1, 1}), "preset earth");
    EXPECT_EQ(origin({}), "");
}

}  // namespace
}  // namespace skybake::config
