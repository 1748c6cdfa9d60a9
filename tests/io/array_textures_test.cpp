// Cubes and arrays of 2-D textures in DDS and KTX2 files, read back by their bytes and by the formats'
// readers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "bakers/field/stored_voxels.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/texture.h"
#include "tests/io/files.h"
#include "tests/io/format_checks.h"
#include "tests/io/open_formats.h"

namespace skybake {
namespace {

using config::FileFormat;
using config::Ktx2Compression;
using testing::word;
using testing::written;

constexpr std::array kFormats = {FileFormat::dds, FileFormat::ktx2};
constexpr int kFaces = 6;

template <class NextSize>
Baked with_levels(Baked asset, const std::string& mapping, int levels, const NextSize& next_size) {
    asset.mapping = mapping;
    asset.ktx2_compression = Ktx2Compression::none;
    while (static_cast<int>(asset.levels.size()) < levels) {
        Level level = asset.levels.back();
        level.size = next_size(level.size);
        asset.levels.push_back(std::move(level));
    }
    return asset;
}

Baked cube_of(int edge, int channels, PixelType type, int levels = 1) {
    Baked cube = testing::plain_volume({edge, kFaces * edge, 1}, channels, type);
    cube.axes.resize(2);
    return with_levels(std::move(cube), "cube", levels, next_mip_size);
}

Baked layers_of(const std::array<int, 3>& size, int channels, PixelType type, int levels = 1) {
    return with_levels(testing::plain_volume(size, channels, type), "layers", levels,
                       next_slice_size);
}

// Textures of three levels, whose texels of one byte say which level, texture and row they are of.
struct Numbered {
    Baked asset;
    int textures, width, rows;  // of level 0

    static char number(int level, int texture, int row) {
        return static_cast<char>(100 * level + 10 * texture + row);
    }
    // The bytes of one texture, or of all of them.
    std::string bytes(int level, int texture) const {
        std::string all;
        for (int row = 0; row < rows >> level; ++row) {
            all +=
                std::string(static_cast<std::size_t>(width >> level), number(level, texture, row));
        }
        return all;
    }
    std::string bytes(int level) const {
        std::string all;
        for (int texture = 0; texture < textures; ++texture) all += bytes(level, texture);
        return all;
    }
};

// A cube of 4 x 4 texels, and three layers of 4 x 6, 2 x 3 and 1 x 1 texels.
std::vector<Numbered> numbered_textures() {
    std::vector<Numbered> all = {{cube_of(4, 1, PixelType::unorm8, 3), kFaces, 4, 4},
                                 {layers_of({4, 6, 3}, 1, PixelType::unorm8, 3), 3, 4, 6}};
    for (Numbered& of : all) {
        const bool is_cube = of.asset.mapping == "cube";
        for (int level = 0; level < 3; ++level) {
            const int rows = of.rows >> level;
            of.asset.levels[static_cast<std::size_t>(level)].voxels =
                std::make_shared<testing::FunctionVoxels>([=](int, int y, int z, int) {
                    const char value = is_cube ? Numbered::number(level, y / rows, y % rows)
                                               : Numbered::number(level, z, y);
                    return static_cast<float>(static_cast<unsigned char>(value)) / 255;
                });
        }
    }
    return all;
}

// Microsoft's documentation: DDSCAPS2_CUBEMAP with all six faces, D3D11_RESOURCE_MISC_TEXTURECUBE, one
// cube; or arraySize, and neither DDSD_DEPTH nor DDSCAPS2_VOLUME.
TEST(ArrayTextures, HaveTheHeaderOfDx10) {
    const TemporaryFolder folder;
    struct Case {
        Baked asset;
        std::uint32_t height, texel, caps, cube, count;
        std::size_t size;
    };
    const std::uint32_t six = 0x200U | 0x400U | 0x800U | 0x1000U | 0x2000U | 0x4000U | 0x8000U;
    for (const Case& c :
         {Case{cube_of(8, 3, PixelType::unorm8, 2), 8, 4, six, 4, 1, 6 * 4 * (8 * 8 + 4 * 4)},
          Case{layers_of({8, 4, 5}, 3, PixelType::half, 2), 4, 8, 0, 0, 5,
               5 * 8 * (8 * 4 + 4 * 2)}}) {
        SCOPED_TRACE(c.asset.mapping);
        const std::string bytes = written(folder, FileFormat::dds, c.asset, 1);
        EXPECT_EQ(word(bytes, 4 + 4), 0x1U | 0x2U | 0x4U | 0x8U | 0x1000U | 0x20000U);
        EXPECT_EQ(word(bytes, 4 + 8), c.height);
        EXPECT_EQ(word(bytes, 4 + 12), 8U) << "width";
        EXPECT_EQ(word(bytes, 4 + 16), 8 * c.texel) << "pitch";
        EXPECT_EQ(word(bytes, 4 + 20), 0U) << "depth";
        EXPECT_EQ(word(bytes, 4 + 24), 2U) << "mips";
        EXPECT_EQ(word(bytes, 4 + 104), 0x8U | 0x1000U | 0x400000U) << "complex, texture, mips";
        EXPECT_EQ(word(bytes, 4 + 108), c.caps);
        EXPECT_EQ(word(bytes, 132), 3U) << "2-D";
        EXPECT_EQ(word(bytes, 136), c.cube);
        EXPECT_EQ(word(bytes, 140), c.count) << "cubes, or layers";
        EXPECT_EQ(bytes.size(), 148 + c.size);
    }
}

// D3DFMT_A16B16G16R16F is 113, and DDSCAPS2 says that it is a cube. The header ends there.
TEST(ArrayTextures, CubesOfHalvesHaveTheHeaderBeforeDx10) {
    const TemporaryFolder folder;
    const Baked cube = cube_of(8, 3, PixelType::half, 2);
    const std::string bytes = written(folder, FileFormat::dds, cube, 1);
    EXPECT_EQ(word(bytes, 4 + 76), 4U) << "four characters";
    EXPECT_EQ(word(bytes, 4 + 80), 113U);
    EXPECT_EQ(word(bytes, 4 + 108), 0xFE00U);
    EXPECT_EQ(bytes.size(), 128U + 6 * 8 * (8 * 8 + 4 * 4));
    EXPECT_EQ(testing::texels_of(FileFormat::dds, cube, 0, folder / "a.file").size(), 6U * 64 * 3);
    const auto facts = testing::inspect_file(format_of(FileFormat::dds), folder / "a.file");
    ASSERT_TRUE(facts.value.has_value());
    EXPECT_EQ(facts.value->pixel_type, PixelType::half);
    EXPECT_EQ(facts.value->channels, 4U);
}

// KTX 2.0, section 3: pixelDepth is 0, layerCount the number of layers (1 of an array of one) or 0,
// faceCount 6 or 1, and KTXorientation is `rd`.
TEST(ArrayTextures, HaveTheHeaderOfKtx2) {
    const TemporaryFolder folder;
    struct Case {
        Baked asset;
        std::uint32_t height, layers, faces;
    };
    for (const Case& c : {Case{cube_of(8, 3, PixelType::half, 2), 8, 0, 6},
                          Case{layers_of({8, 4, 5}, 3, PixelType::half, 2), 4, 5, 1},
                          Case{layers_of({8, 4, 1}, 3, PixelType::half, 2), 4, 1, 1}}) {
        const std::string bytes = written(folder, FileFormat::ktx2, c.asset, 1);
        const std::array<std::uint32_t, 9> wanted = {97,       2,       8, c.height, 0,
                                                     c.layers, c.faces, 2, 0};
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            EXPECT_EQ(word(bytes, 12 + 4 * i), wanted[i]) << "member " << i;
        }
        EXPECT_NE(bytes.find(std::string("KTXorientation\0rd\0", 18)), std::string::npos);
        EXPECT_EQ(word(bytes, 80 + 8), std::max(c.layers, 1U) * c.faces * 8 * c.height * 8)
            << "bytes of level 0, all textures";
    }
}

// DDS files have all levels of a texture together, KTX2 files all textures of a level, the smallest
// level first.
TEST(ArrayTextures, AreInTheirPlaces) {
    const TemporaryFolder folder;
    for (const Numbered& of : numbered_textures()) {
        std::string wanted;
        for (int texture = 0; texture < of.textures; ++texture) {
            for (int level = 0; level < 3; ++level) wanted += of.bytes(level, texture);
        }
        EXPECT_EQ(written(folder, FileFormat::dds, of.asset, 2).substr(148), wanted);
        const std::string bytes = written(folder, FileFormat::ktx2, of.asset, 2);
        for (int level = 0; level < 3; ++level) {
            const std::string all = of.bytes(level);
            const std::size_t at = word(bytes, 80 + 24 * static_cast<std::size_t>(level));
            EXPECT_EQ(bytes.substr(at, all.size()), all) << level;
        }
    }
}

TEST(ArrayTextures, ReadBackLevelByLevel) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        for (const auto compression : {Ktx2Compression::none, Ktx2Compression::zstd}) {
            for (Numbered& of : numbered_textures()) {
                of.asset.ktx2_compression = compression;
                written(folder, format, of.asset, 2);
                for (int level = 0; level < 3; ++level) {
                    std::string found;
                    for (const float value :
                         testing::texels_of(format, of.asset, level, folder / "a.file")) {
                        found += static_cast<char>(std::lround(255 * value));
                    }
                    EXPECT_EQ(found, of.bytes(level)) << level;
                }
            }
        }
    }
}

// Faces of an odd edge and of one texel; textures that pieces of the file end within.
TEST(ArrayTextures, DoNotDependOnThreadsAndRefuseDamage) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        for (const Baked& asset :
             {cube_of(1, 3, PixelType::half), cube_of(7, 3, PixelType::half),
              cube_of(420, 3, PixelType::half), layers_of({7, 5, 1}, 3, PixelType::half),
              layers_of({1, 1, 9}, 3, PixelType::half),
              layers_of({420, 300, 11}, 3, PixelType::half)}) {
            testing::expect_reads_back(format, asset);
        }
        testing::expect_refuses_damage(format, cube_of(8, 3, PixelType::unorm16, 2));
        testing::expect_refuses_damage(format, layers_of({8, 6, 3}, 3, PixelType::unorm16, 2));
    }
}

// A strip of squares is no cube, and a cube no strip; an array is no volume, and a volume no array. Nor
// are there cubes of other faces than squares, or levels that lose layers.
TEST(ArrayTextures, AreToldFromOthers) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        const auto code_of = [&](const Baked& asset) {
            return testing::read_code(format, folder / "a.file", testing::shape_of(asset));
        };
        for (const auto& [asset, other] : {std::pair{cube_of(8, 3, PixelType::half), "octahedral"},
                                           {layers_of({8, 6, 4}, 1, PixelType::half), "frames"}}) {
            Baked twin = asset;
            twin.mapping = other;
            written(folder, format, asset, 1);
            EXPECT_EQ(code_of(asset), "");
            EXPECT_EQ(code_of(twin), "E0304");
            Baked smaller = asset;
            smaller.levels[0].size =
                twin.mapping == "frames" ? std::array{8, 6, 3} : std::array{1, 5, 1};
            EXPECT_EQ(code_of(smaller), "E0304");
            written(folder, format, twin, 1);
            EXPECT_EQ(code_of(twin), "");
            EXPECT_EQ(code_of(asset), "E0304");
        }
        Baked oblong = cube_of(8, 3, PixelType::half);
        oblong.levels[0].size = {8, 47, 1};
        EXPECT_EQ(testing::write_code(format, oblong), "E0500");
        const Baked odd = cube_of(3, 1, PixelType::half, 2);  // 1 x 9 texels are no six squares
        EXPECT_EQ(testing::write_code(format, odd), "E0500");
        const Baked halved =
            with_levels(layers_of({8, 6, 4}, 1, PixelType::half), "layers", 2, next_mip_size);
        EXPECT_EQ(testing::write_code(format, halved), "E0500");
    }
}

// A file whose two headers disagree is damaged.
TEST(ArrayTextures, OfDdsHaveHeadersThatAgree) {
    const TemporaryFolder folder;
    const Baked cube = cube_of(4, 1, PixelType::unorm8);
    std::string bytes = written(folder, FileFormat::dds, cube, 1);
    bytes[136] = 0;
    testing::write_bytes(folder / "a.file", bytes);
    EXPECT_EQ(testing::first_code(
                  testing::inspect_file(format_of(FileFormat::dds), folder / "a.file").diagnostics),
              "E0304");
}

}  // namespace
}  // namespace skybake
