#include "config/recipe/recipe_sources.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

std::vector<std::string> source_names(const RecipeSources& sources) {
    std::vector<std::string> names;
    for (const SourceTree& tree : sources.trees) names.push_back(tree.source->name);
    return names;
}

// What is said about a recipe that cannot be read whole.
std::vector<Diagnostic> faults_of(const std::filesystem::path& path) {
    DiagnosticList list;
    const RecipeSources sources = read_sources(path, {}, list);  // the list points to their lines
    EXPECT_FALSE(sources.complete) << path;
    return list.take();
}

using testing::codes_and_places;
using Codes = std::vector<std::string>;

TEST(RecipeSources, StandInTheOrderOfOverriding) {
    const TemporaryFolder folder;
    folder.write("base/one.toml", "preset = 'mars'");
    folder.write("base/two.toml", "");
    const auto path = folder.write(
        "top.toml", "preset = 'earth_hillaire'\ninclude = ['base/one.toml', 'base/two.toml']");
    DiagnosticList list;
    const std::vector<std::string> settings = {"a.b=1", "a.c = 2"};
    const RecipeSources sources = read_sources(path, settings, list);
    EXPECT_TRUE(list.take().empty());
    EXPECT_TRUE(sources.complete);
    EXPECT_EQ(source_names(sources),
              (std::vector<std::string>{"preset earth_hillaire", "preset mars",
                                        (folder.path() / "base/one.toml").string(),
                                        (folder.path() / "base/two.toml").string(), path.string(),
                                        "--set `a.b=1`", "--set `a.c = 2`"}));
    EXPECT_EQ(sources.inputs.size(), 3u);
    EXPECT_EQ(sources.inputs[0], path);
    for (std::size_t i = 1; i < sources.trees.size(); ++i) {
        EXPECT_LT(sources.trees[i - 1].source->order, sources.trees[i].source->order);
    }
}

TEST(RecipeSources, PresetsBringNoBakes) {
    DiagnosticList list;
    const RecipeSources sources = text_sources("preset = 'earth_hillaire'", "t", {}, {}, list);
    ASSERT_EQ(sources.trees.size(), 2u);
    EXPECT_FALSE(find_entry(sources.trees[0].root, "bake"));
    EXPECT_TRUE(find_entry(sources.trees[0].root, "atmosphere"));
}

TEST(RecipeSources, ASettingMayNameThePreset) {
    DiagnosticList list;
    const std::vector<std::string> settings = {"preset=mars"};
    const RecipeSources sources =
        text_sources("preset = 'earth_hillaire'", "t", {}, settings, list);
    EXPECT_EQ(source_names(sources)[0], "preset mars");
}

TEST(RecipeSources, IncludesAreRelativeToTheirFile) {
    const TemporaryFolder folder;
    folder.write("a/b/deep.toml", "");
    folder.write("a/middle.toml", "include = 'b/deep.toml'");
    const auto path = folder.write("top.toml", "include = 'a/middle.toml'");
    DiagnosticList list;
    const RecipeSources sources = read_sources(path, {}, list);
    EXPECT_TRUE(list.take().empty());
    EXPECT_EQ(sources.trees[0].source->name, (folder.path() / "a/b/deep.toml").string());
}

TEST(RecipeSources, OneFileMayBeIncludedTwice) {
    const TemporaryFolder folder;
    folder.write("base.toml", "");
    folder.write("left.toml", "include = 'base.toml'");
    folder.write("right.toml", "include = 'base.toml'");
    const auto path = folder.write("top.toml", "include = ['left.toml', 'right.toml']");
    DiagnosticList list;
    EXPECT_EQ(read_sources(path, {}, list).trees.size(), 5u);
    EXPECT_TRUE(list.take().empty());
}

TEST(RecipeSources, CyclesAreNamed) {
    const TemporaryFolder folder;
    const auto a = folder.write("a.toml", "include = ['b.toml']");
    const auto b = folder.write("b.toml", "include = ['./c.toml']");
    const auto c = folder.write("c.toml", "x = 1\ninclude = ['a.toml']");
    const auto diagnostics = faults_of(a);
    ASSERT_EQ(codes_and_places(diagnostics), Codes{"E0116 2:12"});
    EXPECT_EQ(diagnostics[0].where.source, c.string());
    EXPECT_EQ(diagnostics[0].message, "cyclic include: " + a.string() + " includes " + b.string() +
                                          " includes " + c.string() + " includes " + a.string());
    folder.write("a.toml", "include = 'a.toml'");
    EXPECT_EQ(codes_and_places(faults_of(a)), Codes{"E0116 1:11"}) << "a file that includes itself";
}

// Twice two files on each of thirty levels would be a billion.
TEST(RecipeSources, IncludesThatMultiplyAreStopped) {
    const TemporaryFolder folder;
    for (int i = 0; i < 30; ++i) {
        const std::string next = std::to_string(i + 1) + ".toml";
        folder.write(std::to_string(i) + ".toml", "include = ['" + next + "', '" + next + "']");
    }
    folder.write("30.toml", "");
    DiagnosticList list;
    const RecipeSources sources = read_sources(folder.path() / "0.toml", {}, list);
    EXPECT_LE(sources.inputs.size(), 256u);
    EXPECT_EQ(codes_and_places(list.take()), Codes{"E0125 1:23"});
}

TEST(RecipeSources, UnreadableIncludesAreReportedWhereTheyAreNamed) {
    const TemporaryFolder folder;
    const auto path = folder.write("top.toml", "include = ['none.toml', '.']");
    EXPECT_EQ(codes_and_places(faults_of(path)), (Codes{"E0300 1:12", "E0300 1:25"}));
}

// A recipe may come from a pipe; what it includes may not: a program would wait for ever.
TEST(RecipeSources, PipesAndDevicesAreNotIncluded) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
    const auto path = folder.write("top.toml", "include = ['pipe', '/dev/zero']");
    ::alarm(20);
    const auto diagnostics = faults_of(path);
    ::alarm(0);
    ASSERT_EQ(diagnostics.size(), 2u);
    for (const Diagnostic& diagnostic : diagnostics) {
        EXPECT_EQ(diagnostic.code, "E0300");
        EXPECT_NE(diagnostic.message.find("it is not a regular file"), std::string::npos);
        EXPECT_EQ(diagnostic.where.source, path.string());
    }
}

// Who may name includes must not read any file of who runs the program.
TEST(RecipeSources, LinesOfIncludesThatAreNoRecipesAreNotShown) {
    const TemporaryFolder folder;
    const auto path = folder.write("top.toml", "include = 'secrets'");
    for (const std::string text :
         {"root:s3cret:0:0", "\n# x\npassword = s3cret", "password = 's3cret'", "a = 'b s3cret",
          "[default]\nkey = 's3cret'", "s3cret\xff", "{\"key\": \"s3cret\"}", "s3cret = 0,5"}) {
        folder.write("secrets", text);
        const auto diagnostics = faults_of(path);
        ASSERT_EQ(diagnostics.size(), 1u) << text;
        const Diagnostic& found = diagnostics[0];
        EXPECT_EQ(found.where.source, (folder.path() / "secrets").string());
        EXPECT_NE(found.label.find("an include must be a recipe"), std::string::npos);
        for (const std::string& shown : {found.message, found.label, found.where.line_text}) {
            EXPECT_EQ(shown.find("s3cret"), std::string::npos) << shown;
        }
    }
    // If the file is a recipe, the message shows what is wrong.
    folder.write("secrets", "[atmosphere]\nground_radius = '1 km'\n[typo]\n");
    const auto recipe = load_recipe(path);
    const bool is_shown =
        std::any_of(recipe.diagnostics.begin(), recipe.diagnostics.end(),
                    [](const auto& found) { return found.where.line_text == "[typo]"; });
    EXPECT_TRUE(is_shown);
}

TEST(RecipeSources, AKeyThatIsSetTwiceWarns) {
    DiagnosticList list;
    const std::vector<std::string> settings = {"a.b=1", "a.c=1", " a.b =2"};
    text_sources("preset = 'earth'", "t", {}, settings, list);
    const auto diagnostics = list.take();
    ASSERT_EQ(codes_and_places(diagnostics), Codes{"W0224 0:0"});
    EXPECT_EQ(diagnostics[0].message, "`a.b` is set twice");
}

TEST(RecipeSources, LargeFilesAreNotRead) {
    const TemporaryFolder folder;
    const auto path = folder.write("large.toml", std::string((4 << 20) + 1, '#'));
    DiagnosticList list;
    read_sources(path, {}, list);
    EXPECT_EQ(list.take()[0].code, "E0120");
    const auto just_right = folder.write("large.toml", std::string(4 << 20, '#'));
    read_sources(just_right, {}, list);
    EXPECT_TRUE(list.take().empty());
}

TEST(RecipeSources, BadSettingsAreReported) {
    for (const char* setting : {"", "a", "=1", "a b=1", "a..b=1", "[a]=1", "\"a=1"}) {
        DiagnosticList list;
        const std::vector<std::string> settings = {setting};
        const RecipeSources sources = text_sources("", "t", {}, settings, list);
        const auto diagnostics = list.take();
        ASSERT_EQ(diagnostics.size(), 1u) << setting;
        EXPECT_EQ(diagnostics[0].code, "E0122") << setting;
        EXPECT_EQ(diagnostics[0].where.source, std::string("--set `") + setting + '`');
    }
}

}  // namespace
}  // namespace skybake::config
