// The demands of fuzzing on every recipe hold for the recipes that fuzzing begins with, and for the
// examples. A property that a new kind of value breaks is found here, before any fuzzer runs.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "config/recipe/recipe.h"
#include "tests/fuzz/properties.h"

namespace skybake::config {
namespace {

namespace fs = std::filesystem;

// Returns the number of recipes in a folder; a broken property ends the process and names itself.
int check_recipes(const fs::path& folder) {
    int count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".toml") continue;
        SCOPED_TRACE(entry.path().filename().string());
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        fuzzing::check_outcome(parse_recipe(text, entry.path().string()));
        ++count;
    }
    return count;
}

TEST(FuzzCorpus, RecipesHaveTheProperties) {
    EXPECT_GT(check_recipes(fs::path(SKYBAKE_EXAMPLES) / "../tests/fuzz/corpus/recipe"), 20);
}

TEST(FuzzCorpus, ExamplesHaveTheProperties) { EXPECT_GT(check_recipes(SKYBAKE_EXAMPLES), 5); }

}  // namespace
}  // namespace skybake::config
