// preview --watch: the real program as a child that is stopped by a signal.
#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "cli/preview.h"
#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Watcher {
  public:
    Watcher(const TemporaryFolder& folder, const std::string& recipe,
            std::vector<std::string> words = {})
        : out_((folder / "out").string()) {
        words.insert(words.begin(), {"preview", recipe, "--watch", "-o", out_});
        program_.emplace(words, (folder / "error").string());
    }

    int stop(int signal) {
        program_->signal(signal);
        return program_->wait();
    }

    json state() const {
        const std::string text = read_bytes(out_ + "/preview_state.js");
        if (text.size() < 20) return json();
        return json::parse(text.substr(15, text.size() - 18), nullptr, false);
    }
    // Waits for it as long as the program runs; false where that has ended without.
    bool becomes_true(const std::function<bool()>& holds) const {
        for (; !holds(); ::usleep(5000)) {
            if (program_->has_ended()) return holds();
        }
        return true;
    }
    // Revisions count pages: each save brings a draft's, and one of full quality.
    bool reaches(int revision, std::size_t diagnostics) const {
        return becomes_true([&] {
            const json now = state();
            return now.is_object() && now["revision"] == revision &&
                   now["diagnostics"].size() == diagnostics;
        });
    }
    std::string quality() const { return state()["quality"]; }
    std::string page() const { return read_bytes(out_ + "/index.html"); }
    const std::string& out() const { return out_; }

  private:
    std::string out_;
    std::optional<testing::RunningProgram> program_;
};

std::string recipe_of(const std::string& seed) {
    return "include = \"noise.toml\"\n[bake.volume]\nasset = \"noise_volume\"\nnoise = \"n\"\n"
           "size = [128, 64, 32]\n[noise.n]\nseed = " +
           seed + "\n";
}
constexpr const char* noise_text = "[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 4\n";

TEST(WatchPreview, FollowsTheRecipeAndItsIncludesUntilInterrupted) {
    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    write_bytes(folder / "noise.toml", noise_text);
    write_bytes(recipe, recipe_of("1"));
    Watcher watcher(folder, recipe);
    ASSERT_TRUE(watcher.reaches(2, 0)) << read_bytes(folder / "error");
    EXPECT_EQ(watcher.quality(), "full");
    EXPECT_TRUE(contains(watcher.page(), "\"size\":[128,64,32]"));
    EXPECT_TRUE(contains(read_bytes(folder / "error"), "index.html: a draft in "));
    const std::string picture = read_bytes(watcher.out() + "/volume_slices.png");

    // Saves as editors do: a new file is renamed over the old one.
    write_bytes(folder / "new", recipe_of("2"));
    fs::rename(folder / "new", recipe);
    ASSERT_TRUE(watcher.reaches(4, 0));
    const std::string better = read_bytes(watcher.out() + "/volume_slices.png");
    EXPECT_NE(better, picture);

    // A mistake is told, and the last good pictures stay.
    write_bytes(recipe, recipe_of("'many'"));
    // On a busy machine the file may be seen while it is being written.
    ASSERT_TRUE(watcher.becomes_true([&] {
        const json now = watcher.state();
        return now.is_object() && now["diagnostics"].size() == 1 &&
               now["diagnostics"][0]["line"] == 7;
    }));
    EXPECT_EQ(watcher.state()["revision"], 4);
    EXPECT_TRUE(contains(read_bytes(folder / "error"), "recipe.toml:7:"));
    EXPECT_EQ(read_bytes(watcher.out() + "/volume_slices.png"), better);
    // So is an include that is gone; it is followed all the same.
    fs::remove(folder / "noise.toml");
    write_bytes(recipe, recipe_of("2"));
    ASSERT_TRUE(watcher.becomes_true(
        [&] { return watcher.state().dump().find("E0300") != std::string::npos; }));
    write_bytes(folder / "noise.toml", noise_text);
    ASSERT_TRUE(watcher.reaches(6, 0));
    EXPECT_EQ(read_bytes(watcher.out() + "/volume_slices.png"), better);

    EXPECT_EQ(watcher.stop(SIGINT), 130);
    EXPECT_EQ(watcher.state()["ended"], true);
    for (const auto& entry : fs::directory_iterator(watcher.out())) {
        EXPECT_NE(entry.path().extension(), ".tmp");
    }
}

TEST(WatchPreview, ARecipeThatWasNeverRightGetsAPageToo) {
    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    write_bytes(recipe, "preset = 1");
    Watcher watcher(folder, recipe);
    ASSERT_TRUE(watcher.reaches(1, 1));
    EXPECT_TRUE(contains(watcher.page(), "recipe.toml"));
    write_bytes(folder / "noise.toml", noise_text);
    write_bytes(recipe, recipe_of("1"));
    ASSERT_TRUE(watcher.reaches(3, 0));
    EXPECT_TRUE(contains(watcher.page(), "volume_slices"));
    EXPECT_EQ(watcher.stop(SIGTERM), 130);
}

// Work that would take an hour at full quality is given up once its recipe is saved anew, and at Ctrl-C.
TEST(WatchPreview, ASaveEndsTheWorkOnWhatWasBefore) {
    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    const auto large = [](const std::string& seed) {
        std::string text = recipe_of(seed);
        const std::string size = "[128, 64, 32]";
        return text.replace(text.find(size), size.size(), "[1024, 1024, 256]\nmips = 1");
    };
    write_bytes(folder / "noise.toml", noise_text);
    write_bytes(recipe, large("1"));
    Watcher watcher(folder, recipe, {"--draft", "32"});
    ASSERT_TRUE(watcher.reaches(1, 0)) << read_bytes(folder / "error");
    EXPECT_EQ(watcher.quality(), "draft");
    EXPECT_TRUE(contains(watcher.page(), "\"size\":[32,32,8]"));
    write_bytes(recipe, large("2"));
    ASSERT_TRUE(watcher.reaches(2, 0));
    EXPECT_EQ(watcher.quality(), "draft");
    write_bytes(recipe, recipe_of("2"));
    ASSERT_TRUE(watcher.reaches(4, 0));
    EXPECT_EQ(watcher.quality(), "full");
    write_bytes(recipe, large("3"));
    ASSERT_TRUE(watcher.reaches(5, 0));
    EXPECT_EQ(watcher.stop(SIGINT), 130);
}

// Lit clouds at full quality come before all other pictures, as a page of their own.
TEST(WatchPreview, ShowsCloudsAtFullQualityFirst) {
    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    write_bytes(folder / "noise.toml", noise_text);
    write_bytes(recipe,
                "include = \"noise.toml\"\n[noise.n]\nseed = 1\n[clouds.c]\nnoise = \"n\"\n"
                "extent = [\"3 km\", \"2 km\", \"0.75 km\"]\nbase_altitude = \"1 km\"\n"
                "coverage = 0.6\nextinction_scale = \"40 /km\"\n[bake.volume]\n"
                "asset = \"cloud_volume\"\ncloud = \"c\"\nsize = [96, 64, 24]\n"
                "[preview]\nsize = [96, 54]\n");
    Watcher watcher(folder, recipe, {"--draft", "32"});
    ASSERT_TRUE(watcher.reaches(3, 0)) << read_bytes(folder / "error");
    EXPECT_EQ(watcher.quality(), "full");
    EXPECT_TRUE(contains(read_bytes(folder / "error"), "index.html: clouds at full quality in "));
    EXPECT_TRUE(contains(read_bytes(watcher.out() + "/preview_page.js"), "\"size\":[96,64,24]"));
    EXPECT_EQ(watcher.stop(SIGINT), 130);
}

TEST(WatchPreview, ARecipeThatIsNotThereIsNotWaitedFor) {
    const TemporaryFolder folder;
    EXPECT_EQ(testing::run_program({"preview", (folder / "absent.toml").string(), "--watch", "-o",
                                    (folder / "out").string()})
                  .code,
              3);
}

TEST(WatchedFiles, SeeWritingReplacingRemovingAndMaking) {
    const TemporaryFolder folder;
    const fs::path path = folder / "a";
    write_bytes(path, "1");
    WatchedFiles files;
    files.follow({path, folder / "b"});
    const std::function<void()> changes[] = {
        [&] { write_bytes(path, "22"); },
        [&] {
            write_bytes(folder / "c", "33");
            fs::rename(folder / "c", path);
        },
        [&] { fs::remove(path); },
        [&] { write_bytes(folder / "b", ""); },
    };
    for (const auto& change : changes) {
        change();  // before the wait: nothing between two waits is missed
        files.follow({path, folder / "b"});
        EXPECT_TRUE(files.changed());
        EXPECT_TRUE(files.wait());
        EXPECT_FALSE(files.changed());
    }
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(60));
        write_bytes(path, "4");
    });
    EXPECT_TRUE(files.wait());
    later.join();
}

}  // namespace
}  // namespace skybake::cli
