#include "cli/interrupt.h"

#include <csignal>
#include <thread>

#include "bakers/io/atomic_file.h"
#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

using testing::TemporaryFolder;

class UntilInterrupted : public Progress {
  public:
    void advance(std::string_view, double) override {}
    bool cancelled() const override { return interrupted(); }
};

// Writes large files until it is stopped; -1 where it was killed.
int stop_a_writer(const TemporaryFolder& folder, int signal, int times, bool obeys) {
    int ready[2] = {-1, -1};
    EXPECT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        install_signal_handlers();
        ::close(ready[0]);
        ::close(ready[1]);  // the parent waits for this: a signal any earlier would kill
        const UntilInterrupted progress;
        const std::string texts[2] = {std::string(3000000, 'a'), std::string(3000000, 'b')};
        for (int i = 0; !obeys || !interrupted(); ++i) {
            write_file_atomically(folder / "a", texts[i % 2], obeys ? &progress : nullptr);
        }
        ::_exit(static_cast<int>(ExitCode::interrupted));
    }
    ::close(ready[1]);
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 0);
    ::close(ready[0]);
    for (int i = 0; i < times; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        ::kill(child, signal);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
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

}  // namespace
}  // namespace skybake::cli
