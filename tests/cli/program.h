// Runs the command line in this process, or the real program as a child.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <source_location>
#include <string>
#include <vector>

#include "cli/command.h"
#include "tests/io/files.h"

namespace skybake::cli::testing {

using skybake::testing::read_bytes;
using skybake::testing::TemporaryFolder;
using skybake::testing::write_bytes;

struct Result {
    int code = -1;
    std::string out;
    std::string error;
};

// The command line in this process.
inline Result run_words(const std::vector<std::string>& words) {
    Result result;
    const auto into = [](std::string& text) {
        return Sink{[&text](std::string_view piece) {
                        text += piece;
                        return true;
                    },
                    false};
    };
    result.code = static_cast<int>(run(words, into(result.out), into(result.error)));
    return result;
}

// A recipe in a folder of its own, which is baked beside it.
class RecipeTest : public ::testing::Test {
  protected:
    std::vector<std::string> words(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all = {"bake", recipe_, "-o", out_};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    Result bake(const std::vector<std::string>& more = {}) const { return run_words(words(more)); }

    TemporaryFolder folder_;
    std::string recipe_ = (folder_ / "recipe.toml").string();
    std::string out_ = (folder_ / "out").string();
};

// Starts the real program in a child, in which `prepare` runs before.
inline pid_t start_program(std::vector<std::string> words, const std::function<void()>& prepare) {
    words.insert(words.begin(), SKYBAKE_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        prepare();
        ::execv(SKYBAKE_PROGRAM, arguments.data());
        ::_exit(126);
    }
    return child;
}

inline void write_stream_to(int stream, const std::string& file) {
    ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT, 0600), stream);
}

// The real program. `prepare` runs in the child before it starts. Exit code -1: killed by a signal.
inline Result run_program(
    const std::vector<std::string>& words, const std::function<void()>& prepare = [] {}) {
    const TemporaryFolder folder;
    const std::string out = (folder / "out").string();
    const std::string error = (folder / "error").string();
    const pid_t child = start_program(words, [&] {
        write_stream_to(STDOUT_FILENO, out);
        write_stream_to(STDERR_FILENO, error);
        prepare();
    });
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(out), read_bytes(error)};
}

// The real program at work, to be stopped at some point of it. Points are told by what it says and
// by the processor time that it has used, never by the clock on the wall: on a busy machine they
// are the same ones. Killed with its handle.
class RunningProgram {
  public:
    explicit RunningProgram(const std::vector<std::string>& words,
                            const std::string& error = "/dev/null") {
        int ends[2] = {-1, -1};
        EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0);
        child_ = start_program(words, [&] {
            ::dup2(ends[1], STDOUT_FILENO);
            write_stream_to(STDERR_FILENO, error);
        });
        ::close(ends[1]);
        out_ = ends[0];
    }
    ~RunningProgram() {
        signal(SIGKILL);
        wait();
        ::close(out_);
    }
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    // The next line of its stdout, without its end; empty where it ends before.
    std::string read_line() const {
        std::string line;
        for (char letter = 0; ::read(out_, &letter, 1) == 1 && letter != '\n';) line += letter;
        return line;
    }
    // Until it has used so much more processor time; false where it ends before.
    bool works_for(int milliseconds) const {
        for (const double start = seconds_used(); seconds_used() - start < 1e-3 * milliseconds;) {
            if (has_ended()) return false;
            ::usleep(200);  // between two looks
        }
        return true;
    }
    void signal(int number) const {
        if (child_ > 0) ::kill(child_, number);
    }
    // Its exit code; -1 where a signal killed it.
    int wait() {
        if (child_ <= 0) return code_;
        int status = 0;
        ::waitpid(child_, &status, 0);
        child_ = -1;
        return code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    bool has_ended() const {
        siginfo_t info{};
        ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT);
        return info.si_pid != 0;
    }

  private:
    double seconds_used() const {
        clockid_t clock = 0;
        timespec used{};
        if (::clock_getcpuclockid(child_, &clock) != 0 || ::clock_gettime(clock, &used) != 0)
            return 0;
        return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
    }

    pid_t child_ = -1;
    int out_ = -1;
    int code_ = -1;
};

// Sets a file's time of writing a day back, so that it tells whether the file is written again.
inline std::filesystem::file_time_type made_yesterday(const std::filesystem::path& file) {
    const auto yesterday = std::filesystem::file_time_type::clock::now() - std::chrono::hours(24);
    std::filesystem::last_write_time(file, yesterday);
    return std::filesystem::last_write_time(file);
}

inline long count_lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

inline bool contains(const std::string& text, const std::string& piece) {
    return text.find(piece) != std::string::npos;
}

// Expects all of these pieces in a text.
inline void expect_has(const std::string& text, const std::vector<std::string>& pieces,
                       const std::source_location& place = std::source_location::current()) {
    const ::testing::ScopedTrace trace(place.file_name(), static_cast<int>(place.line()), "here");
    for (const std::string& piece : pieces) {
        EXPECT_TRUE(contains(text, piece)) << "no `" << piece << "` in\n" << text;
    }
}

// Expects how a run ends, and all of these pieces in what it says to people.
inline void expect_said(const Result& result, int code, const std::vector<std::string>& pieces,
                        const std::source_location& place = std::source_location::current()) {
    const ::testing::ScopedTrace trace(place.file_name(), static_cast<int>(place.line()), "here");
    EXPECT_EQ(result.code, code) << result.error;
    expect_has(result.error, pieces, place);
}

}  // namespace skybake::cli::testing

namespace skybake::cli {

// Tests speak of these.
using testing::contains;
using testing::count_lines;
using testing::expect_has;
using testing::expect_said;
using testing::Result;
using testing::run_words;

}  // namespace skybake::cli
