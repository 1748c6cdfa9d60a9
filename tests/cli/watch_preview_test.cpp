// preview --watch: the real program as a child that is stopped by a signal.
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/watched_files.h"
#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::contains;
using testing::read_bytes;
using testing::TemporaryFolder;
using testing::write_bytes;

class Watcher {
  public:
    Watcher(const TemporaryFolder& folder, const std::string& recipe)
        : out_((folder / "out").string()) {
        child_ = ::fork();
        if (child_ != 0) return;
        ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
        ::dup2(::open((folder / "error").c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        ::execl(SKYBAKE_PROGRAM, SKYBAKE_PROGRAM, "preview", recipe.c_str(), "--watch", "-o",
                out_.c_str(), nullptr);
        ::_exit(126);
    }
    ~Watcher() {
        if (child_ > 0) stop(SIGKILL);
    }

    int stop(int signal) {
        ::kill(child_, signal);
        int status = 0;
        ::waitpid(child_, &status, 0);
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    json state() const {
        const std::string text = read_bytes(out_ + "/preview_state.js");
        if (text.size() < 20) return json();
        return json::parse(text.substr(15, text.size() - 18), nullptr, false);
    }
    // Waits for it as long as the program runs; false where that has ended without.
    bool becomes_true(const std::function<bool()>& holds) const {
        for (siginfo_t info{}; !holds(); ::usleep(5000)) {
            ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT);
            if (info.si_pid != 0) return holds();
        }
        return true;
    }
    bool reaches(int revision, std::size_t diagnostics) const {
        return becomes_true([&] {
            const json now = state();
            return now.is_object() && now["revision"] == revision &&
                   now["diagnostics"].size() == diagnostics;
        });
    }
    std::string page() const { return read_bytes(out_ + "/index.html"); }
    const std::string& out() const { return out_; }

  private:
    std::string out_;
    pid_t child_ = -1;
};

std::string recipe_of(const std::string& seed) {
    return "include = \"noise.toml\"\n[bake.volume]\nasset = \"noise_volume\"\nnoise = \"n\"\n"
           "size = [512, 256, 128]\n[noise.n]\nseed = " +
           seed + "\n";
}
constexpr const char* noise_text = "[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 4\n";

TEST(WatchPreview, FollowsTheRecipeAndItsIncludesUntilInterrupted) {
    const TemporaryFolder folder;
    const std::string recipe = (folder / "recipe.toml").string();
    write_bytes(folder / "noise.toml", noise_text);
    write_bytes(recipe, recipe_of("1"));
    Watcher watcher(folder, recipe);
    ASSERT_TRUE(watcher.reaches(1, 0)) << read_bytes(folder / "error");
    EXPECT_TRUE(contains(watcher.page(), "\"size\":[64,32,16]"));  // a draft
    const std::string picture = read_bytes(watcher.out() + "/volume_slices.png");

    // As editors save: a new file is renamed over the old one.
    write_bytes(folder / "new", recipe_of("2"));
    fs::rename(folder / "new", recipe);
    ASSERT_TRUE(watcher.reaches(2, 0));
    const std::string better = read_bytes(watcher.out() + "/volume_slices.png");
    EXPECT_NE(better, picture);

    // A mistake is told, and the last good pictures stay.
    write_bytes(recipe, recipe_of("'many'"));
    ASSERT_TRUE(watcher.reaches(2, 1));
    EXPECT_EQ(watcher.state()["diagnostics"][0]["line"], 7);
    EXPECT_TRUE(contains(read_bytes(folder / "error"), "recipe.toml:7:"));
    EXPECT_EQ(read_bytes(watcher.out() + "/volume_slices.png"), better);
    // So is an include that is gone; it is followed all the same.
    fs::remove(folder / "noise.toml");
    write_bytes(recipe, recipe_of("2"));
    ASSERT_TRUE(watcher.becomes_true(
        [&] { return watcher.state().dump().find("E0300") != std::string::npos; }));
    write_bytes(folder / "noise.toml", noise_text);
    ASSERT_TRUE(watcher.reaches(3, 0));
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
    ASSERT_TRUE(watcher.reaches(2, 0));
    EXPECT_TRUE(contains(watcher.page(), "volume_slices"));
    EXPECT_EQ(watcher.stop(SIGTERM), 130);
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
        EXPECT_TRUE(files.wait());
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
