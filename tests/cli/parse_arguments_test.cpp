#include <stdexcept>

#include "cli/options.h"
#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

using Words = std::vector<std::string>;

enum class Level { none, quick, full };

config::Outcome<int> read_number(const std::string& text) {
    if (const auto number = parse_count(text, 1, 9)) return {number, {}};
    return {{}, {bad_value("--number", text, "it takes a number from 1 to 9")}};
}

// An option of each type.
const Option<std::filesystem::path> output{"output", 'o', "FOLDER"};
const Option<std::vector<std::string>> settings{"set", 0, "KEY=VALUE"};
const Option<Level> level{"level", 0, "LEVEL", {{"quick", Level::quick}, {"full", Level::full}}};
const Option<bool> force{"force"};
const Option<int> number{"number", 'n', "N", {}, read_number};

const std::vector<Command>& sample_commands() {
    static const std::vector<Command> table = {
        {.name = "bake",
         .summary = "make something",
         .arguments = {{.name = "recipe", .help = "what to make"},
                       {.name = "more", .help = "more of them", .required = false}},
         .options = {output("where", "./out"), settings("a setting"), level("how"),
                     force("overwrite"), number("how many")},
         .examples = {{.command = "skybake bake earth.toml", .what = "makes it"}}},
        {.name = "verify", .summary = "prove it", .examples = {{.command = "skybake verify out"}}},
    };
    return table;
}

CommandLine parse(const Words& words) {
    return parse_arguments(words, sample_commands(), global_options());
}

// The one complaint about these words: message and label.
std::string complaint(const Words& words) {
    const CommandLine line = parse(words);
    EXPECT_EQ(line.diagnostics.size(), 1u);
    if (line.diagnostics.empty()) return "";
    EXPECT_EQ(line.diagnostics[0].code, "E0001");
    return line.diagnostics[0].message + "; " + line.diagnostics[0].label;
}

TEST(ParseArguments, TakesOptionsAnywhere) {
    for (const Words& words :
         {Words{"bake", "a.toml", "-o", "x", "--force"}, Words{"bake", "--force", "-ox", "a.toml"},
          Words{"--quiet", "bake", "--output=x", "a.toml", "--force"},
          Words{"--color", "never", "bake", "--force", "a.toml", "--output", "x"}}) {
        const CommandLine line = parse(words);
        EXPECT_TRUE(line.diagnostics.empty()) << line.diagnostics[0].message;
        ASSERT_NE(line.command, nullptr);
        EXPECT_EQ(line.command->name, "bake");
        EXPECT_EQ(line.invocation.arguments(), Words{"a.toml"});
        EXPECT_EQ(line.invocation[output], "x");
        EXPECT_TRUE(line.invocation[force]);
    }
}

TEST(ParseArguments, KnowsFallbacks) {
    const CommandLine line = parse({"bake", "a.toml"});
    EXPECT_EQ(line.invocation[output], "./out");
    EXPECT_FALSE(line.invocation.has(output));
    EXPECT_EQ(line.invocation[options::diagnostics], DiagnosticFormat::human);
    EXPECT_EQ(line.invocation[level], Level::none);
    EXPECT_EQ(line.invocation[number], 0);
    EXPECT_TRUE(line.invocation[settings].empty());
}

TEST(ParseArguments, RepeatsWhatRepeatsAndElseTakesTheLast) {
    const CommandLine line = parse({"bake", "--set", "a=1", "x.toml", "--set=b=[1, 2]", "--set",
                                    "c={}", "-o", "x", "-o", "y"});
    EXPECT_TRUE(line.diagnostics.empty());
    EXPECT_EQ(line.invocation[settings], (Words{"a=1", "b=[1, 2]", "c={}"}));
    EXPECT_EQ(line.invocation[output], "y");
    EXPECT_EQ(line.invocation.arguments(), Words{"x.toml"});
}

TEST(ParseArguments, GivesValuesAsTheirTypes) {
    const CommandLine line = parse({"bake", "a", "--level", "full", "-n5", "--color=never"});
    EXPECT_TRUE(line.diagnostics.empty());
    EXPECT_EQ(line.invocation[level], Level::full);
    EXPECT_EQ(line.invocation[number], 5);
    EXPECT_EQ(line.invocation.typed(number), Words{"5"});
    EXPECT_EQ(line.invocation[options::color], WhenColor::never);
    EXPECT_EQ(complaint({"bake", "a", "-n0"}),
              "`--number` cannot be `0`; it takes a number from 1 to 9");
    EXPECT_EQ(complaint({"bake", "a", "--number", "x"}),
              "`--number` cannot be `x`; it takes a number from 1 to 9");
    EXPECT_TRUE(parse({"bake", "a", "-n0", "-n1"}).diagnostics.empty());
}

TEST(ParseArguments, RefusesOptionsThatACommandDoesNotDeclare) {
    const CommandLine line = parse({"bake", "a"});
    EXPECT_THROW(line.invocation[options::dry_run], std::logic_error);
    EXPECT_THROW(line.invocation.has(options::cache_dir), std::logic_error);
}

TEST(ParseArguments, PassesStrangeArgumentsOn) {
    EXPECT_EQ(parse({"bake", "[a].toml", "{}"}).invocation.arguments(), (Words{"[a].toml", "{}"}));
    EXPECT_EQ(parse({"bake", "--", "-x", "--force"}).invocation.arguments(),
              (Words{"-x", "--force"}));
    EXPECT_EQ(parse({"bake", "", "a b"}).invocation.arguments(), (Words{"", "a b"}));
}

TEST(ParseArguments, SaysWhatIsWrongInOneSentence) {
    const std::string label = "; the options of a command come after it: skybake bake ";
    for (const auto& [words, said] : std::vector<std::pair<Words, std::string>>{
             {{"baek", "a.toml"}, "unknown command `baek`; did you mean `bake`?"},
             {{"zzzzzz"}, "unknown command `zzzzzz`; `skybake --help` lists the commands"},
             {{"bake", "a", "--ouput", "x"}, "unknown option `--ouput`; did you mean `--output`?"},
             {{"bake", "a", "--quite"}, "unknown option `--quite`; did you mean `--quiet`?"},
             {{"bake", "a", "-Z"}, "unknown option `-Z`; `skybake bake --help` lists the options"},
             {{"bake", "a", "--level=fulll"}, "`--level` cannot be `fulll`; did you mean `full`?"},
             {{"bake", "a", "--level=9"}, "`--level` cannot be `9`; use one of quick, full"},
             {{"--versoin"}, "unknown option `--versoin`; did you mean `--version`?"},
             // The two dashes, which all options have, do not make two names alike.
             {{"bake", "a", "--only", "x"},
              "unknown option `--only`; `skybake bake --help` lists the options"},
             {{"bake", "a", "--fxxce"}, "unknown option `--fxxce`; did you mean `--force`?"},
             {{"bake"}, "`skybake bake` needs <recipe>; for example skybake bake earth.toml"},
             {{"bake", "a", "b", "c"},
              "unexpected argument `c`; `skybake bake --help` shows what it takes"},
             {{"verify", "x"},
              "unexpected argument `x`; `skybake verify --help` shows what it takes"},
             {{"bake", "a", "--output"}, "`--output` needs a value: --output FOLDER; "},
             {{"bake", "a", "--output", "--force"}, "`--output` needs a value: --output FOLDER; "},
             {{"bake", "a", "--force=3"}, "`--force` takes no value; "},
             {{"-o", "out", "bake", "a"}, "`-o` stands before the command" + label + "-o FOLDER"},
             {{"-oout", "bake", "a"}, "`-oout` stands before the command" + label + "-o FOLDER"},
             {{"--output=out", "bake", "a"},
              "`--output=out` stands before the command" + label + "--output FOLDER"},
             {{"-q", "--force", "bake", "a"},
              "`--force` stands before the command" + label + "--force"},
             {{"--completion", "bash"},
              "unknown option `--completion`; `skybake --help` lists the options"},
             {{"--colour", "never", "bake", "a"},
              "unknown option `--colour`; did you mean `--color`?"},
             {{"-qZ", "bake", "a"}, "unknown option `-qZ`; `skybake --help` lists the options"},
         }) {
        EXPECT_EQ(complaint(words), said);
    }
    EXPECT_TRUE(parse({"-qv", "--color=never", "bake", "a"}).diagnostics.empty());
}

TEST(ParseArguments, HelpNeedsNothingElse) {
    const CommandLine line = parse({"bake", "--help"});
    EXPECT_TRUE(line.diagnostics.empty());
    EXPECT_TRUE(line.invocation[options::help]);
}

}  // namespace
}  // namespace skybake::cli
