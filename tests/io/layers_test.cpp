// Arrays of 2-D textures in DDS and KTX2 files, read back by their bytes and by the formats' readers.
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
using testing::word;
using testing::written;

constexpr std::array kFormats = {FileFormat::dds, FileFormat::ktx2};

Baked layers_of(const std::array<int, 3>& size, int channels, PixelType type, int levels = 1) {
    Baked layers = testing::plain_volume(size, channels, type);
    layers.mapping = "layers";
    layers.ktx2_compression = Ktx2Compression::none;
    while (static_cast<int>(layers.levels.size()) < levels) {
        Level level = layers.levels.back();
        level.size = next_slice_size(level.size);
        layers.levels.push_back(std::move(level));
    }
    return layers;
}

// A byte that says which level, layer and row it is of.
char number(int level, int layer, int row) {
    return static_cast<char>(100 * level + 10 * layer + row);
}

// Three layers of 4 x 6, 2 x 3 and 1 x 1 texels.
Baked numbered_layers() {
    Baked layers = layers_of({4, 6, 3}, 1, PixelType::unorm8, 3);
    for (int level = 0; level < 3; ++level) {
        layers.levels[static_cast<std::size_t>(level)].voxels =
            std::make_shared<testing::FunctionVoxels>([level](int, int y, int z, int) {
                return static_cast<float>(100 * level + 10 * z + y) / 255;
            });
    }
    return layers;
}

std::string rows_of(int level, int layer) {
    const int width = 4 >> level;
    std::string rows;
    for (int y = 0; y < 6 >> level; ++y) {
        rows += std::string(static_cast<std::size_t>(width), number(level, layer, y));
    }
    return rows;
}

// Microsoft's documentation: DDS_HEADER_DXT10 with arraySize, D3D10_RESOURCE_DIMENSION_TEXTURE2D, and
// neither DDSD_DEPTH nor DDSCAPS2_VOLUME.
TEST(Layers, HaveTheHeaderOfDx10) {
    const TemporaryFolder folder;
    const std::string bytes =
        written(folder, FileFormat::dds, layers_of({8, 4, 5}, 3, PixelType::half, 2), 1);
    EXPECT_EQ(word(bytes, 4 + 4), 0x1U | 0x2U | 0x4U | 0x8U | 0x1000U | 0x20000U);
    EXPECT_EQ(word(bytes, 4 + 8), 4U) << "height";
    EXPECT_EQ(word(bytes, 4 + 12), 8U) << "width";
    EXPECT_EQ(word(bytes, 4 + 20), 0U) << "depth";
    EXPECT_EQ(word(bytes, 4 + 24), 2U) << "mips";
    EXPECT_EQ(word(bytes, 4 + 104), 0x8U | 0x1000U | 0x400000U) << "complex, texture, mips";
    EXPECT_EQ(word(bytes, 4 + 108), 0U) << "neither a cube nor a volume";
    EXPECT_EQ(word(bytes, 132), 3U) << "2-D";
    EXPECT_EQ(word(bytes, 136), 0U) << "no cube";
    EXPECT_EQ(word(bytes, 140), 5U) << "layers";
    EXPECT_EQ(bytes.size(), 148U + 5 * 8 * (8 * 4 + 4 * 2));
}

// KTX 2.0, section 3: pixelDepth is 0 and layerCount the number of layers, 1 of an array of one.
TEST(Layers, HaveTheHeaderOfKtx2) {
    const TemporaryFolder folder;
    for (const int count : {5, 1}) {
        const auto layers = static_cast<std::uint32_t>(count);
        const std::string bytes =
            written(folder, FileFormat::ktx2, layers_of({8, 4, count}, 3, PixelType::half, 2), 1);
        const std::array<std::uint32_t, 9> wanted = {97, 2, 8, 4, 0, layers, 1, 2, 0};
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            EXPECT_EQ(word(bytes, 12 + 4 * i), wanted[i]) << "member " << i;
        }
        EXPECT_NE(bytes.find(std::string("KTXorientation\0rd\0", 18)), std::string::npos);
        EXPECT_EQ(word(bytes, 80 + 8), layers * 8 * 4 * 8) << "bytes of level 0, all layers";
    }
}

// DDS files have all levels of a layer together, KTX2 files all layers of a level.
TEST(Layers, AreInTheirPlaces) {
    const TemporaryFolder folder;
    const Baked layers = numbered_layers();
    std::string wanted;
    for (int layer = 0; layer < 3; ++layer) {
        for (int level = 0; level < 3; ++level) wanted += rows_of(level, layer);
    }
    EXPECT_EQ(written(folder, FileFormat::dds, layers, 2).substr(148), wanted);
    const std::string bytes = written(folder, FileFormat::ktx2, layers, 2);
    for (int level = 0; level < 3; ++level) {
        std::string all;
        for (int layer = 0; layer < 3; ++layer) all += rows_of(level, layer);
        const std::size_t at = word(bytes, 80 + 24 * static_cast<std::size_t>(level));
        EXPECT_EQ(bytes.substr(at, all.size()), all) << level;
    }
}

TEST(Layers, ReadBackLevelByLevel) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        for (const auto compression : {Ktx2Compression::none, Ktx2Compression::zstd}) {
            Baked layers = numbered_layers();
            layers.ktx2_compression = compression;
            written(folder, format, layers, 2);
            for (int level = 0; level < 3; ++level) {
                const auto found = testing::texels_of(format, layers, level, folder / "a.file");
                std::string all;
                for (int layer = 0; layer < 3; ++layer) all += rows_of(level, layer);
                ASSERT_EQ(found.size(), all.size());
                for (std::size_t i = 0; i < all.size(); ++i) {
                    EXPECT_EQ(found[i],
                              static_cast<float>(static_cast<unsigned char>(all[i])) / 255);
                }
            }
        }
    }
}

TEST(Layers, DoNotDependOnThreadsAndRefuseDamage) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        for (const auto& size : {std::array{7, 5, 1}, {1, 1, 9}, {420, 300, 11}}) {
            const Baked layers = layers_of(size, 3, PixelType::half);
            const std::string bytes = written(folder, format, layers, 1);
            EXPECT_TRUE(written(folder, format, layers, 3) == bytes);
            EXPECT_EQ(testing::wrong_values(format, layers, folder / "a.file"), 0);
        }
        testing::expect_refuses_damage(format, layers_of({8, 6, 3}, 3, PixelType::unorm16, 2));
    }
}

// An array is no volume, and a volume no array; nor are there levels that lose layers.
TEST(Layers, AreToldFromVolumes) {
    const TemporaryFolder folder;
    for (const FileFormat format : kFormats) {
        const auto code_of = [&](const Baked& asset) {
            return testing::read_code(format, folder / "a.file", testing::shape_of(asset));
        };
        const Baked layers = layers_of({8, 6, 4}, 1, PixelType::half);
        Baked volume = layers;
        volume.mapping = "frames";
        Baked fewer = layers_of({8, 6, 3}, 1, PixelType::half);
        written(folder, format, layers, 1);
        EXPECT_EQ(code_of(layers), "");
        EXPECT_EQ(code_of(volume), "E0304");
        EXPECT_EQ(code_of(fewer), "E0304");
        written(folder, format, volume, 1);
        EXPECT_EQ(code_of(volume), "");
        EXPECT_EQ(code_of(layers), "E0304");
        Baked halved = layers;
        halved.levels.push_back(layers.levels[0]);
        halved.levels[1].size = next_mip_size(layers.levels[0].size);
        EXPECT_EQ(testing::write_code(format, halved), "E0500");
    }
}

}  // namespace
}  // namespace skybake
