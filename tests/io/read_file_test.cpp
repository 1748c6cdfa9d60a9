#include <sys/stat.h>
#include <unistd.h>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/sheet.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

using Kind = config::SheetLayout;

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
    const int status = in_child([&] {
        ::alarm(20);
        const auto opened = FileInput::open(folder / "pipe");
        const auto print = fingerprint(folder / "pipe");
        const bool told =
            testing::first_code(opened.diagnostics) == "E0300" &&
            testing::first_code(print.diagnostics) == "E0300" &&
            opened.diagnostics[0].message.find("not a regular file") != std::string::npos;
        return told ? 0 : 1;
    });
    EXPECT_EQ(status, 0) << "or -1 if it waited";
}

// The columns are those of config/assets/output_files.h (tests/config/output_files_test.cpp).
TEST(SheetLayout, HasTheColumnsOfItsSheetInTexels) {
    const std::array<int, 3> size = {128, 64, 32};
    EXPECT_EQ(image_size(size, testing::grid_of(size, Kind::stack, 0)),
              (std::array<std::int64_t, 2>{128, 2048}));
    const std::array<int, 3> largest = {16384, 16384, 16384};
    EXPECT_EQ(image_size(largest, testing::grid_of(largest, Kind::stack, 0))[1],
              std::int64_t{1} << 28);
    EXPECT_EQ(testing::grid_of({16, 8, 10}, Kind::atlas, 4).rows, 3);
    const SheetGrid atlas = testing::grid_of({128, 128, 128}, Kind::atlas, 0);
    EXPECT_EQ(atlas.kind, Kind::atlas);
    EXPECT_EQ(sheet_line({128, 128, 128}, atlas),
              "atlas of 16 x 8 cells of 128 x 128 texels, 128 slices row by row from the top left, "
              "row 0 first");
}

}  // namespace
}  // namespace skybake
