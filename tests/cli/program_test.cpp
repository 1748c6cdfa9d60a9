// The real program as a child process: what a shell sees.
#include <sstream>

#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

using testing::contains;
using testing::Result;
using testing::run_program;
using testing::TemporaryFolder;

TEST(Program, AloneSaysAtMostTwelveLines) {
    const Result result = run_program({});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(contains(result.error, "usage: skybake <command>"));
    EXPECT_LE(testing::count_lines(result.out + result.error), 12);
}

TEST(Program, HelpAndVersionGoToStdout) {
    const Result help = run_program({"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_TRUE(help.error.empty());
    EXPECT_TRUE(contains(help.out, "usage: skybake"));
    const Result version = run_program({"--version"});
    EXPECT_EQ(version.code, 0);
    EXPECT_EQ(version.out, std::string("skybake ") + SKYBAKE_VERSION + "\n");
}

TEST(Program, SuggestsAndDumpsNothingElse) {
    const Result result = run_program({"bakee"});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(result.out.empty());
    EXPECT_TRUE(contains(result.error, "did you mean `bake`?"));
    EXPECT_LE(testing::count_lines(result.error), 2);
}

// What a start of the program costs, counted by glibc's loader.
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

TEST(Program, VerifiesAFolder) {
    using skybake::testing::read_bytes;
    using skybake::testing::write_bytes;
    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    const std::string out = (folder / "out").string();
    write_bytes(recipe, "preset = \"earth\"\n[bake.transmittance]\nsize = [16, 8]\n");
    ASSERT_EQ(run_program({"bake", recipe, "-o", out}).code, 0);
    EXPECT_EQ(run_program({"verify", out}).code, 0);
    // A probe that names another place than its texture coordinates.
    std::string manifest = read_bytes(out + "/manifest.json");
    const std::size_t at = manifest.find("\"cos_zenith\": 1.0");
    ASSERT_NE(at, std::string::npos);
    manifest.replace(at, 17, "\"cos_zenith\": 0.5");
    write_bytes(out + "/manifest.json", manifest);
    const Result moved = run_program({"verify", out});
    EXPECT_EQ(moved.code, 1);
    EXPECT_TRUE(contains(moved.out, "probe place")) << moved.out;
    std::filesystem::remove(out + "/transmittance.exr");
    EXPECT_EQ(run_program({"verify", out}).code, 1);
    std::filesystem::remove(out + "/manifest.json");
    EXPECT_EQ(run_program({"verify", out}).code, 3);
}

}  // namespace
}  // namespace skybake::cli
