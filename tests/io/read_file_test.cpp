#include "bakers/io/files/file_io.h"

#include <sys/stat.h>

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

}  // namespace
}  // namespace skybake
