#include "cli/help.h"

#include <set>

#include "cli/commands.h"
#include "cli/text_width.h"
#include "tests/cli/program.h"
#include "tests/support/odd_words.h"

namespace skybake::cli {
namespace {

using testing::contains;
using testing::count_lines;
using testing::run_words;

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
        for (const Option& option : command.options) {
            EXPECT_TRUE(contains(result.out, "--" + std::string(option.name))) << name;
            EXPECT_FALSE(option.help.empty()) << name << " --" << option.name;
        }
    }
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
    const testing::Result slip = run_words({"help", "baek"});
    EXPECT_EQ(slip.code, 2);
    EXPECT_TRUE(contains(slip.error, "did you mean `bake`?")) << slip.error;
}

TEST(Help, TheProgramAloneSaysAtMostTwelveLines) {
    const testing::Result result = run_words({});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(result.out.empty());
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
        const auto add = [&](const Option& option) {
            EXPECT_TRUE(names.insert(option.name).second) << command.name << " --" << option.name;
            if (option.short_name == 0) return;
            EXPECT_TRUE(letters.insert(option.short_name).second)
                << command.name << " -" << option.short_name;
        };
        for (const Option& option : global_options()) add(option);
        for (const Option& option : command.options) add(option);
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
