// The real program as a child process: what a shell sees.
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/command.h"
#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

using testing::run_program;

TEST(Program, HelpAndVersionGoToStdout) {
    const Result help = run_program({"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_TRUE(help.error.empty());
    EXPECT_TRUE(contains(help.out, "usage: skybake"));
    const Result version = run_program({"--version"});
    EXPECT_EQ(version.code, 0);
    EXPECT_EQ(version.out, std::string("skybake ") + SKYBAKE_VERSION + "\n");
    EXPECT_EQ(run_program({"-V"}).out, version.out);
}

TEST(Program, SuggestsAndDumpsNothingElse) {
    const Result result = run_program({"bakee"});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(result.out.empty());
    EXPECT_TRUE(contains(result.error, "did you mean `bake`?"));
    EXPECT_LE(testing::count_lines(result.error), 2);
}

// The cost of a start of the program, counted by glibc's loader.
struct Loaded {
    int libraries = 0;
    long relocations = 0;  // names that were looked up
};

Loaded loaded_by(const std::vector<std::string>& words) {
    const TemporaryFolder folder;
    const std::string log = (folder / "log").string();
    EXPECT_EQ(run_program(words,
                          [&] {
                              ::setenv("LD_DEBUG", "files,statistics", 1);
                              ::setenv("LD_DEBUG_OUTPUT", log.c_str(), 1);
                          })
                  .code,
              0);
    Loaded loaded;
    for (const std::string& name : folder.names()) {
        std::istringstream lines(testing::read_bytes(folder / name));
        for (std::string line; std::getline(lines, line);) {
            if (contains(line, "calling init: ")) ++loaded.libraries;
            const std::string total = "final number of relocations: ";
            if (contains(line, total)) {
                loaded.relocations = std::stol(line.substr(line.find(total) + total.size()));
            }
        }
    }
    return loaded;
}

// Whoever asks for help waits for the loader alone: no module is loaded, and of libraries only
// those that every command needs. OpenVDB brings ten, and ten times as many relocations.
TEST(Program, HelpLoadsLittle) {
    const Loaded help = loaded_by({"--help"});
    if (help.libraries == 0) GTEST_SKIP() << "the loader here is not glibc's and counts nothing";
    EXPECT_LE(help.libraries, 18);
    EXPECT_LE(help.relocations, 10000);
    EXPECT_GT(help.relocations, 100);

    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    testing::write_bytes(
        recipe,
        "[noise.n.channels.Y]\ntype = \"constant\"\nvalue = 1\n[bake.v]\nasset = "
        "\"noise_volume\"\nnoise = \"n\"\nsize = [8, 8, 8]\nformats = [\"vdb\"]\n");
    const Loaded bake =
        loaded_by({"bake", recipe, "-o", (folder / "out").string(), "--certify", "off"});
    EXPECT_GT(bake.libraries, 18) << "a module that is loaded counts";
    EXPECT_GT(bake.relocations, 10000);
}

TEST(Program, AFullOrClosedStdoutIsAnError) {
    const auto full = [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); };
    EXPECT_EQ(run_program({"--help"}, full).code, 3);
    const auto closed = [] { ::close(STDOUT_FILENO); };
    EXPECT_EQ(run_program({"--help"}, closed).code, 3);
    const auto broken_pipe = [] {
        int ends[2];
        if (::pipe(ends) != 0) ::_exit(125);
        ::close(ends[0]);
        ::dup2(ends[1], STDOUT_FILENO);
    };
    EXPECT_EQ(run_program({"--help"}, broken_pipe).code, 3);
}

TEST(Program, AClosedStderrIsNone) {
    const auto closed = [] { ::close(STDERR_FILENO); };
    EXPECT_EQ(run_program({"--help"}, closed).code, 0);
    EXPECT_EQ(run_program({"bakee"}, closed).code, 2);
}

TEST(Program, HonoursTheColoursOfTheEnvironment) {
    const auto colours = [](const char* name, const char* value) {
        const Result result = run_program({"bakee"}, [&] {
            for (const char* other : {"NO_COLOR", "CLICOLOR_FORCE", "FORCE_COLOR"}) {
                ::unsetenv(other);
            }
            ::setenv(name, value, 1);
        });
        return contains(result.error, "\x1b[");
    };
    EXPECT_TRUE(colours("CLICOLOR_FORCE", "1"));
    EXPECT_TRUE(colours("FORCE_COLOR", "1"));
    EXPECT_FALSE(colours("FORCE_COLOR", "0"));
    EXPECT_FALSE(colours("NO_COLOR", "1"));
}

// Whatever is wrong, a program that asked for JSON gets a line of it.
TEST(Program, EveryFailureIsAnEvent) {
    const auto event_of = [](const std::vector<std::string>& words) {
        const Result result = testing::run_words(words);
        EXPECT_GE(result.code, 2);
        const std::size_t last = result.out.rfind("{\"event\"");
        const auto event = nlohmann::json::parse(
            result.out.substr(last == std::string::npos ? 0 : last), nullptr, false);
        EXPECT_EQ(event.value("event", ""), "failed") << words[0] << ": " << result.out;
        EXPECT_EQ(event.value("exit_code", 0), result.code) << words[0];
        EXPECT_FALSE(event["diagnostics"].empty()) << words[0];
        return event;
    };
    EXPECT_EQ(event_of({"bakee", "--json"})["command"], "");
    EXPECT_EQ(event_of({"--json"})["command"], "");
    EXPECT_EQ(event_of({"--json", "-o", "x", "bake"})["command"], "");
    for (const Command& command : commands()) {
        const std::string name(command.name);
        EXPECT_EQ(event_of({name, "--no-such-option", "--json"})["command"], name);
        // An argument too many, a file that is not there, or a name that means nothing.
        EXPECT_EQ(event_of({name, "/absent/a", "/absent/b", "/absent/c", "--json"})["command"],
                  name);
    }
}

}  // namespace
}  // namespace skybake::cli
