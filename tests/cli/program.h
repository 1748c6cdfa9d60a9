// Runs the command line in this process, or the real program as a child.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "cli/run.h"
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

// The real program. `prepare` runs in the child before it starts. Exit code -1: killed by a signal.
inline Result run_program(
    std::vector<std::string> words, const std::function<void()>& prepare = [] {}) {
    const TemporaryFolder folder;
    const std::string out = (folder / "out").string();
    const std::string error = (folder / "error").string();
    words.insert(words.begin(), SKYBAKE_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
        ::dup2(::open(error.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        prepare();
        ::execv(SKYBAKE_PROGRAM, arguments.data());
        ::_exit(126);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(out), read_bytes(error)};
}

inline long count_lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

inline bool contains(const std::string& text, const std::string& piece) {
    return text.find(piece) != std::string::npos;
}

}  // namespace skybake::cli::testing
