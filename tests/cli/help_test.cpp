#include "cli/command.h"

#include <regex>
#include <set>

#include "cli/table_printer.h"
#include "tests/cli/program.h"
#include "tests/support/odd_words.h"

namespace skybake::cli {
namespace {

constexpr long most_lines = 40;

TEST(Help, EachCommandFitsAPageAndHasAnExample) {
    for (const Command& command : commands()) {
        const std::string name(command.name);
        const testing::Result result = run_words({name, "--help"});
        EXPECT_EQ(result.code, 0) << name;
        EXPECT_TRUE(result.error.empty()) << result.error;
        EXPECT_LE(count_lines(result.out), most_lines) << name;
        EXPECT_TRUE(contains(result.out, "examples:\n  skybake " + name)) << result.out;
        ASSERT_FALSE(command.examples.empty()) << name;
        for (const OptionRow& option : command.options) {
            EXPECT_TRUE(contains(result.out, "--" + std::string(option.name))) << name;
            EXPECT_FALSE(option.help.empty()) << name << " --" << option.name;
        }
    }
}

// Whoever tries an example that sets a key, shows one or explains one has the recipe that `init`
// writes, in which the key has to be.
TEST(Help, ExamplesNameKeysOfTheFirstRecipe) {
    const testing::TemporaryFolder folder;
    const std::string recipe = (folder / "earth.toml").string();
    ASSERT_EQ(run_words({"init", recipe}).code, 0);
    const std::regex key(R"(atmosphere[a-z_.]+)");
    int count = 0;
    for (const Command& command : commands()) {
        for (const Example& example : command.examples) {
            const std::string words(example.command);
            std::smatch found;
            if (!std::regex_search(words, found, key)) continue;
            ++count;
            const testing::Result shown = run_words({"show", recipe, found.str()});
            EXPECT_EQ(shown.code, 0) << words << "\n" << shown.error;
        }
    }
    EXPECT_GE(count, 3);
}

TEST(Help, HasNoWordsThatReadersStumbleOver) {
    EXPECT_EQ(test::odd_word_of(run_words({"--help"}).out), "");
    for (const Command& command : commands()) {
        const std::string name(command.name);
        EXPECT_EQ(test::odd_word_of(run_words({name, "--help"}).out), "") << name;
    }
}

TEST(Help, GlobalHelpNamesEveryCommand) {
    const testing::Result result = run_words({"--help"});
    EXPECT_EQ(result.code, 0);
    EXPECT_LE(count_lines(result.out), most_lines);
    EXPECT_TRUE(contains(result.out, "examples:"));
    for (const Command& command : commands()) {
        EXPECT_TRUE(contains(result.out, "  " + std::string(command.name) + " ")) << command.name;
    }
    EXPECT_EQ(run_words({"-h"}).out, result.out);
}

TEST(Help, IsACommandToo) {
    EXPECT_EQ(run_words({"help"}).out, run_words({"--help"}).out);
    EXPECT_EQ(run_words({"help"}).code, 0);
    for (const Command& command : commands()) {
        const std::string name(command.name);
        EXPECT_EQ(run_words({"help", name}).out, run_words({name, "--help"}).out) << name;
    }
    expect_said(run_words({"help", "baek"}), 2, {"did you mean `bake`?"});
}

// Each command and each of its options stands in its man page and in the scripts of all shells.
TEST(Help, PagesAndCompletionsNameEverything) {
    const std::string overview = run_words({"help", "--man"}).out;
    const std::string bash = run_words({"help", "--completion", "bash"}).out;
    const std::string zsh = run_words({"help", "--completion", "zsh"}).out;
    const std::string fish = run_words({"help", "--completion=fish"}).out;
    const auto dashes = [](std::string name) {  // as roff writes them
        for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2) {
            name.replace(at, 1, "\\-");
        }
        return name;
    };
    const auto expect_option = [&](const std::string& page, const std::string& where,
                                   const OptionRow& option) {
        const std::string name(option.name);
        EXPECT_TRUE(contains(page, dashes("--" + name) + "\\fR")) << where << name;
        EXPECT_TRUE(contains(bash, " --" + name)) << where << name;
        EXPECT_TRUE(contains(zsh, "--" + name + "[")) << where << name;
        EXPECT_TRUE(contains(fish, "complete -c skybake" + where + " -l " + name + " "))
            << where << name;
    };
    for (const OptionRow& option : global_options()) expect_option(overview, "", option);
    for (const Command& command : commands()) {
        const std::string name(command.name);
        const std::string page = run_words({"help", name, "--man"}).out;
        EXPECT_TRUE(contains(overview, "\\fBskybake\\-" + name + "\\fR(1)")) << name;
        EXPECT_TRUE(contains(bash, "            " + name + ") options+=")) << name;
        EXPECT_TRUE(contains(zsh, "'" + name + ":")) << name;
        EXPECT_TRUE(contains(fish, " -a " + name + " -d ")) << name;
        for (const OptionRow& option : command.options) {
            expect_option(page, " -n '__fish_seen_subcommand_from " + name + "'", option);
        }
        for (const Example& example : command.examples) {
            EXPECT_TRUE(contains(page, dashes(std::string(example.command)).substr(0, 20)));
        }
    }
    EXPECT_EQ(run_words({"help", "--completion", "tcsh"}).code, 2);
}

TEST(Help, TheProgramAloneSaysAtMostTwelveLines) {
    const testing::Result result = run_words({});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(result.out.empty());
    EXPECT_TRUE(contains(result.error, "usage: skybake <command>"));
    EXPECT_LE(count_lines(result.error), 12) << result.error;
    for (const Command& command : commands()) {
        EXPECT_FALSE(command.brief.empty()) << command.name;
        EXPECT_TRUE(contains(result.error, std::string(command.brief))) << result.error;
    }
}

TEST(Help, OptionNamesAreUniqueWithinACommand) {
    for (const Command& command : commands()) {
        std::set<std::string_view> names;
        std::set<char> letters;
        const auto add = [&](const OptionRow& option) {
            EXPECT_TRUE(names.insert(option.name).second) << command.name << " --" << option.name;
            if (option.short_name == 0) return;
            EXPECT_TRUE(letters.insert(option.short_name).second)
                << command.name << " -" << option.short_name;
        };
        for (const OptionRow& option : global_options()) add(option);
        for (const OptionRow& option : command.options) add(option);
    }
}

TEST(Help, OnlyTheLastArgumentMayRepeatAndOptionalOnesComeLast) {
    for (const Command& command : commands()) {
        bool optional = false;
        for (std::size_t i = 0; i < command.arguments.size(); ++i) {
            EXPECT_TRUE(!command.arguments[i].repeatable || i + 1 == command.arguments.size());
            EXPECT_FALSE(optional && command.arguments[i].required) << command.name;
            optional = !command.arguments[i].required;
        }
        EXPECT_NE(command.run, nullptr) << command.name;
    }
}

}  // namespace
}  // namespace skybake::cli
