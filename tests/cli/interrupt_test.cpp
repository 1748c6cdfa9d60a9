#include "cli/console.h"

#include <csignal>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/output_folder.h"
#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

class UntilInterrupted : public Progress {
  public:
    void advance(std::string_view, double) override {}
    bool cancelled() const override { return interrupted(); }
};

// Writes large files until it is stopped; says so when its handlers are there and again after each
// signal that it has heard.
[[noreturn]] void write_until_stopped(const TemporaryFolder& folder, int says, bool obeys) {
    install_signal_handlers();
    bool heard = false;
    ssize_t told = ::write(says, "r", 1);
    const UntilInterrupted progress;
    const std::string texts[2] = {std::string(3000000, 'a'), std::string(3000000, 'b')};
    for (int i = 0; told == 1 && !(obeys && interrupted()); ++i) {
        // A write that was interrupted fails, as it should.
        static_cast<void>(
            write_file_atomically(folder / "a", texts[i % 2], obeys ? &progress : nullptr));
        if (interrupted() && !heard) {
            heard = true;
            told = ::write(says, "h", 1);
        }
    }
    ::_exit(static_cast<int>(ExitCode::interrupted));
}

bool is_writing(const TemporaryFolder& folder) {
    const std::vector<std::string> names = folder.names();
    return std::any_of(names.begin(), names.end(),
                       [](const std::string& name) { return testing::contains(name, ".tmp"); });
}

// The exit code of a child that works and gets `times` signals, each after it has said so and as soon as
// it may be stopped; -1 where one killed it.
int stopped(int signal, int times, const std::function<bool()>& may_stop,
            const std::function<void(int says)>& work) {
    int ends[2] = {-1, -1};
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) work(ends[1]);
    ::close(ends[1]);
    for (int i = 0; i < times; ++i) {
        char byte = 0;
        EXPECT_EQ(::read(ends[0], &byte, 1), 1);
        while (!may_stop()) ::usleep(100);
        ::kill(child, signal);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ::close(ends[0]);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int stop_a_writer(const TemporaryFolder& folder, int signal, int times, bool obeys) {
    return stopped(
        signal, times, [&] { return is_writing(folder); },
        [&](int says) { write_until_stopped(folder, says, obeys); });
}

TEST(Interrupt, TheFirstSignalAsksToStop) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const TemporaryFolder folder;
        EXPECT_EQ(stop_a_writer(folder, signal, 1, true), 130);
        for (const std::string& name : folder.names()) EXPECT_EQ(name, "a");
    }
}

TEST(Interrupt, TheSecondSignalEndsAtOnceAndLeavesNoTemporary) {
    for (int round = 0; round < 5; ++round) {
        const TemporaryFolder folder;
        EXPECT_EQ(stop_a_writer(folder, SIGINT, 2, false), 130);
        for (const std::string& name : folder.names()) EXPECT_EQ(name, "a");
    }
}

// Makes a folder and begins a file in it, then computes for a minute without asking whether it was
// interrupted.
[[noreturn]] void compute_for_a_minute(const TemporaryFolder& folder, int says) {
    install_signal_handlers();
    const auto made = create_output_folder(folder / "made");
    AtomicFiles files;
    const auto write = [says](const std::filesystem::path&) {
        for (int tenths = ::write(says, "r", 1) == 1 ? 600 : 0; tenths > 0; --tenths) {
            ::usleep(100000);
        }
        return config::Outcome<bool>{false, {}};
    };
    static_cast<void>(files.stage(folder / "made/a", write));
    ::_exit(made.value ? 7 : 8);
}

TEST(Interrupt, OneSignalEndsAProcessThatDoesNotListen) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const TemporaryFolder folder;
        const auto work = [&](int says) { compute_for_a_minute(folder, says); };
        EXPECT_EQ(stopped(
                      signal, 1, [] { return true; }, work),
                  130);
        EXPECT_EQ(folder.names(), std::vector<std::string>());
    }
}

}  // namespace
}  // namespace skybake::cli
