#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "config/fields/field_reader.h"
#include "config/fields/field_value.h"
#include "config/fields/fields.h"
#include "config/fields/roles.h"
#include "config/fields/section_decoder.h"
#include "tests/config/recipes.h"

namespace skybake::config {

namespace {

TEST(Fields, FindsSectionsAndFields) {
    ASSERT_TRUE(find_section("atmosphere.layers.*"));
    EXPECT_TRUE(find_field(*find_section("atmosphere.layers.*"), "g"));
    EXPECT_FALSE(find_field(*find_section("atmosphere"), "g"));
    ASSERT_TRUE(find_section("bake.*", "transmittance"));
    EXPECT_TRUE(find_field(*find_section("bake.*", "transmittance"), "content"));
    EXPECT_FALSE(find_field(*find_section("bake.*", "multiple_scattering"), "layers"));
    EXPECT_EQ(find_section("bake.*"), nullptr);
    EXPECT_EQ(find_section("clouds"), nullptr);
}

TEST(Fields, KnowsTheTablesWithinATable) {
    EXPECT_EQ(subtables(""),
              (std::vector<std::string_view>{"color", "atmosphere", "scene", "preview", "particles",
                                             "noise", "volumes", "clouds", "bake", "sweep"}));
    EXPECT_EQ(subtables("atmosphere"), (std::vector<std::string_view>{"layers"}));
    EXPECT_TRUE(subtables("atmosphere.layers.*").empty());
    EXPECT_EQ(subtables("noise.*"), (std::vector<std::string_view>{"channels"}));
    EXPECT_EQ(asset_names().front(), "transmittance");
    EXPECT_EQ(asset_names().back(), "occupancy");
}

TEST(Fields, KnowsWhereAKeyApplies) {
    const Section& layer = *find_section("atmosphere.layers.*");
    EXPECT_TRUE(applies(*find_field(layer, "g"), "cornette_shanks"));
    EXPECT_FALSE(applies(*find_field(layer, "g"), "rayleigh"));
    EXPECT_TRUE(applies(*find_field(layer, "scattering"), "tent"));
}

TEST(Fields, KnowsWhatExcludesWhat) {
    const Section& channel = *find_section("noise.*.channels.*");
    const auto exclude = [&](std::string_view a, std::string_view b) {
        return exclude_each_other(*find_field(channel, a), *find_field(channel, b));
    };
    EXPECT_TRUE(exclude("frequency", "frequencies"));
    EXPECT_TRUE(exclude("frequencies", "octaves"));
    EXPECT_TRUE(exclude("gain", "gains"));
    EXPECT_FALSE(exclude("frequency", "octaves"));
    EXPECT_FALSE(exclude("frequencies", "frequencies"));
    EXPECT_FALSE(exclude("frequencies", "worley_frequency"));
    EXPECT_FALSE(exclude("type", "value"));
}

TEST(Fields, DescribesRangesAndChoices) {
    const Section& layer = *find_section("atmosphere.layers.*");
    EXPECT_EQ(describe_range(*find_field(layer, "g")), "in (-1, 1)");
    EXPECT_EQ(describe_range(*find_field(layer, "scale_height")), "in [0.001 m, 1e+09 m]");
    EXPECT_EQ(describe_range(*find_field(layer, "phase")), "");
    EXPECT_EQ(describe_choices(*find_field(*find_section("bake.*", "transmittance"), "mapping")),
              "one of `bruneton`, `ue`");
    EXPECT_EQ(describe_field(*find_field(layer, "g")),
              "asymmetry of the phase function: forward above 0, back below; in (-1, 1); "
              "typical haze has 0.76");
}

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

ResolvedValue value_of(const std::string& section, Role role) {
    ResolvedValue value;
    value.section = section;
    value.role = role;
    return value;
}

TEST(ResolvedValue, IsReadBySectionAndRole) {
    const std::array reads = {Read{""}, Read{"atmosphere.layers.*", {Role::geometry, Role::phase}},
                              Read{"noise.\"a.b\"", Roles::all()}};
    const auto read = [&](const std::string& section, Role role) {
        return is_read(value_of(section, role), reads);
    };
    EXPECT_TRUE(read("", Role::content)) << "the recipe as a whole";
    EXPECT_FALSE(read("", Role::usual));
    EXPECT_TRUE(read("atmosphere.layers.mie", Role::geometry));
    EXPECT_TRUE(read("atmosphere.layers.mie", Role::phase));
    EXPECT_FALSE(read("atmosphere.layers.mie", Role::content));
    EXPECT_FALSE(read("atmosphere.layers", Role::geometry));
    EXPECT_FALSE(read("atmosphere", Role::geometry));
    for (const Role role : {Role::content, Role::files, Role::usual}) {
        EXPECT_TRUE(read("noise.\"a.b\"", role));
    }
    EXPECT_FALSE(read("noise.a.b", Role::content)) << "a channel of another noise";
    EXPECT_FALSE(is_read(value_of("", Role::content), {}));
}

TEST(SectionDecoder, ValuesKnowTheirOrigin) {
    const Recipe recipe =
        valid("preset = 'earth_hillaire'\n[atmosphere.layers.mie]\ng = 0.7\n[bake.transmittance]\n",
              {"atmosphere.ground_albedo=0.1"});
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.mie.g").origin, "test.toml:3");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.mie.phase").origin, "preset earth_hillaire");
    EXPECT_EQ(value_at(recipe, "atmosphere.ground_albedo").origin,
              "--set `atmosphere.ground_albedo=0.1`");
    EXPECT_EQ(value_at(recipe, "bake.transmittance.size").origin, "default");
    EXPECT_EQ(value_at(recipe, "bake.transmittance.size").written, "[256, 64]");
    EXPECT_EQ(value_at(recipe, "bake.transmittance.asset").written, "\"transmittance\"");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.rayleigh.extinction").origin, "derived");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.rayleigh.scale_height").written, "\"8 km\"");
    EXPECT_EQ(value_at(recipe, "atmosphere.layers.rayleigh.scale_height").canonical, "\"8000 m\"");
    EXPECT_TRUE(value_at(recipe, "preset").only_shown);
}

// The tables as data: what every row must have.

TEST(FieldTables, KeysAreUniqueAndDocumented) {
    for (const Section& section : sections()) {
        std::set<std::string_view> keys;
        for (const Field& field : section.fields) {
            EXPECT_TRUE(keys.insert(field.key).second) << section.path << '.' << field.key;
            EXPECT_FALSE(field.documentation.empty()) << field.key;
            EXPECT_NE(field.documentation.back(), '.') << field.key;
            const bool chooses = field.kind == Kind::choice || field.kind == Kind::choice_list;
            const bool may_choose = chooses || field.kind == Kind::albedo;
            EXPECT_EQ(may_choose, !field.choices.empty()) << field.key;
            EXPECT_FALSE(!field.exclusive_side.empty() && field.exclusive_group.empty());
            EXPECT_FALSE(field.required && !field.fallback.empty()) << field.key;
            EXPECT_LE(field.range.minimum, field.range.maximum) << field.key;
        }
    }
}

// Kinds are told apart by their words.
TEST(FieldTables, KindsHaveWordsOfTheirOwn) {
    std::map<std::string_view, const ValueKind*> kinds;
    for (const Section& section : sections()) {
        for (const Field& field : section.fields) {
            const ValueKind& kind = field.kind;
            EXPECT_FALSE(kind.words.empty()) << field.key;
            EXPECT_TRUE(kind.read && kind.schema) << field.key;
            const ValueKind& known = *kinds.emplace(kind.words, &kind).first->second;
            EXPECT_TRUE(kind.read == known.read && kind.scale == known.scale) << kind.words;
            EXPECT_TRUE(kind.schema == known.schema && kind.most == known.most) << kind.words;
        }
    }
}

TEST(FieldTables, DefaultsAreWhatTheirFieldsTake) {
    for (const Section& section : sections()) {
        for (const Field& field : section.fields) {
            if (field.fallback.empty()) continue;
            EXPECT_TRUE(default_value(field, 3)) << field.key;
        }
    }
}

TEST(FieldTables, SelectorsStandBeforeTheirKeysAndHaveTheirValues) {
    for (const Section& section : sections()) {
        for (auto field = section.fields.begin(); field != section.fields.end(); ++field) {
            const auto needed =
                std::find_if(section.fields.begin(), field,
                             [&](const Field& other) { return other.key == field->needs; });
            EXPECT_EQ(needed == field, field->needs.empty()) << field->key;
            // A key that others need may be missing.
            EXPECT_TRUE(needed == field || needed->kind == Kind::text || needed->fallback.empty())
                << field->key;
            if (field->selector.empty()) continue;
            const auto selector =
                std::find_if(section.fields.begin(), field,
                             [&](const Field& other) { return other.key == field->selector; });
            ASSERT_NE(selector, field) << field->key;
            const std::vector<std::string_view> names = choice_names(*selector);
            for (const std::string_view value : field->selected_by) {
                EXPECT_NE(std::find(names.begin(), names.end(), value), names.end()) << value;
            }
        }
    }
}

// A word stands for one enumerator, and each enumerator has one word.
TEST(FieldTables, ChoicesAreOneEnumeratorEach) {
    for (const Section& section : sections()) {
        for (const Field& field : section.fields) {
            std::set<int> enumerators;
            for (const Choice& choice : field.choices) {
                EXPECT_TRUE(enumerators.insert(choice.enumerator).second)
                    << section.path << '.' << field.key << " = " << choice.name;
                EXPECT_EQ(choice_name(field, choice.enumerator), choice.name);
            }
            if (field.choices.empty()) continue;
            EXPECT_EQ(*enumerators.begin(), 0) << field.key;
            EXPECT_EQ(*enumerators.rbegin() + 1, static_cast<int>(field.choices.size()))
                << field.key;
        }
    }
}

}  // namespace

}  // namespace skybake::config
