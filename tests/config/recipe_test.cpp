// Whole recipes: files that are none, and what a pipeline relies on. cases/ holds what is said of mistakes.
#include "config/recipe/recipe.h"

#include <gtest/gtest.h>

#include <locale>

#include "config/diagnostics/diagnostic_codes.h"
#include "tests/config/recipes.h"
#include "tests/support/refused.h"

namespace skybake::config {
namespace {

// `explain` shows for a code about noises and clouds a recipe that earns it, and one that does not.
TEST(Recipe, ExamplesOfNoiseAndCloudCodesAreRight) {
    for (const char* name : {"E0126", "E0128", "E0129", "E0130", "E0131", "E0132", "E0133", "E0134",
                             "E0150", "E0171", "E0174", "E0175", "E0176", "E0177", "E0189", "W0203",
                             "W0204", "W0208", "W0210", "W0211", "W0212", "W0213", "W0223"}) {
        const DiagnosticCode* code = find_diagnostic_code(name);
        ASSERT_TRUE(code) << name;
        const auto wrong = parse(std::string(code->wrong)).diagnostics;
        ASSERT_EQ(wrong.size(), 1u) << name;
        EXPECT_EQ(wrong[0].code, name);
        const Outcome<Recipe> right = parse(std::string(code->right));
        EXPECT_TRUE(right.value) << name;
        EXPECT_TRUE(right.diagnostics.empty()) << name;
    }
}

TEST(Recipe, AFileWithAByteOrderMarkIsFine) {
    const Recipe recipe =
        valid("\xef\xbb\xbfpreset = 'earth_hillaire'\r\n[bake.transmittance]\r\n");
    EXPECT_EQ(recipe.parameters.bakes.size(), 1u);
    EXPECT_EQ(parse("\xef\xbb\xbf[atmosphere").diagnostics[0].where.line_text, "[atmosphere");
}

struct BadFile {
    std::string what;
    std::string content;
    std::string code;
    int exit_code;
};

TEST(Recipe, BadFilesAreOneClearMessage) {
    const TemporaryFolder folder;
    const std::vector<BadFile> files = {
        {"empty", "", "E0105", 2},
        {"binary",
         std::string("\x7f"
                     "ELF\x02\x01\x01\0\0\0",
                     10),
         "E0100", 2},
        {"large", std::string(5 << 20, 'x'), "E0120", 2},
        {"latin1", "# caf\xe9\n", "E0100", 2},
        {"utf16",
         std::string("\xff\xfe"
                     "a\0",
                     4),
         "E0100", 2},
        {"cyclic", "include = ['cyclic']", "E0116", 2},
        {"lost include", "include = ['nowhere.toml']", "E0300", 3},
        {"deep", "[" + std::string(1000, '['), "E0121", 2},
    };
    for (const BadFile& file : files) {
        SCOPED_TRACE(file.what);
        const Outcome<Recipe> outcome = load_recipe(folder.write(file.what, file.content));
        test::expect_refused(outcome, file.code);
        EXPECT_EQ(exit_code(outcome.diagnostics), file.exit_code);
    }
}

TEST(Recipe, FilesThatCannotBeReadHaveTheirOwnExitCode) {
    const TemporaryFolder folder;
    for (const auto& path : {folder.path() / "missing.toml", folder.path()}) {
        const Outcome<Recipe> outcome = load_recipe(path);
        EXPECT_NE(test::expect_refused(outcome, "E0300").message.find(path.string()),
                  std::string::npos);
        EXPECT_EQ(exit_code(outcome.diagnostics), 3);
    }
}

TEST(Recipe, AnUnreadableFileDoesNotHideErrorsOfSettings) {
    const TemporaryFolder folder;
    const std::vector<std::string> settings = {"nonsense"};
    const Outcome<Recipe> outcome = load_recipe(folder.path() / "missing.toml", settings);
    EXPECT_EQ(outcome.diagnostics.size(), 2u);
    EXPECT_EQ(exit_code(outcome.diagnostics), 3);
}

TEST(Recipe, IncludesComeBeforeTheFileAndSettingsAfter) {
    const TemporaryFolder folder;
    folder.write(
        "base.toml",
        "preset = 'earth_hillaire'\n[atmosphere.layers.mie]\ng = 0.1\nscattering = '1e-6 /m'\n");
    const auto path =
        folder.write("top.toml", "include = 'base.toml'\n[atmosphere.layers.mie]\ng = 0.2\n");
    const std::vector<std::string> settings = {"atmosphere.layers.mie.g=0.3",
                                               "atmosphere.layers.mie.g=0.4"};
    const auto g = [](const Outcome<Recipe>& outcome) {
        return testing::find_layer(outcome.value.value().parameters, "mie")->g;
    };
    EXPECT_EQ(g(load_recipe(path)), 0.2);
    EXPECT_EQ(g(load_recipe(path, settings)), 0.4);
    EXPECT_EQ(
        testing::find_layer(load_recipe(path).value->parameters, "mie")->scattering[0].per_meter,
        1e-6);
    EXPECT_EQ(load_recipe(path).value->inputs.size(), 2u);
}

// A locale with a decimal comma and points between the thousands, whether installed or not.
class CommaPunctuation : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(Recipe, DoesNotDependOnTheLocale) {
    const std::string expected = all_parameters(valid("preset = 'earth_hillaire'"));
    const std::string message = parse("format = 2000").diagnostics.back().message;
    const std::locale before =
        std::locale::global(std::locale(std::locale::classic(), new CommaPunctuation));
    EXPECT_EQ(all_parameters(valid("preset = 'earth_hillaire'")), expected);
    EXPECT_EQ(parse("format = 2000").diagnostics.back().message, message);
    std::locale::global(before);
}

}  // namespace
}  // namespace skybake::config
