// Mitsuba's vol, NumPy's npy, TGA and USD files, held to the bytes that their documents prescribe.
#include <fmt/format.h>

#include <cmath>

#include "bakers/io/formats/format.h"
#include "tests/io/files.h"
#include "tests/io/format_checks.h"
#include "tests/io/open_formats.h"

namespace skybake {
namespace {

using config::FileFormat;
using namespace testing;

// --- vol ----------------------------------------------------------------------------------------

TEST(Vol, HasTheHeadOfMitsubasGridVolume) {
    const TemporaryFolder folder;
    for (const PixelType type : {PixelType::float32, PixelType::half}) {
        Baked volume = plain_volume({5, 4, 3}, 3, type);
        volume.voxel_size_m = {10, 20, 5};
        volume.minimum_m = {-100, 300, 1000};
        const std::string bytes = written(folder, FileFormat::vol, volume, 2);
        EXPECT_EQ(bytes.substr(0, 4), "VOL\3");
        const std::array<std::int32_t, 5> wanted = {1, 5, 4, 3, 3};
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            EXPECT_EQ(number<std::int32_t>(bytes, 4 + 4 * i), wanted[i]) << i;
        }
        const std::array<float, 6> bounds = {-100, 300, 1000, -50, 380, 1015};
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            EXPECT_EQ(number<float>(bytes, 24 + 4 * i), bounds[i]) << i;
        }
        ASSERT_EQ(bytes.size(), 48U + 5 * 4 * 3 * 3 * 4);
        // Voxel (4, 1, 2), channel 1.
        const std::size_t at = 48 + 4 * (((2 * 4 + 1) * 5 + 4) * 3 + 1);
        EXPECT_EQ(number<float>(bytes, at), stored({4, 1, 2}, 1, type));
        EXPECT_EQ(testing::wrong_values(FileFormat::vol, volume, folder / "a.file"), 0);
    }
}

TEST(Vol, NoiseLiesInTheUnitCube) {
    const TemporaryFolder folder;
    Baked volume = plain_volume({4, 4, 4}, 1, PixelType::float32);
    volume.voxel_size_m = {};
    const std::string bytes = written(folder, FileFormat::vol, volume, 1);
    EXPECT_EQ(number<float>(bytes, 24), 0);
    EXPECT_EQ(number<float>(bytes, 44), 1);
}

TEST(Vol, ReadsBackAndRefusesDamage) {
    testing::expect_reads_back(FileFormat::vol, plain_volume({67, 61, 211}, 1, PixelType::half));
    testing::expect_refuses_damage(FileFormat::vol, plain_volume({9, 7, 3}, 3, PixelType::half));
}

// --- npy ----------------------------------------------------------------------------------------

TEST(Npy, HasTheHeadOfVersion1) {
    const TemporaryFolder folder;
    const std::array<std::string, 4> types = {"<f4", "<f2", "|u1", "<u2"};
    for (std::size_t i = 0; i < types.size(); ++i) {
        const Baked volume = plain_volume({5, 4, 3}, 3, testing::kPixelTypes[i]);
        const std::string bytes = written(folder, FileFormat::npy, volume, 2);
        EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\1\0", 8));
        const auto length = number<std::uint16_t>(bytes, 8);
        EXPECT_EQ((10 + length) % 64, 0);
        const std::string head = bytes.substr(10, length);
        EXPECT_EQ(head.substr(0, head.find_last_not_of(" \n") + 1),
                  fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': (3, 4, 5, 3), }}",
                              types[i]));
        EXPECT_EQ(head.back(), '\n');
        EXPECT_EQ(testing::wrong_values(FileFormat::npy, volume, folder / "a.file"), 0);
    }
    const std::string table = written(folder, FileFormat::npy, testing::sample_table(), 1);
    EXPECT_NE(table.find("'shape': (8, 16, 3), }"), std::string::npos);
}

TEST(Npy, RefusesDamage) {
    testing::expect_refuses_damage(FileFormat::npy, plain_volume({9, 7, 3}, 3, PixelType::unorm8));
}

// --- TGA ----------------------------------------------------------------------------------------

TEST(Tga, HoldsEachVoxelInItsPlace) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3, 4}) {
        Baked volume = plain_volume({7, 5, 6}, channels, PixelType::unorm8);
        volume.layout = config::SheetLayout::atlas;
        volume.columns = 3;
        const std::string bytes = written(folder, FileFormat::tga, volume, 2);
        EXPECT_EQ(bytes[2], channels == 1 ? 3 : 2);
        EXPECT_EQ(number<std::uint16_t>(bytes, 12), 21);
        EXPECT_EQ(number<std::uint16_t>(bytes, 14), 10);
        EXPECT_EQ(bytes[16], 8 * channels);
        EXPECT_EQ(bytes[17], 0x20 | (channels == 4 ? 8 : 0)) << "from the top, bits of alpha";
        const std::array<int, 4> order = {2, 1, 0, 3};  // blue first
        for_each_voxel({7, 5, 6}, [&](int x, int y, int z) {
            const int texel = (z / 3 * 5 + y) * 21 + z % 3 * 7 + x;
            for (int c = 0; c < channels; ++c) {
                const int place = channels == 1 ? 0 : order[static_cast<std::size_t>(c)];
                const auto at = static_cast<std::size_t>(18 + texel * channels + place);
                EXPECT_EQ(static_cast<unsigned char>(bytes[at]),
                          std::lround(sample_voxel(x, y, z, c) * 255.0));
            }
        });
        EXPECT_EQ(testing::wrong_values(FileFormat::tga, volume, folder / "a.file"), 0);
    }
}

// The foot points to an extension area, whose last byte is the kind of alpha, and to a developer
// area with the description.
TEST(Tga, SaysThatAlphaMultipliesNothing) {
    const TemporaryFolder folder;
    const std::string bytes =
        written(folder, FileFormat::tga, plain_volume({4, 4, 1}, 4, PixelType::unorm8), 1);
    const std::size_t foot = bytes.size() - 26;
    EXPECT_EQ(bytes.substr(foot + 8), std::string("TRUEVISION-XFILE.\0", 18));
    const auto extension = number<std::uint32_t>(bytes, foot);
    EXPECT_EQ(number<std::uint16_t>(bytes, extension), 495);
    EXPECT_EQ(bytes[extension + 494], 3);
    EXPECT_EQ(extension + 495, foot);
    const auto developer = number<std::uint32_t>(bytes, foot + 4);
    EXPECT_EQ(number<std::uint16_t>(bytes, developer), 1);
    EXPECT_EQ(number<std::uint16_t>(bytes, developer + 2), 32768);
    EXPECT_EQ(bytes.substr(number<std::uint32_t>(bytes, developer + 4),
                           number<std::uint32_t>(bytes, developer + 8)),
              "{}");
    const auto facts = testing::inspect_file(format_of(FileFormat::tga), folder / "a.file");
    ASSERT_TRUE(facts.value.has_value());
    EXPECT_EQ(facts.value->metadata, "{}");
}

TEST(Tga, RefusesWhatItCannotHoldAndDamage) {
    const auto code_of = [](const Baked& volume) {
        return testing::write_code(FileFormat::tga, volume);
    };
    EXPECT_EQ(code_of(plain_volume({2, 2, 2}, 1, PixelType::unorm16)), "E0500");
    EXPECT_EQ(code_of(plain_volume({2, 40000, 2}, 1, PixelType::unorm8)), "E0500");
    testing::expect_refuses_damage(FileFormat::tga, plain_volume({9, 7, 3}, 3, PixelType::unorm8));
}

// --- USD ----------------------------------------------------------------------------------------

TEST(Usda, PlacesTheVdbFile) {
    const TemporaryFolder folder;
    Baked volume = plain_volume({10, 20, 40}, 1, PixelType::half);
    volume.name = "cumulus-1";
    volume.voxel_size_m = {10, 10, 12.5};
    volume.minimum_m = {-50, 0, 1000};
    volume.up_axis = "+z";
    EXPECT_EQ(written(folder, FileFormat::usda, volume, 1),
              "#usda 1.0\n(\n    defaultPrim = \"cumulus_1\"\n    metersPerUnit = 1\n"
              "    upAxis = \"Z\"\n)\n\ndef Volume \"cumulus_1\"\n{\n"
              "    float3[] extent = [(-50, 0, 1000), (50, 200, 1500)]\n"
              "    rel field:density = </cumulus_1/density>\n"
              "\n    def OpenVDBAsset \"density\"\n    {\n"
              "        asset filePath = @./cumulus-1.vdb@\n"
              "        token fieldName = \"density\"\n        token fieldClass = \"fogVolume\"\n"
              "        token fieldDataType = \"half\"\n    }\n}\n"
              // tests/consumers/target_texts.py holds the numbers of a camera to its picture.
              "\ndef Camera \"camera\"\n{\n    float2 clippingRange = (1, 3298.341)\n"
              "    float focalLength = 50\n    float horizontalAperture = 36\n"
              "    float verticalAperture = 20.25\n"
              "    matrix4d xformOp:transform = ((0.8910065, -0.4539905, 0, 0), "
              "(-0.06318327, -0.1240041, 0.9902681, 0), (-0.4495723, -0.8823353, -0.1391731, 0), "
              "(-618.301, -1113.484, 1058.594, 1))\n"
              "    uniform token[] xformOpOrder = [\"xformOp:transform\"]\n}\n");
}

}  // namespace
}  // namespace skybake
