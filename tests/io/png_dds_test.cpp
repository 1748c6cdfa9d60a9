// PNG and DDS files, read back by readers that share nothing with the writers: libpng's simplified
// interface, and DDS by its bytes.
#include <png.h>

#include <bit>
#include <cmath>

#include "bakers/field/stored_voxels.h"
#include "bakers/io/formats/format.h"
#include "tests/io/files.h"
#include "tests/io/format_checks.h"
#include "tests/io/open_formats.h"

namespace skybake {
namespace {

using config::FileFormat;
using namespace testing;

constexpr auto kTypes = testing::kPixelTypes;

// --- PNG ----------------------------------------------------------------------------------------

TEST(Png, HoldsEachVoxelInItsPlace) {
    const TemporaryFolder folder;
    const std::array<int, 3> size = {7, 5, 6};
    for (const int channels : {1, 3, 4}) {
        for (const bool flip : {false, true}) {
            Baked volume = plain_volume(size, channels, PixelType::unorm8);
            volume.layout = config::SheetLayout::atlas;
            volume.columns = 3;
            volume.flip = flip;
            const std::string bytes = written(folder, FileFormat::png, volume, 2);
            png_image image{};
            image.version = PNG_IMAGE_VERSION;
            ASSERT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
            ASSERT_EQ(image.width, 21U);
            ASSERT_EQ(image.height, 10U);
            EXPECT_EQ(image.format & PNG_FORMAT_FLAG_LINEAR, 0U);
            image.format = channels == 1   ? PNG_FORMAT_GRAY
                           : channels == 3 ? PNG_FORMAT_RGB
                                           : PNG_FORMAT_RGBA;
            std::vector<unsigned char> samples(PNG_IMAGE_SIZE(image));
            ASSERT_TRUE(png_image_finish_read(&image, nullptr, samples.data(), 0, nullptr));
            for_each_voxel(size, [&](int x, int y, int z) {
                const int row = z / 3 * size[1] + y;
                const int column = z % 3 * size[0] + x;
                const int at = ((flip ? 9 - row : row) * 21 + column) * channels;
                for (int c = 0; c < channels; ++c) {
                    EXPECT_EQ(samples[static_cast<std::size_t>(at + c)],
                              std::lround(sample_voxel(x, y, z, c) * 255.0))
                        << x << " " << y << " " << z << " " << flip;
                }
            });
        }
    }
}

TEST(Png, ReadsBackAndDoesNotDependOnThreads) {
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
        for (const std::array<int, 3> size :
             {std::array{1, 1, 1}, {31, 7, 5}, {1031, 523, 3}, {64, 64, 50}}) {
            for (const int channels : {1, 2, 3, 4}) {
                // Parts of slices and several slices a box: once for each type.
                if (size[0] * size[1] * size[2] > 100000 && channels != 3) continue;
                Baked volume = plain_volume(size, channels == 2 ? 1 : channels, type);
                if (channels == 2) volume.channel_names = {"R", "G"};
                if (size[2] == 50) {
                    volume.layout = config::SheetLayout::atlas;
                    volume.columns = 7;
                }
                testing::expect_reads_back(FileFormat::png, volume);
            }
        }
    }
}

// Colours are numbers: a reader that is told of a gamma would change them.
TEST(Png, NamesNoColourSpace) {
    const TemporaryFolder folder;
    const std::string bytes =
        written(folder, FileFormat::png, plain_volume({4, 4, 1}, 4, PixelType::unorm8), 1);
    for (const char* chunk : {"gAMA", "sRGB", "iCCP", "cHRM", "tIME"}) {
        EXPECT_EQ(bytes.find(chunk), std::string::npos) << chunk;
    }
    EXPECT_NE(bytes.find("skybake/asset"), std::string::npos);
}

// --- DDS ----------------------------------------------------------------------------------------

// Offsets of Microsoft's documentation of DDS_HEADER and DDS_HEADER_DXT10, after the magic word.
TEST(Dds, HasTheHeaderOfDx10) {
    const TemporaryFolder folder;
    const std::string bytes =
        written(folder, FileFormat::dds, plain_volume({12, 10, 7}, 4, PixelType::half), 1);
    EXPECT_EQ(bytes.substr(0, 4), "DDS ");
    EXPECT_EQ(word(bytes, 4), 124U);
    EXPECT_EQ(word(bytes, 4 + 4), 0x1U | 0x2U | 0x4U | 0x8U | 0x1000U | 0x20000U | 0x800000U);
    EXPECT_EQ(word(bytes, 4 + 8), 10U) << "height";
    EXPECT_EQ(word(bytes, 4 + 12), 12U) << "width";
    EXPECT_EQ(word(bytes, 4 + 16), 12U * 8) << "pitch";
    EXPECT_EQ(word(bytes, 4 + 20), 7U) << "depth";
    EXPECT_EQ(word(bytes, 4 + 24), 1U) << "mips";
    EXPECT_EQ(word(bytes, 4 + 72), 32U) << "size of the pixel format";
    EXPECT_EQ(word(bytes, 4 + 76), 4U) << "four characters";
    EXPECT_EQ(bytes.substr(4 + 80, 4), "DX10");
    EXPECT_EQ(word(bytes, 4 + 104), 0x8U | 0x1000U) << "caps";
    EXPECT_EQ(word(bytes, 4 + 108), 0x200000U) << "volume";
    EXPECT_EQ(word(bytes, 128), 10U) << "R16G16B16A16_FLOAT";
    EXPECT_EQ(word(bytes, 132), 4U) << "3-D";
    EXPECT_EQ(word(bytes, 140), 1U) << "array";
    EXPECT_EQ(bytes.size(), 148U + 12 * 10 * 7 * 8);
}

TEST(Dds, NamesTheFormatOfEachPixelType) {
    const TemporaryFolder folder;
    // DXGI_FORMAT of float, half, unorm8, unorm16 with one and with four channels.
    const std::array<std::array<std::uint32_t, 2>, 4> wanted = {
        {{41, 2}, {54, 10}, {61, 28}, {56, 11}}};
    for (std::size_t i = 0; i < kTypes.size(); ++i) {
        for (const int channels : {1, 3, 4}) {
            const Baked volume = plain_volume({3, 2, 2}, channels, kTypes[i]);
            const std::string bytes = written(folder, FileFormat::dds, volume, 1);
            EXPECT_EQ(word(bytes, 128), wanted[i][channels == 1 ? 0 : 1]);
            // Bytes of one texel of three channels: a fourth, which is 1, is beside them.
            const std::size_t value = kTypes[i] == PixelType::float32  ? 4
                                      : kTypes[i] == PixelType::unorm8 ? 1
                                                                       : 2;
            EXPECT_EQ(bytes.size(), 148 + 12 * value * (channels == 1 ? 1 : 4));
        }
    }
    const std::string bytes =
        written(folder, FileFormat::dds, plain_volume({3, 2, 2}, 3, PixelType::float32), 1);
    for (std::size_t texel = 0; texel < 12; ++texel) {
        EXPECT_EQ(std::bit_cast<float>(word(bytes, 148 + texel * 16 + 12)), 1.0F);
        const std::array<int, 3> voxel = {static_cast<int>(texel % 3),
                                          static_cast<int>(texel / 3 % 2),
                                          static_cast<int>(texel / 6)};
        EXPECT_EQ(std::bit_cast<float>(word(bytes, 148 + texel * 16 + 4)),
                  stored(voxel, 1, PixelType::float32));
    }
}

// D3DFORMAT of Direct3D 9, which 2-D textures of half and float have in place of DX10's header.
TEST(Dds, NamesOldFormatsWhereTheyExist) {
    const TemporaryFolder folder;
    const std::array<std::pair<PixelType, std::array<std::uint32_t, 2>>, 2> wanted = {
        {{PixelType::float32, {114, 116}}, {PixelType::half, {111, 113}}}};
    for (const auto& [type, formats] : wanted) {
        for (const int channels : {1, 3, 4}) {
            Baked table = plain_volume({5, 3, 1}, channels, type);
            table.axes.resize(2);
            const std::string bytes = written(folder, FileFormat::dds, table, 1);
            EXPECT_EQ(word(bytes, 84), formats[channels == 1 ? 0 : 1]);
            const std::size_t stored_channels =
                channels == 3 ? 4 : static_cast<std::size_t>(channels);
            EXPECT_EQ(bytes.size(), 128 + 15 * stored_channels * (type == PixelType::half ? 2 : 4));
            EXPECT_EQ(wrong_values(FileFormat::dds, table, folder / "a.file"), 0);
        }
        Baked table = plain_volume({9, 7, 1}, 3, type);
        table.axes.resize(2);
        testing::expect_refuses_damage(FileFormat::dds, table);
    }
}

TEST(Dds, HoldsAllLevelsOneAfterTheOther) {
    const TemporaryFolder folder;
    Baked volume = plain_volume({8, 6, 5}, 1, PixelType::float32);
    volume.levels.resize(3, volume.levels[0]);
    for (std::size_t i = 1; i < 3; ++i) {
        volume.levels[i].size = next_mip_size(volume.levels[i - 1].size);
        volume.levels[i].voxels =
            std::make_shared<testing::FunctionVoxels>([i](int x, int, int, int) {
                return static_cast<float>(10 * i) + static_cast<float>(x);
            });
    }
    const std::string bytes = written(folder, FileFormat::dds, volume, 2);
    EXPECT_EQ(word(bytes, 28), 3U);
    ASSERT_EQ(bytes.size(), 148U + 4 * (8 * 6 * 5 + 4 * 3 * 2 + 2 * 1 * 1));
    EXPECT_EQ(std::bit_cast<float>(word(bytes, 148 + 4 * (8 * 6 * 5 + 3))), 13);
    EXPECT_EQ(std::bit_cast<float>(word(bytes, 148 + 4 * (8 * 6 * 5 + 4 * 3 * 2 + 1))), 21);
    const auto found = testing::texels_of(FileFormat::dds, volume, 2, folder / "a.file");
    EXPECT_EQ(found, (std::vector<float>{20, 21}));
    // A runtime computes the sizes of levels itself.
    volume.levels[1].size = {5, 3, 3};
    EXPECT_EQ(testing::write_code(FileFormat::dds, volume), "E0500");
}

// --- Several -------------------------------------------------------------------------------------

TEST(VoxelFiles, ReadBackAndDoNotDependOnThreads) {
    for (const PixelType type : kTypes) {
        for (const std::array<int, 3> size :
             {std::array{1, 1, 1}, {31, 7, 5}, {1031, 523, 3}, {67, 61, 211}}) {
            // Parts of slices and several slices a box.
            if (size[0] * size[1] * size[2] > 10000 && type != PixelType::half) continue;
            Baked volume = plain_volume(size, 3, type);
            testing::expect_reads_back(FileFormat::dds, volume);
            for (const auto compression :
                 {config::Ktx2Compression::none, config::Ktx2Compression::zstd}) {
                volume.ktx2_compression = compression;
                testing::expect_reads_back(FileFormat::ktx2, volume);
            }
            testing::expect_reads_back(FileFormat::bin, plain_volume(size, 4, type));
        }
    }
}

TEST(PngAndDds, RefuseWhatTheyCannotHold) {
    Baked volume = plain_volume({2, 2, 2}, 1, PixelType::half);
    EXPECT_EQ(testing::write_code(FileFormat::png, volume), "E0500");
    volume = plain_volume({2, 2, 2}, 4, PixelType::unorm8);
    volume.channel_names = {"a", "b", "c", "d", "e"};
    for (const FileFormat format : {FileFormat::png, FileFormat::dds}) {
        EXPECT_EQ(testing::write_code(format, volume), "E0500");
        testing::expect_says_why_it_cannot_write(format);
    }
}

// Cut short, changed in a byte, or of another shape: never a crash, and never taken for the whole.
TEST(PngAndDds, RefuseDamagedFiles) {
    const TemporaryFolder folder;
    for (const FileFormat format : {FileFormat::png, FileFormat::dds}) {
        const Baked volume = plain_volume({9, 7, 3}, 3, PixelType::unorm16);
        testing::expect_refuses_damage(format, volume);
        written(folder, format, volume, 1);
        const bool is_image = format == FileFormat::png;  // whose sheet is the same
        FileShape other = testing::shape_of(volume);
        other.size = {9, 21, 1};
        other.grid = testing::grid_of(other.size, config::SheetLayout::stack, 0);
        EXPECT_EQ(testing::read_code(format, folder / "a.file", other), is_image ? "" : "E0304");
        other = testing::shape_of(volume);
        other.channels = 4;  // as which DDS files hold three
        EXPECT_EQ(testing::read_code(format, folder / "a.file", other), is_image ? "E0304" : "");
    }
}

// Found by fuzzing: a text of 1.9 GB in a file of some hundred bytes was given its memory first.
TEST(Png, HasNoChunkLargerThanItsFile) {
    const TemporaryFolder folder;
    std::string bytes =
        written(folder, FileFormat::png, plain_volume({9, 7, 3}, 3, PixelType::unorm16), 1);
    const std::size_t name = bytes.find("iTXt");
    ASSERT_NE(name, std::string::npos);
    bytes.replace(name - 4, 4, "rrrr");
    testing::write_bytes(folder / "large_chunk", bytes);
    const auto outcome = testing::inspect_file(format_of(FileFormat::png), folder / "large_chunk");
    ASSERT_EQ(testing::first_code(outcome.diagnostics), "E0304");
    EXPECT_NE(outcome.diagnostics[0].message.find("longer than the file"), std::string::npos)
        << outcome.diagnostics[0].message;
}

}  // namespace
}  // namespace skybake
