// The bake as a build engineer meets it: files, exit codes, and what is left behind when things
// fail.
#include <sys/resource.h>

#include <filesystem>

#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

using namespace skybake::cli::testing;
namespace fs = std::filesystem;

class BakeCommand : public RecipeTest {
  protected:
    BakeCommand() {
        write(
            "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [32, 8]\n"
            "[bake.multiple_scattering]\nmethod = \"converged\"\nmapping = \"hillaire\"\n"
            "size = [8, 8]\nmax_texel_error = \"20 %\"\n");
    }
    void write(const std::string& text) { write_bytes(recipe_, text); }
    Result bake(std::vector<std::string> more = {}) const {
        return run_program(words(std::move(more)));
    }
    std::vector<std::string> files() const { return folder_.names("out"); }

    const std::vector<std::string> all_ = {"manifest.json", "multiple_scattering.exr",
                                           "transmittance.exr"};
};

// Without -v a first bake gives no reasons, since there is one for all of them.
TEST_F(BakeCommand, ShowsItsPlanIfItIsVerbose) {
    const std::vector<std::string> one = {"--only", "transmittance", "--certify", "off"};
    EXPECT_FALSE(contains(bake(one).error, "not baked yet"));
    fs::remove_all(out_);
    const Result first = bake({one[0], one[1], one[2], one[3], "-v"});
    EXPECT_EQ(first.code, 0);
    EXPECT_TRUE(contains(first.error, "not baked yet")) << first.error;
    const Result again = bake({one[0], one[1], one[2], one[3], "--verbose"});
    expect_has(again.error, {"transmittance.exr              up to date\n"});
    EXPECT_EQ(again.out, first.out);
}

TEST_F(BakeCommand, MakesWhatIsStaleAndSaysWhy) {
    EXPECT_EQ(bake().code, 0);
    const Result warm = bake();
    EXPECT_TRUE(contains(warm.error, "2 assets up to date")) << warm.error;
    EXPECT_EQ(count_lines(warm.out), 3);  // what a bake gives, whether it was made now or before
    const std::vector<std::string> change = {"--set", "atmosphere.ground_albedo=0.125"};
    const Result plan = bake({change[0], change[1], "--dry-run"});
    const std::string why = "atmosphere.ground_albedo [0.3, 0.3, 0.3] → [0.125, 0.125, 0.125]";
    expect_has(plan.out, {why, "up to date"});
    const Result stale = bake(change);
    expect_has(stale.error, {"  multiple_scattering: " + why + "\n", "2 assets (1 up to date)"});
}

TEST_F(BakeCommand, SaysUnderWhichSunTheSkyIsWorstAndWhatIsBetter) {
    const std::string better = "  multiple_scattering: method = \"solved\" has";
    const Result measured = bake();
    expect_has(measured.error, {"% (sun ", better});
    fs::remove_all(out_);
    const Result blind = bake({"--certify", "off"});
    EXPECT_FALSE(contains(blind.error, "(sun ") || contains(blind.error, better)) << blind.error;
}

TEST_F(BakeCommand, ACacheServesOtherFolders) {
    const std::string cache = (folder_ / "cache").string();
    EXPECT_EQ(bake({"--cache-dir", cache}).code, 0);
    const std::string other = (folder_ / "other").string();
    const Result copied = run_program({"bake", recipe_, "-o", other, "--cache-dir", cache});
    EXPECT_TRUE(contains(copied.error, "2 assets (2 from the cache)")) << copied.error;
    EXPECT_EQ(read_bytes(other + "/transmittance.exr"), read_bytes(out_ + "/transmittance.exr"));
    const Result stats = run_program({"cache", "stats", "--cache-dir", cache, "--json"});
    EXPECT_TRUE(contains(stats.out, "\"assets\":2")) << stats.out;
    EXPECT_EQ(run_program({"cache", "verify", "--cache-dir", cache}).code, 0);
    EXPECT_EQ(run_program({"cache", "gc", "--cache-dir", cache, "--max-size", "0"}).code, 0);
    EXPECT_TRUE(contains(run_program({"cache", "stats", "--cache-dir", cache}).out, "0 assets"));
    EXPECT_EQ(run_program({"cache", "gc", "--cache-dir", cache}).code, 2);
    EXPECT_EQ(run_program({"cache", "stats"}, [] { ::unsetenv("SKYBAKE_CACHE_DIR"); }).code, 2);
    EXPECT_EQ(run_program({"cache", "dust", "--cache-dir", cache}).code, 2);
}

// A copy warns as the bake did whose result it is, and of an asset that is up to date its event tells.
TEST_F(BakeCommand, ACopyWarnsAsItsBakeDid) {
    write(
        "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [32, 8]\npixel_type = "
        "\"half\"\n");
    const std::vector<std::string> cached = {"--cache-dir", (folder_ / "cache").string()};
    for (const char* state : {"baked", "copied"}) {
        fs::remove_all(out_);
        const Result result = bake({cached[0], cached[1], "--json"});
        expect_said(result, 0, {"W0201", "values are below 6.1e-05", ".toml:4"});
        expect_has(result.out,
                   {std::string("\"state\":\"") + state, "\"warnings\":[{\"code\":\"W0201\""});
    }
    const Result again = bake({"--json"});
    EXPECT_FALSE(contains(again.error, "W0201")) << again.error;
    expect_has(again.out, {"\"state\":\"up_to_date", "\"key\":\"pixel_type\""});
}

// Whatever asks for it, a folder that never was a cache is refused and left as it is.
TEST_F(BakeCommand, AFolderOfSomethingElseIsNoCache) {
    const std::string projects = (folder_ / "projects").string();
    fs::create_directories(projects + "/pending/99999999-0");
    write_bytes(projects + "/pending/99999999-0/thesis.txt", "thesis");
    const std::vector<std::vector<std::string>> commands = {
        {"bake", recipe_, "-o", out_},
        {"cache", "stats"},
        {"cache", "verify"},
        {"cache", "gc", "--max-size", "0"},
        {"sweep", recipe_, "-o", out_, "--vary", "atmosphere.ground_albedo=0.1,0.2"},
        {"plan", recipe_, "-o", out_}};
    for (std::vector<std::string> words : commands) {
        words.insert(words.end(), {"--cache-dir", projects});
        const Result result = run_program(words);
        EXPECT_EQ(result.code, 3) << words[0];
        EXPECT_TRUE(contains(result.error, "error[E0302]")) << words[0] << result.error;
        EXPECT_TRUE(contains(result.error, "is not a cache")) << words[0] << result.error;
        EXPECT_FALSE(fs::exists(out_)) << words[0];
    }
    EXPECT_EQ(read_bytes(projects + "/pending/99999999-0/thesis.txt"), "thesis");
}

TEST_F(BakeCommand, TheOutputIsNoCache) {
    for (const std::string& cache : {out_, out_ + "/../" + fs::path(out_).filename().string()}) {
        const Result result = run_program({"bake", recipe_, "-o", out_, "--cache-dir", cache});
        EXPECT_EQ(result.code, 3) << cache;
        expect_has(result.error, {"error[E0302]", "is the output and the cache"});
        EXPECT_FALSE(fs::exists(out_));
    }
}

TEST_F(BakeCommand, RefusesBeforeWorkWhatNeedsTooMuchMemory) {
    expect_said(bake({"--max-memory", "4KiB"}), 2, {"error[E0002]", "--max-memory allows 4 KiB"});
    EXPECT_FALSE(fs::exists(out_));
    EXPECT_EQ(bake({"--max-memory", "many"}).code, 2);
    EXPECT_EQ(bake({"--max-memory", "4GiB"}).code, 0);
}

TEST_F(BakeCommand, WritesADepfile) {
    const std::string depfile = (folder_ / "sky.d").string();
    EXPECT_EQ(bake({"--depfile", depfile}).code, 0);
    const std::string text = read_bytes(depfile);
    EXPECT_EQ(text.rfind(out_ + "/transmittance.exr ", 0), 0U) << text;
    EXPECT_TRUE(contains(text, "\n  " + recipe_)) << text;
    EXPECT_EQ(bake({"--depfile", depfile}).code, 0) << "over its own";
    fs::remove_all(out_);
    expect_said(bake({"--depfile", (folder_ / "none/sky.d").string()}), 3, {"E0301"});
    EXPECT_FALSE(fs::exists(out_)) << "found before anything is made";
    EXPECT_EQ(bake({"--depfile", depfile}).code, 0);
    const std::string recipe = read_bytes(recipe_);
    for (const std::string& other : {recipe_, out_ + "/manifest.json"}) {
        const std::string before = read_bytes(other);
        expect_said(bake({"--depfile", other}), 3, {"E0303", "holds no dependencies"});
        expect_said(bake({"--depfile", other, "--force"}), 3, {"E0302", "replace"});
        EXPECT_EQ(read_bytes(other), before);
    }
    expect_said(run_program({"bake", recipe_, "-o", (folder_ / "two\nlines").string(), "--depfile",
                             depfile}),
                2, {"--depfile"});
    EXPECT_FALSE(fs::exists(folder_ / "two\nlines"));
}

TEST_F(BakeCommand, PrintsPathsOnStdoutAndTheTableOnStderr) {
    const Result result = bake();
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(result.out, out_ + "/transmittance.exr\n" + out_ + "/multiple_scattering.exr\n" +
                              out_ + "/manifest.json\n");
    expect_has(result.error, {"  texels  certificate  ", "lookup error max / rms"});
    EXPECT_EQ(files(), all_);
    EXPECT_EQ(bake({"-q"}).error, "");
}

TEST_F(BakeCommand, OnlyKeepsTheOthersEntries) {
    ASSERT_EQ(bake().code, 0);
    ASSERT_EQ(bake({"--only", "transmittance"}).code, 0);
    EXPECT_EQ(run_program({"verify", out_}).code, 0);
    EXPECT_TRUE(contains(read_bytes(out_ + "/manifest.json"), "multiple_scattering.exr"));
    expect_said(bake({"--only", "transmitance"}), 2, {"did you mean `transmittance`?"});
}

TEST_F(BakeCommand, DryRunMakesNothing) {
    const Result result = bake({"--dry-run"});
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(contains(result.out, "32x8"));
    EXPECT_FALSE(fs::exists(out_));
}

TEST_F(BakeCommand, PrunesWhatLeftTheRecipe) {
    ASSERT_EQ(bake().code, 0);
    write_bytes(out_ + "/mine.exr", "mine");
    const std::string one = "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [32, 8]\n";
    write(one);
    const Result kept = bake();
    expect_has(kept.error, {"multiple_scattering.exr is no longer in the recipe; kept"});
    const Result plan = bake({"--prune", "--dry-run"});
    EXPECT_EQ(plan.code, 0);
    expect_has(plan.out, {"multiple_scattering.exr is no longer in the recipe and would "
                          "be removed"});
    EXPECT_EQ(files(), (std::vector<std::string>{"manifest.json", "mine.exr",
                                                 "multiple_scattering.exr", "transmittance.exr"}));
    expect_said(bake({"--prune"}), 0, {"no longer in the recipe; removed"});
    const std::vector<std::string> left = {"manifest.json", "mine.exr", "transmittance.exr"};
    EXPECT_EQ(files(), left);
    EXPECT_FALSE(contains(read_bytes(out_ + "/manifest.json"), "multiple_scattering.exr"));
    EXPECT_FALSE(contains(bake({"--prune"}).error, "no longer in the recipe"));
    EXPECT_EQ(files(), left);
}

TEST_F(BakeCommand, RefusesTheFolderOfASweep) {
    const std::string sweep = (folder_ / "sweep").string();
    ASSERT_EQ(run_program({"sweep", recipe_, "--vary", "atmosphere.ground_albedo=0,1", "--certify",
                           "off", "-o", sweep})
                  .code,
              0);
    expect_said(run_program({"bake", recipe_, "-o", sweep}), 3, {"holds a sweep"});
    EXPECT_FALSE(fs::exists(sweep + "/manifest.json"));
    EXPECT_EQ(run_program({"bake", recipe_, "-o", sweep, "--dry-run"}).code, 3);
    EXPECT_EQ(run_program({"bake", recipe_, "-o", sweep, "--force"}).code, 0);
}

TEST_F(BakeCommand, AFailureIsAnEvent) {
    write("preset = \"earth_hillaire\"\n[bake.transmittance]\nsise = [32, 8]\n");
    const Result result = bake({"--json"});
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(count_lines(result.out), 1);
    EXPECT_TRUE(result.out.starts_with(
        "{\"event\":\"failed\",\"command\":\"bake\",\"exit_code\":2,\"diagnostics\":[{"))
        << result.out;
    EXPECT_TRUE(contains(result.out, "\"code\":\"E0102\"")) << result.out;
}

TEST_F(BakeCommand, JsonIsOneEventALine) {
    const Result result = bake({"--json"});
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(count_lines(result.out), 4);
    EXPECT_EQ(result.out.rfind("{\"event\":\"plan\"", 0), 0U);
    EXPECT_TRUE(contains(result.out, "\n{\"event\":\"done\""));
}

// 268 million texels take hours: said before any is made.
TEST_F(BakeCommand, ALongBakeIsSaidBeforeItBegins) {
    const auto dry = [&](const std::string& size) {
        write("preset = \"earth_hillaire\"\n[bake.sky_view]\nsize = " + size +
              "\nsun_elevations = [\"5 deg\"]\n");
        return bake({"--dry-run"});
    };
    expect_said(dry("[16384, 16384]"), 0, {"W0225", "minutes of one core, `sky_view`"});
    EXPECT_FALSE(contains(dry("[256, 256]").error, "W0225"));
}

// Ten thousand times as much air as the solver takes.
TEST_F(BakeCommand, AirThatCannotBeSolvedForIsFoundByCheck) {
    for (const char* method : {"solved", "converged"}) {
        write(std::string("preset = \"earth_hillaire\"\n[bake.multiple_scattering]\nmethod = \"") +
              method + "\"\nmapping = \"hillaire\"\n" +
              "[atmosphere]\nground_radius = \"1 m\"\ntop_radius = \"1000 km\"\n");
        expect_said(run_program({"check", recipe_}), 4, {"E0405", "up to 100 times"});
    }
}

TEST_F(BakeCommand, OneFailureLeavesTheOthers) {
    write(
        "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [32, 8]\n"
        "[bake.sharp]\nasset = \"transmittance\"\nmax_error = 2e-7\npixel_type = \"half\"\n");
    expect_said(bake(), 4,
                {"E0403", ".toml:6", "none meets max_error = 2e-07; the best, 2048x2048"});
    EXPECT_EQ(files(), (std::vector<std::string>{"manifest.json", "transmittance.exr"}));
    EXPECT_EQ(run_program({"verify", out_}).code, 0);
}

TEST_F(BakeCommand, ADiskThatFillsUpLosesNothing) {
    ASSERT_EQ(bake().code, 0);
    const std::string old = read_bytes(out_ + "/transmittance.exr");
    const auto small_files = [] {
        const rlimit limit = {2048, 2048};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    const Result result =
        run_program(words({"--set", "atmosphere.layers.rayleigh.scale_height=9 km"}), small_files);
    EXPECT_EQ(result.code, 3) << result.error;
    EXPECT_EQ(read_bytes(out_ + "/transmittance.exr"), old);
    EXPECT_EQ(files(), all_);
    EXPECT_EQ(run_program({"verify", out_}).code, 0);
}

TEST_F(BakeCommand, AFolderThatCannotBeMadeIsSaid) {
    write_bytes(out_, "a file");
    const Result result = bake();
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(read_bytes(out_), "a file");
}

TEST_F(BakeCommand, BadThreadsAndOptionsAreUsageErrors) {
    EXPECT_EQ(bake({"-j", "0"}).code, 2);
    EXPECT_EQ(bake({"-j", "two"}).code, 2);
    EXPECT_EQ(run_program({"bake", recipe_, "-o", ""}).code, 2);
    EXPECT_EQ(bake({"--certify", "maybe"}).code, 2);
    EXPECT_EQ(bake({"--set", "atmosphere.top_radius=1 km"}).code, 2);
    EXPECT_FALSE(fs::exists(out_));
}

// From its plan on, which it prints when its handlers of signals are there.
TEST_F(BakeCommand, AnInterruptLeavesNoPartialFile) {
    write(
        "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [32, 8]\n"
        "[bake.multiple_scattering]\nmethod = \"converged\"\n"
        "size = [512, 2048]\nmax_texel_error = \"0.2 %\"\n");
    for (const char* certify : {"quick", "full", "off"}) {
        for (const int work_ms : {0, 60, 150, 400}) {
            RunningProgram program(words({"--json", "--certify", certify}));
            EXPECT_TRUE(contains(program.read_line(), "\"plan\""));
            EXPECT_TRUE(program.works_for(work_ms)) << certify << ' ' << work_ms;
            program.signal(SIGINT);
            EXPECT_EQ(program.wait(), 130) << certify << ' ' << work_ms;
            EXPECT_EQ(files(), std::vector<std::string>{});
        }
    }
}

TEST_F(BakeCommand, AKilledBakeIsMadeGoodByTheNext) {
    ASSERT_EQ(bake().code, 0);
    const std::string good = read_bytes(out_ + "/multiple_scattering.exr");
    int killed = 0;
    for (const int work_ms : {0, 2, 5, 10, 20, 40, 80}) {
        fs::remove_all(out_);
        {
            RunningProgram program(words({"--json"}));
            EXPECT_TRUE(contains(program.read_line(), "\"plan\""));
            killed += program.works_for(work_ms) ? 1 : 0;
        }
        for (const std::string& name : files()) {
            // Under its own name there is a whole file or none.
            if (name == "multiple_scattering.exr") {
                EXPECT_EQ(read_bytes(out_ + "/" + name), good);
            }
        }
        EXPECT_EQ(bake().code, 0);
        EXPECT_EQ(files(), all_);
        EXPECT_EQ(read_bytes(out_ + "/multiple_scattering.exr"), good);
    }
    EXPECT_GT(killed, 0);
}

}  // namespace
}  // namespace skybake::cli
