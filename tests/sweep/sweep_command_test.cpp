// `skybake sweep` from outside: exit codes, words, tasks, and a process that is killed.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <utility>

#include "cli/sweep.h"
#include "tests/cli/program.h"
#include "tests/sweep/sweeps.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using skybake::testing::files_below;
using skybake::testing::swept_recipe;
using Strings = std::vector<std::string>;

struct Folder {
    TemporaryFolder folder;
    std::string recipe = (folder / "r.toml").string();

    explicit Folder(const std::string& text = swept_recipe) { write_bytes(recipe, text); }
    std::string out(const std::string& name = "out") const { return (folder / name).string(); }
    Strings words(const Strings& vary, const Strings& more = {},
                  const std::string& to = "out") const {
        Strings words = {"sweep", recipe, "-o", out(to)};
        words.insert(words.end(), vary.begin(), vary.end());
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    Result sweep(const Strings& vary, const Strings& more = {}) const {
        return run_words(words(vary, more));
    }
};

TEST(SweepCommand, BakesAndWritesItsIndex) {
    const Folder folder;
    const Result result =
        folder.sweep({"--vary", "clouds.c.coverage=0.5:0.9:3", "--vary", "noise.n.seed=1,2"});
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_TRUE(contains(result.error, "6 variants; 6 share n (baked 2 times)\n")) << result.error;
    // Lists the files of both assets and the manifest of each variant, and the four files of the index.
    EXPECT_EQ(count_lines(result.out), 6 * 3 + 4);
    std::istringstream paths(result.out);
    for (std::string path; std::getline(paths, path);) EXPECT_TRUE(fs::exists(path)) << path;
    EXPECT_TRUE(contains(result.error, "6 variants baked, ")) << result.error;
    for (const char* name : {"index.csv", "index.jsonl", "sweep.json", "timing.csv"}) {
        EXPECT_TRUE(contains(result.out, name)) << result.out;
        EXPECT_TRUE(fs::exists(fs::path(folder.out()) / name));
    }
    const Result again =
        folder.sweep({"--vary", "clouds.c.coverage=0.5:0.9:3", "--vary", "noise.n.seed=1,2"});
    EXPECT_TRUE(contains(again.error, "6 variants, 6 up to date\n")) << again.error;
    EXPECT_EQ(run_words({"verify", folder.out() + "/0001_coverage=0.5_seed=2"}).code, 0);
}

// Whoever bakes a hundred variants of a coarse noise reads so once.
TEST(SweepCommand, SaysTheSameWarningOfManyVariantsOnce) {
    const Folder folder(
        std::regex_replace(swept_recipe, std::regex("frequency = 2"), "frequency = 4"));
    const auto warnings = [](const std::string& text) {
        std::size_t count = 0;
        for (std::size_t at = 0; (at = text.find("W0203", at)) != std::string::npos; ++at) ++count;
        return count;
    };
    const std::size_t of_one = warnings(run_words({"check", folder.recipe}).error);
    EXPECT_GT(of_one, 0U);
    EXPECT_EQ(warnings(folder.sweep({"--vary", "noise.n.seed=1,2,3"}).error), of_one);
}

TEST(SweepCommand, ListsWithoutMaking) {
    const Folder folder;
    const Result result = folder.sweep(
        {"--vary", "clouds.c.coverage=0.5,1.5", "--dry-run", "--diagnostics", "short"});
    EXPECT_EQ(result.code, 4);
    expect_has(result.out, {"0000_coverage=0.5  n: not baked yet; c: not baked yet\n",
                            "0001_coverage=1.5  cannot be baked: E0110: "});
    EXPECT_FALSE(fs::exists(folder.out()));
}

// Variants of a file's pixel type and size need one light, variants of the air one each.
TEST(SweepCommand, ListsWhatIsMadeOnceForAllVariants) {
    const Folder folder(
        "preset = \"earth_hillaire\"\n[bake.v]\nasset = \"sky_view\"\nsize = [8, "
        "8]\nsun_elevations = [\"9 deg\"]\n");
    const Result same = folder.sweep({"--vary", "bake.v.pixel_type=\"half\",\"float\"", "--vary",
                                      "bake.v.size=[8,8],[16,16]", "--dry-run"});
    EXPECT_TRUE(std::regex_search(
        same.error, std::regex("made once: solved light \\([^)]*\\) for 4 variants\n")))
        << same.error;
    const Result others =
        folder.sweep({"--vary", "atmosphere.ground_albedo=0.1,0.2", "--dry-run", "--json"});
    const std::regex one_each(R"("name":"solved light","seconds":[^}]*"variants":1\})");
    const auto begin = std::sregex_iterator(others.out.begin(), others.out.end(), one_each);
    EXPECT_EQ(std::distance(begin, std::sregex_iterator()), 2) << others.out;
}

TEST(SweepCommand, ListsWhatFailedLastTime) {
    const Folder folder(swept_recipe + "pixel_type = \"half\"\n");
    const Strings vary = {"--vary", "noise.n.channels.Y.remap=[[0, 1, 0, 1], [0, 1, 0, 1e6]]"};
    EXPECT_EQ(folder.sweep(vary).code, 4);
    const Result list = folder.sweep(vary, {"--dry-run"});
    EXPECT_EQ(list.code, 0);
    EXPECT_TRUE(contains(list.out, "; it failed last time: E0402: ")) << list.out;
    EXPECT_EQ(count_lines(list.out), 2);
}

TEST(SweepCommand, MentionsFoldersOfEarlierValues) {
    const Folder folder;
    EXPECT_EQ(folder.sweep({"--vary", "noise.n.seed=1,2,3"}).code, 0);
    fs::create_directories(folder.out("out/0009_mine"));
    const Strings fewer = {"--vary", "noise.n.seed=1,5"};
    const std::string note =
        "2 folders are no longer in the sweep; kept: 0001_seed=2, 0002_seed=3\n";
    const Result swept = folder.sweep(fewer);
    EXPECT_TRUE(contains(swept.error, note)) << swept.error;
    const Result merged = folder.sweep(fewer, {"--merge"});
    EXPECT_TRUE(contains(merged.error, note)) << merged.error;
    const Result all = folder.sweep({"--vary", "noise.n.seed=1,2,3"});
    expect_has(all.error, {"1 folder is no longer in the sweep; kept: 0001_seed=5\n"});
}

// A pipe would be empty for the second variant, or wait for ever.
TEST(SweepCommand, RefusesAPipe) {
    const Folder folder;
    fs::remove(folder.recipe);
    ASSERT_EQ(::mkfifo(folder.recipe.c_str(), 0600), 0);
    expect_said(folder.sweep({"--vary", "noise.n.seed=1,2"}), 3, {"E0300", "not a regular file"});
}

TEST(SweepCommand, NamesTheOptionOfAValueAtFault) {
    const Folder folder;
    const Result result = folder.sweep({"--vary", "clouds.c.coverage=-1,0.5"});
    EXPECT_EQ(result.code, 4);
    EXPECT_TRUE(contains(result.error, "--vary `clouds.c.coverage=-1`")) << result.error;
    EXPECT_FALSE(contains(result.error, "--set")) << result.error;
}

TEST(SweepCommand, AFailingVariantEndsInExitCode4) {
    const Folder folder;
    expect_said(folder.sweep({"--vary", "clouds.c.coverage=0.5,1.5"}), 4,
                {"1 of 2 variants failed: 0001_coverage=1.5"});
    EXPECT_TRUE(fs::exists(folder.out() + "/0000_coverage=0.5/manifest.json"));
    EXPECT_TRUE(fs::exists(folder.out() + "/0001_coverage=1.5/error.json"));
}

// A fault of all variants is a fault of the recipe, and said once.
TEST(SweepCommand, AFaultOfTheRecipeIsNoFailureOfItsVariants) {
    const Folder folder(swept_recipe + "nonsense = 1\n");
    expect_said(folder.sweep({"--vary", "clouds.c.coverage=0.5,0.6"}), 2, {"E0102"});
    EXPECT_FALSE(fs::exists(folder.out()));
}

TEST(SweepCommand, RefusesWhatMakesNoSense) {
    const Folder folder;
    EXPECT_EQ(folder.sweep({}).code, 2);
    const auto with = [&](const Strings& more) {
        return folder.sweep({"--vary", "noise.n.seed=1,2"}, more).code;
    };
    for (const char* shard : {"0/2", "3/2", "1", "1/", "/2", "a/b", "1/2/3", "-1/2", ""}) {
        EXPECT_EQ(with({"--shard", shard}), 2) << shard;
    }
    EXPECT_EQ(with({"--shard", "1/2", "--merge"}), 2);
    EXPECT_EQ(with({"--emit", "commands", "--merge"}), 2);
    EXPECT_EQ(with({"--emit", "slurm"}), 2);
    EXPECT_EQ(with({"--emit", "commands", "--tasks", "0"}), 2);
    EXPECT_EQ(with({"--emit", "commands", "--set", "preset=a\nb"}), 2);
    EXPECT_EQ(with({"-j", "0"}), 2);
    EXPECT_EQ(with({"--max-memory", "much"}), 2);
    EXPECT_FALSE(fs::exists(folder.out()));
}

// The reverse of a bake into the folder of a sweep.
TEST(SweepCommand, RefusesTheFolderOfABake) {
    const Folder folder;
    const Strings vary = {"--vary", "noise.n.seed=1,2"};
    ASSERT_EQ(run_words({"bake", folder.recipe, "-o", folder.out()}).code, 0);
    for (const Strings& more : {Strings{}, Strings{"--shard", "1/2"}, Strings{"--dry-run"}}) {
        expect_said(folder.sweep(vary, more), 3, {"E0303", "holds a bake"});
    }
    EXPECT_FALSE(fs::exists(folder.out("out/0000_seed=1")));
    EXPECT_EQ(folder.sweep(vary, {"--force"}).code, 0);
}

TEST(SweepCommand, ShardsThenMerge) {
    const Folder folder;
    const auto with = [&](const Strings& more) {
        return folder.sweep({"--vary", "noise.n.seed=1,2,3"}, more);
    };
    expect_said(with({"--shard", "1/2"}), 0, {"3 variants, 2 in this shard"});
    EXPECT_FALSE(fs::exists(folder.out() + "/index.csv"));
    expect_said(with({"--merge"}), 4, {"1 of 3 variants is not baked yet: 0001_seed=2"});
    EXPECT_EQ(with({"--shard", "2/2"}).code, 0);
    EXPECT_EQ(with({"--merge"}).code, 0);
}

TEST(SweepCommand, TellsMachines) {
    const Folder folder;
    const Result result = folder.sweep({"--vary", "noise.n.seed=1,2", "--json", "-q"});
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(result.error.empty()) << result.error;
    Strings events;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
        events.push_back(nlohmann::json::parse(line)["event"]);
    }
    EXPECT_EQ(events, (Strings{"sweep", "variant", "variant", "swept"}));
}

TEST(SweepTasks, WordsSurviveTheShell) {
    EXPECT_EQ(shell_word("clouds.c.coverage=0.2:0.8:4"), "clouds.c.coverage=0.2:0.8:4");
    EXPECT_EQ(shell_word(""), "''");
    EXPECT_EQ(shell_word("1 km"), "'1 km'");
    EXPECT_EQ(shell_word("it's $HOME `x` \"y\" \\"), "'it'\\''s $HOME `x` \"y\" \\'");
}

// Every line is run by a shell as it stands; together they and the merge are the sweep.
TEST(SweepTasks, CommandsAreTheSweep) {
    const Folder folder;
    const Strings vary = {"--vary", "clouds.c.base_altitude=1 km,'2 km',3 km"};
    const auto with = [&](const Strings& more, const std::string& out) {
        return folder.words(vary, more, out);
    };
    EXPECT_EQ(run_words(with({}, "whole")).code, 0);
    const Result script =
        testing::run_program(with({"--emit", "commands", "--tasks", "2"}, "it's parts"));
    ASSERT_EQ(script.code, 0) << script.error;
    EXPECT_EQ(count_lines(script.out), 2);
    std::istringstream lines(script.out);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_EQ(std::system((line + " -q >/dev/null").c_str()), 0) << line;
        EXPECT_EQ(std::system((line + " -q >/dev/null").c_str()), 0) << "again: " << line;
    }
    EXPECT_EQ(run_words(with({"--merge"}, "it's parts")).code, 0);
    EXPECT_EQ(files_below(folder.out("it's parts")), files_below(folder.out("whole")));
}

// A farm starts its tasks in folders of its own, by one of these programs; the paths of the recipe
// and the sweep were relative, with a quote and blanks in them.
TEST(SweepTasks, CommandsRunFromAnyFolder) {
    const Folder folder;
    const auto in_folder = [&] {
        if (::chdir(folder.folder.path().c_str()) != 0) ::_exit(125);
    };
    const Strings words = {"sweep", "r.toml", "--vary", "clouds.c.base_altitude=1 km,'2 km'"};
    const auto with = [&](const std::string& out, Strings more) {
        Strings all = words;
        all.insert(all.end(), {"-o", out, "--cache-dir", "the cache"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    ASSERT_EQ(testing::run_program(with("whole", {}), in_folder).code, 0);
    fs::create_directory(folder.folder / "elsewhere");
    const std::string there = "cd " + shell_word(folder.out("elsewhere")) + " && ";
    const std::pair<const char*, const char*> engines[] = {
        {"it's sh", "sh"},
        {"it's xargs", "xargs -d '\\n' -I{} sh -c '{}'"},
        {"it's parallel", "parallel"},
    };
    for (const auto& [out, engine] : engines) {
        const std::string name = std::string(engine).substr(0, std::string(engine).find(' '));
        if (std::system(("command -v " + name + " >/dev/null").c_str()) != 0) continue;
        const Result script = testing::run_program(with(out, {"--emit", "commands"}), in_folder);
        ASSERT_EQ(script.code, 0) << script.error;
        const std::string file = folder.out("commands.txt");
        write_bytes(file, script.out);
        const std::string run =
            there + engine + " <" + shell_word(file) + " >/dev/null 2>" + shell_word(file + ".log");
        EXPECT_EQ(std::system(run.c_str()), 0)
            << engine << ": " << skybake::testing::read_bytes(file + ".log");
        EXPECT_EQ(testing::run_program(with(out, {"--merge"}), in_folder).code, 0);
        EXPECT_EQ(files_below(folder.out(out)), files_below(folder.out("whole"))) << engine;
    }
    EXPECT_TRUE(fs::is_empty(folder.folder / "elsewhere"));
}

int manifests_in(const fs::path& folder) {
    int count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        count += fs::exists(entry.path() / "manifest.json", error) ? 1 : 0;
    }
    return count;
}

// Nothing is lost and nothing done again, wherever the process was.
TEST(SweepCommand, GoesOnAfterAKill) {
    const Folder folder;
    const Strings vary = {"--vary", "noise.n.seed=1:5:5", "--vary", "clouds.c.coverage=0.5:0.9:8"};
    const Strings words = folder.words(vary);
    for (const int enough : {1, 6, 15, 30}) {
        const testing::RunningProgram program(words);
        while (manifests_in(folder.out()) < enough && !program.has_ended()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    const int there = manifests_in(folder.out());
    EXPECT_GE(there, 30);
    const Result rest = folder.sweep(vary, {"--json", "-q"});
    EXPECT_EQ(rest.code, 0);
    const auto last =
        nlohmann::json::parse(rest.out.substr(rest.out.rfind("{\"event\":\"swept\"")));
    EXPECT_EQ(last["done"], 40);
    // Variants with a manifest were complete, but for those that were at work when it was killed.
    EXPECT_LE(last["made"], 40 - there + 2 * static_cast<int>(std::thread::hardware_concurrency()));
    EXPECT_EQ(run_words(folder.words(vary, {"-q"}, "fresh")).code, 0);
    EXPECT_EQ(files_below(folder.out()), files_below(folder.out("fresh")));
}

}  // namespace
}  // namespace skybake::cli
