#include "config/recipe/recipe.h"

#include <gtest/gtest.h>

namespace skybake::config {
namespace {

std::vector<std::string> texts(std::string_view before, std::string_view after) {
    std::vector<std::string> result;
    for (const ParameterChange& change : parameter_changes(before, after)) {
        result.push_back(change_text(change));
    }
    return result;
}

TEST(ParameterChanges, AreNamedByPath) {
    EXPECT_EQ(texts("[clouds.cumulus]\nthreshold = 0.35\ncoverage = 1\n",
                    "[clouds.cumulus]\nthreshold = 0.4\ncoverage = 1\n"),
              std::vector<std::string>{"clouds.cumulus.threshold 0.35 → 0.4"});
}

TEST(ParameterChanges, WhatComesAndGoes) {
    EXPECT_EQ(texts("[a]\nb = \"8 km\"\n", "[a]\n\"sea fog\" = [1, 2]\n"),
              (std::vector<std::string>{"a.\"sea fog\" none → [1, 2]", "a.b \"8 km\" → none"}));
}

TEST(ParameterChanges, OfEqualOrUnreadableTexts) {
    EXPECT_EQ(texts("a = 1\n", "# words\na=1"), std::vector<std::string>{});
    EXPECT_EQ(texts("a = = 1\n", "a = 1\n"), std::vector<std::string>{"a none → 1"});
}

}  // namespace
}  // namespace skybake::config
