// The real program as a child process: what a shell sees.
#include <chrono>

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

TEST(Program, HelpIsFast) {
    double best = 1e9;
    for (int round = 0; round < 5; ++round) {
        const auto start = std::chrono::steady_clock::now();
        run_program({"--help"});
        best = std::min(
            best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    EXPECT_LT(best, 0.05);
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
    const std::size_t at = manifest.find("\"cos_zenith\": ");
    ASSERT_NE(at, std::string::npos);
    manifest.replace(at, manifest.find_first_of(",\n", at) - at, "\"cos_zenith\": 0.8125");
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
