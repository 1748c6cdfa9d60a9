#include "bakers/io/files/file_io.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/io/files.h"

namespace skybake {
namespace {

using testing::TemporaryFolder;

std::string reason_for(const std::filesystem::path& path, std::uintmax_t limit = 100) {
    const auto bytes = read_file(path, limit);
    EXPECT_FALSE(bytes.value.has_value());
    EXPECT_EQ(testing::first_code(bytes.diagnostics), "E0300");
    return bytes.diagnostics.empty() ? "" : bytes.diagnostics[0].message;
}

TEST(ReadFile, ReadsAllBytes) {
    const TemporaryFolder folder;
    const std::string bytes("a\0b", 3);
    testing::write_bytes(folder / "a", bytes);
    EXPECT_EQ(read_file(folder / "a").value, bytes);
}

TEST(ReadFile, SaysWhyItCannot) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "large", std::string(101, 'x'));
    ::mkfifo((folder / "pipe").c_str(), 0600);
    EXPECT_NE(reason_for(folder / "absent").find("No such file or directory"), std::string::npos);
    EXPECT_NE(reason_for(folder.path()).find("it is a folder"), std::string::npos);
    EXPECT_NE(reason_for(folder / "pipe").find("not a regular file"), std::string::npos);
    EXPECT_NE(reason_for(folder / "large").find("101 bytes"), std::string::npos);
}

// Nobody writes to the pipe, so that a program which waited for it would wait for ever.
TEST(FileInput, RefusesAPipeAtOnce) {
    const TemporaryFolder folder;
    ::mkfifo((folder / "pipe").c_str(), 0600);
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(20);
        const auto opened = FileInput::open(folder / "pipe");
        const auto print = fingerprint(folder / "pipe");
        const bool told = testing::first_code(opened.diagnostics) == "E0300" &&
                          testing::first_code(print.diagnostics) == "E0300" &&
                          opened.diagnostics[0].message.find("not a regular file") != std::string::npos;
        ::_exit(told ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << "it waited";
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace skybake
