// Cube textures in DDS and KTX2 files, read back by their bytes and by the formats' readers.

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "bakers/field/stored_voxels.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/texture.h"
#include "tests/io/files.h"
#include "tests/io/format_checks.h"

namespace skybake {
namespace {

using config::FileFormat;
using config::Ktx2Compression;
using testing::texels_of;
using testing::word;
using testing::written;

constexpr std::array kFormats = {FileFormat::dds, FileFormat::ktx2};
constexpr int kFaces = 6;

Baked cube_of(int edge, int channels, PixelType type, int levels = 1) {
    Baked cube = testing::plain_volume({edge, kFaces * edge, 1}, channels, type);
    cube.axes.resize(2);
    cube.mapping = "cube";
    cube.ktx2_compression = Ktx2Compression::none;
    while (static_cast<int>(cube.levels.size()) < levels) {
        Level level = cube.levels.back();
        level.size = next_mip_size(level.size);
        cube.levels.push_back(std::move(level));
    }
    return cube;
}

// Texels of one byte that say which level, face and row they are of.
Baked numbered_cube() {
    Baked cube = cube_of(4, 1, PixelType::unorm8, 3);
    for (int level = 0; level < 3; ++level) {
        const int edge = 4 >> level;
        cube.levels[static_cast<std::size_t>(level)].voxels =
            std::make_shared<testing::FunctionVoxels>([level, edge](int, int y, int, int) {
                return static_cast<float>(100 * level + 10 * (y / edge) + y % edge) / 255;
            });
    }
    return cube;
}

// Microsoft's documentation: DDSCAPS2_CUBEMAP with all six faces, D3D11_RESOURCE_MISC_TEXTURECUBE,
// one cube.
TEST(Cubes, HaveTheHeaderOfDx10) {
    const TemporaryFolder folder;
    const std::string bytes =
        written(folder, FileFormat::dds, cube_of(8, 3, PixelType::unorm8, 2), 1);
    EXPECT_EQ(word(bytes, 4 + 4), 0x1U | 0x2U | 0x4U | 0x8U | 0x1000U | 0x20000U);
    EXPECT_EQ(word(bytes, 4 + 8), 8U) << "height";
    EXPECT_EQ(word(bytes, 4 + 12), 8U) << "width";
    EXPECT_EQ(word(bytes, 4 + 16), 8U * 4) << "pitch";
    EXPECT_EQ(word(bytes, 4 + 20), 0U) << "depth";
    EXPECT_EQ(word(bytes, 4 + 24), 2U) << "mips";
    EXPECT_EQ(word(bytes, 4 + 104), 0x8U | 0x1000U | 0x400000U) << "complex, texture, mips";
    EXPECT_EQ(word(bytes, 4 + 108),
              0x200U | 0x400U | 0x800U | 0x1000U | 0x2000U | 0x4000U | 0x8000U);
    EXPECT_EQ(word(bytes, 132), 3U) << "2-D";
    EXPECT_EQ(word(bytes, 136), 4U) << "cube";
    EXPECT_EQ(word(bytes, 140), 1U) << "number of cubes";
    EXPECT_EQ(bytes.size(), 148U + 6 * 4 * (8 * 8 + 4 * 4));
}

// D3DFMT_A16B16G16R16F is 113, and DDSCAPS2 says that it is a cube. The header ends there.
TEST(Cubes, OfHalvesHaveTheHeaderBeforeDx10) {
    const TemporaryFolder folder;
    const Baked cube = cube_of(8, 3, PixelType::half, 2);
    const std::string bytes = written(folder, FileFormat::dds, cube, 1);
    EXPECT_EQ(word(bytes, 4 + 76), 4U) << "four characters";
    EXPECT_EQ(word(bytes, 4 + 80), 113U);
    EXPECT_EQ(word(bytes, 4 + 108), 0xFE00U);
    EXPECT_EQ(bytes.size(), 128U + 6 * 8 * (8 * 8 + 4 * 4));
    EXPECT_EQ(testing::texels_of(FileFormat::dds, cube, 0, folder / "a.file").size(), 6U * 64 * 3);
    const auto facts = format_of(FileFormat::dds).inspect(folder / "a.file");
    ASSERT_TRUE(facts.value.has_value());
    EXPECT_EQ(facts.value->pixel_type, PixelType::half);
    EXPECT_EQ(facts.value->channels, 4U);
}

// KTX 2.0, section 3: faceCount is 6, the height is the width, and KTXorientation is `rd`.
TEST(Cubes, HaveTheHeaderOfKtx2) {
    const TemporaryFolder folder;
    const std::string bytes =
        written(folder, FileFormat::ktx2, cube_of(8, 3, PixelType::half, 2), 1);
    const std::array<std::uint32_t, 9> wanted = {97, 2, 8, 8, 0, 0, 6, 2, 0};
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_EQ(word(bytes, 12 + 4 * i), wanted[i]) << "member " << i;
    }
    EXPECT_NE(bytes.find(std::string("KTXorientation\0rd\0", 18)), std::string::npos);
    EXPECT_EQ(word(bytes, 80 + 8), 6U * 8 * 8 * 8) << "bytes of level 0, all faces";
}

// DDS files have all levels of a face together, KTX2 files all faces of a level, the smallest level
// first.
TEST(Cubes, HaveEachFaceInItsPlace) {
    const TemporaryFolder folder;
    const Baked cube = numbered_cube();
    const auto number = [](int level, int face, int row) {
        return static_cast<char>(100 * level + 10 * face + row);
    };
    std::string wanted;
    for (int face = 0; face < kFaces; ++face) {
        for (int level = 0; level < 3; ++level) {
            const int edge = 4 >> level;
            for (int row = 0; row < edge; ++row) {
                wanted += std::string(static_cast<std::size_t>(edge), number(level, face, row));
            }
        }
    }
    EXPECT_EQ(written(folder, FileFormat::dds, cube, 2).substr(148), wanted);
    const std::string bytes = written(folder, FileFormat::ktx2, cube, 2);
    for (int level = 0; level < 3; ++level) {
        const int edge = 4 >> level;
        std::string faces;
        for (int row = 0; row < kFaces * edge; ++row) {
            faces +=
                std::string(static_cast<std::size_t>(edge), number(level, row / edge, row % edge));
        }
        EXPECT_EQ(
            bytes.substr(word(bytes, 80 + 24 * static_cast<std::size_t>(level)), faces.size()),
            faces);
    }
}

TEST(Cubes, ReadBackLevelByLevel) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        for (const auto compression : {Ktx2Compression::none, Ktx2Compression::zstd}) {
            Baked cube = numbered_cube();
            cube.ktx2_compression = compression;
            written(folder, format, cube, 2);
            for (int level = 0; level < 3; ++level) {
                const int edge = 4 >> level;
                const auto found = texels_of(format, cube, level, folder / "a.file");
                ASSERT_EQ(found.size(), static_cast<std::size_t>(kFaces * edge * edge));
                for (std::size_t i = 0; i < found.size(); ++i) {
                    const int y = static_cast<int>(i) / edge;
                    EXPECT_EQ(found[i],
                              static_cast<float>(100 * level + 10 * (y / edge) + y % edge) / 255);
                }
            }
        }
    }
}

// Faces of an odd edge and of one texel; faces that pieces of the file end within.
TEST(Cubes, ReadBackAndDoNotDependOnThreads) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        for (const int edge : {1, 7, 420}) {
            const Baked cube = cube_of(edge, 3, PixelType::half);
            const std::string bytes = written(folder, format, cube, 1);
            EXPECT_TRUE(written(folder, format, cube, 3) == bytes);
            EXPECT_EQ(testing::wrong_values(format, cube, folder / "a.file"), 0);
        }
    }
}

TEST(Cubes, RefuseDamagedFiles) {
    for (const FileFormat format : kFormats) {
        testing::expect_refuses_damage(format, cube_of(8, 3, PixelType::unorm16, 2));
    }
}

// A strip of squares is no cube, and a cube no strip; nor are there cubes of other faces than squares.
TEST(Cubes, AreToldFromImages) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        const auto code_of = [&](const FileShape& shape) {
            return testing::read_code(format, folder / "a.file", shape);
        };
        const Baked cube = cube_of(8, 3, PixelType::half);
        Baked strip = cube;
        strip.mapping = "octahedral";
        written(folder, format, cube, 1);
        EXPECT_EQ(code_of(testing::shape_of(cube)), "");
        EXPECT_EQ(code_of(testing::shape_of(strip)), "E0304");
        FileShape other = testing::shape_of(cube);
        other.size = {1, 5, 1};
        EXPECT_EQ(code_of(other), "E0304");
        written(folder, format, strip, 1);
        EXPECT_EQ(code_of(testing::shape_of(strip)), "");
        EXPECT_EQ(code_of(testing::shape_of(cube)), "E0304");
        Baked oblong = cube;
        oblong.levels[0].size = {8, 47, 1};
        EXPECT_EQ(testing::write_code(format, oblong), "E0500");
        Baked odd = cube_of(3, 1, PixelType::half, 2);  // 1 x 9 texels are no six squares
        EXPECT_EQ(testing::write_code(format, odd), "E0500");
    }
}

// A file whose two headers disagree is damaged.
TEST(Cubes, OfDdsHaveHeadersThatAgree) {
    const TemporaryFolder folder;
    const Baked cube = cube_of(4, 1, PixelType::unorm8);
    std::string bytes = written(folder, FileFormat::dds, cube, 1);
    bytes[136] = 0;
    testing::write_bytes(folder / "a.file", bytes);
    EXPECT_EQ(
        testing::first_code(format_of(FileFormat::dds).inspect(folder / "a.file").diagnostics),
        "E0304");
}

}  // namespace
}  // namespace skybake
