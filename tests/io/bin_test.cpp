#include "bakers/io/formats/format.h"

#include <cmath>
#include <cstring>

#include "tests/io/format_checks.h"

namespace skybake {
namespace {

using testing::plain_volume;
using testing::sample_voxel;

constexpr PixelType kTypes[] = {PixelType::float32, PixelType::half, PixelType::unorm8,
                                PixelType::unorm16};

std::string written(const TemporaryFolder& folder, const Baked& volume, int threads) {
    return testing::written(folder, config::FileFormat::bin, volume, threads);
}

TEST(BinVolume, IsXThenYThenZWithChannelsInterleaved) {
    const TemporaryFolder folder;
    const std::array<int, 3> size = {5, 3, 2};
    const std::string bytes = written(folder, plain_volume(size, 3, PixelType::unorm8), 1);
    ASSERT_EQ(bytes.size(), 5U * 3 * 2 * 3);
    std::size_t i = 0;
    for (int z = 0; z < 2; ++z) {
        for (int y = 0; y < 3; ++y) {
            for (int x = 0; x < 5; ++x) {
                for (int c = 0; c < 3; ++c) {
                    EXPECT_EQ(static_cast<unsigned char>(bytes[i++]),
                              std::lround(sample_voxel(x, y, z, c) * 255.0));
                }
            }
        }
    }
}

TEST(BinVolume, IsLittleEndian) {
    const TemporaryFolder folder;
    const auto one = [](int, int, int, int) { return 0.25F; };
    const auto bytes_of = [&](PixelType type) {
        return written(folder, plain_volume({1, 1, 1}, 1, type, one), 1);
    };
    EXPECT_EQ(bytes_of(PixelType::float32), std::string("\x00\x00\x80\x3e", 4));
    EXPECT_EQ(bytes_of(PixelType::half), std::string("\x00\x34", 2));
    EXPECT_EQ(bytes_of(PixelType::unorm8), "\x40");
    EXPECT_EQ(bytes_of(PixelType::unorm16), std::string("\x00\x40", 2));
}

TEST(BinVolume, ReadsBackAndDoesNotDependOnThreads) {
    const TemporaryFolder folder;
    for (const PixelType type : kTypes) {
        for (const std::array<int, 3> size :
             {std::array{1, 1, 1}, {31, 7, 5}, {1031, 523, 3}, {67, 61, 211}}) {
            const Baked volume = plain_volume(size, 4, type);
            const std::string bytes = written(folder, volume, 1);
            EXPECT_TRUE(written(folder, volume, 3) == bytes);
            EXPECT_EQ(testing::wrong_values(config::FileFormat::bin, volume, folder / "a.file"), 0);
        }
    }
}

TEST(BinVolume, RefusesAnotherLength) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.bin", "1234567");
    const auto visit = [](std::int64_t, std::int64_t, const float*) { return true; };
    const FileShape shape = {{2, 2, 2}, 1, PixelType::unorm8, {}, 1};
    const auto read = bin_format().read(folder / "a.bin", shape, 0, visit);
    ASSERT_EQ(testing::first_code(read.diagnostics), "E0304");
    EXPECT_NE(read.diagnostics[0].message.find("7 bytes"), std::string::npos);
    EXPECT_EQ(
        testing::first_code(bin_format().read(folder / "absent", shape, 0, visit).diagnostics),
        "E0300");
}

TEST(BinVolume, SaysWhyItCannotWrite) {
    const Baked volume = plain_volume({64, 64, 64}, 4, PixelType::half);
    const auto full = testing::write_as(config::FileFormat::bin, volume, 2, nullptr, "/dev/full");
    ASSERT_EQ(testing::first_code(full.diagnostics), "E0301");
    EXPECT_NE(full.diagnostics[0].message.find("No space left on device"), std::string::npos);
    const Baked tiny = plain_volume({1, 1, 1}, 1, PixelType::half);
    EXPECT_EQ(
        testing::first_code(
            testing::write_as(config::FileFormat::bin, tiny, 1, nullptr, "/dev/full").diagnostics),
        "E0301");
}

}  // namespace
}  // namespace skybake
