// The tables as data: what every row must have.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "config/fields/field_reader.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

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
