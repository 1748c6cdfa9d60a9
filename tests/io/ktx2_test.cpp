// KTX2 files, read back by their bytes, by the library of Zstandard, and by the format's reader.
#include <zstd.h>

#include <cstring>

#include "bakers/field/stored_voxels.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/ktx2/zstd_stream.h"
#include "tests/io/files.h"
#include "tests/io/format_checks.h"
#include "tests/io/open_formats.h"

namespace skybake {
namespace {

using config::FileFormat;
using config::Ktx2Compression;
using namespace testing;

constexpr FileFormat kFormat = FileFormat::ktx2;

Baked volume_of(const std::array<int, 3>& size, int channels, PixelType type,
                Ktx2Compression compression = Ktx2Compression::none) {
    Baked volume = plain_volume(size, channels, type);
    volume.ktx2_compression = compression;
    return volume;
}

// Offsets of the specification's section 3, "File Structure".
TEST(Ktx2, HasTheHeaderOfTheSpecification) {
    const TemporaryFolder folder;
    const std::string bytes =
        written(folder, kFormat, volume_of({12, 10, 7}, 4, PixelType::half), 1);
    EXPECT_EQ(bytes.substr(0, 12), "\xABKTX 20\xBB\r\n\x1A\n");
    const std::array<std::uint32_t, 9> wanted = {97, 2, 12, 10, 7, 0, 1, 1, 0};
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_EQ(word(bytes, 12 + 4 * i), wanted[i]) << "member " << i;
    }
    const std::uint32_t descriptor = word(bytes, 48);
    EXPECT_EQ(descriptor, 80U + 24);
    EXPECT_EQ(word(bytes, 52), 4U + 24 + 4 * 16);
    EXPECT_EQ(word(bytes, 56), descriptor + word(bytes, 52)) << "keys and values";
    EXPECT_EQ(number<std::uint64_t>(bytes, 64), 0U) << "no global data";
    const auto offset = number<std::uint64_t>(bytes, 80);
    EXPECT_EQ(offset % 8, 0U) << "levels begin at multiples of a texel";
    EXPECT_EQ(number<std::uint64_t>(bytes, 88), 12U * 10 * 7 * 8);
    EXPECT_EQ(number<std::uint64_t>(bytes, 96), 12U * 10 * 7 * 8);
    EXPECT_EQ(bytes.size(), offset + 12 * 10 * 7 * 8);
}

// The descriptor of VK_FORMAT_R16G16_UNORM-like texels: the words of the Khronos Data Format
// Specification, section 5, and of its examples for one and four channels.
TEST(Ktx2, DescribesItsTexels) {
    const TemporaryFolder folder;
    struct Case {
        PixelType type;
        std::uint32_t bits;
        std::uint32_t qualifiers;  // in the channel's word
        std::uint32_t lower;
        std::uint32_t upper;
        std::array<std::uint32_t, 2> vk_formats;  // of one channel and of four
    };
    constexpr std::uint32_t kFloat = 0xC0000000U;  // float and signed
    const Case cases[] = {
        {PixelType::unorm8, 8, 0, 0, 255, {9, 37}},
        {PixelType::unorm16, 16, 0, 0, 65535, {70, 91}},
        {PixelType::half, 16, kFloat, 0xBF800000U, 0x3F800000U, {76, 97}},
        {PixelType::float32, 32, kFloat, 0xBF800000U, 0x3F800000U, {100, 109}},
    };
    for (const Case& c : cases) {
        for (const int channels : {1, 3, 4}) {
            const std::string bytes =
                written(folder, kFormat, volume_of({3, 2, 2}, channels, c.type), 1);
            const std::uint32_t stored = channels == 1 ? 1 : 4;
            EXPECT_EQ(word(bytes, 12), c.vk_formats[channels == 1 ? 0 : 1]);
            EXPECT_EQ(word(bytes, 16), c.bits / 8);
            const std::size_t at = word(bytes, 48);
            EXPECT_EQ(word(bytes, at), 28 + 16 * stored);
            EXPECT_EQ(word(bytes, at + 4), 0U) << "Khronos, basic";
            EXPECT_EQ(word(bytes, at + 8), 2U | (24 + 16 * stored) << 16) << "version, size";
            EXPECT_EQ(word(bytes, at + 12), 0x00010001U) << "RGB, no primaries, linear, straight";
            EXPECT_EQ(word(bytes, at + 16), 0U) << "blocks of one texel";
            EXPECT_EQ(word(bytes, at + 20), stored * c.bits / 8) << "bytes of a texel";
            EXPECT_EQ(word(bytes, at + 24), 0U);
            const std::array<std::uint32_t, 4> ids = {0, 1, 2, 15};
            for (std::uint32_t i = 0; i < stored; ++i) {
                const std::size_t sample = at + 28 + 16 * i;
                EXPECT_EQ(word(bytes, sample),
                          i * c.bits | (c.bits - 1) << 16 | ids[i] << 24 | c.qualifiers);
                EXPECT_EQ(word(bytes, sample + 4), 0U);
                EXPECT_EQ(word(bytes, sample + 8), c.lower);
                EXPECT_EQ(word(bytes, sample + 12), c.upper);
            }
        }
    }
}

// Keys are sorted, each pair begins at a multiple of 4, and values are texts that end in 0.
TEST(Ktx2, SaysWhatItHolds) {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, kFormat, volume_of({3, 2, 2}, 1, PixelType::half), 1);
    const std::string values = bytes.substr(word(bytes, 56), word(bytes, 60));
    std::string found;
    std::size_t at = 0;
    while (at + 4 <= values.size()) {
        const std::uint32_t length = word(values, at);
        found += values.substr(at + 4, length) + "|";
        at += 4 + (length + 3) / 4 * 4;
    }
    EXPECT_EQ(at, values.size());
    using namespace std::string_literals;
    EXPECT_EQ(found, "KTXorientation\0rdi\0|KTXwriter\0skybake 0.1.0\0|skybake/asset\0{}\0|"s);
    const auto facts = testing::inspect_file(format_of(kFormat), folder / "a.file");
    ASSERT_TRUE(facts.value.has_value());
    EXPECT_EQ(facts.value->metadata, "{}");
    EXPECT_EQ(facts.value->compression, "none");
    EXPECT_EQ(facts.value->channels, 1U);
    EXPECT_EQ(facts.value->pixel_type, PixelType::half);
}

// Compares frames of zeros, and of noise, which zstd cannot shorten.
TEST(Ktx2, ZstdFramesAreThoseOfTheLibrary) {
    const TemporaryFolder folder;
    for (const bool is_noise : {false, true}) {
        Baked volume = volume_of({64, 64, 40}, 1, PixelType::float32, Ktx2Compression::zstd);
        if (!is_noise) {
            volume.levels[0].voxels =
                std::make_shared<testing::FunctionVoxels>([](int, int, int, int) { return 0.0F; });
        }
        const std::string bytes = written(folder, kFormat, volume, 2);
        const std::string as_it_is = [&] {
            Baked plain = volume;
            plain.ktx2_compression = Ktx2Compression::none;
            return written(folder, kFormat, plain, 2);
        }();
        EXPECT_EQ(word(bytes, 44), 2U) << "Zstandard";
        const auto offset = number<std::uint64_t>(bytes, 80);
        const auto length = number<std::uint64_t>(bytes, 88);
        const auto size = number<std::uint64_t>(bytes, 96);
        ASSERT_EQ(offset + length, bytes.size());
        ASSERT_EQ(size, 64U * 64 * 40 * 4);
        EXPECT_EQ(ZSTD_getFrameContentSize(bytes.data() + offset, length), size);
        EXPECT_EQ(ZSTD_findFrameCompressedSize(bytes.data() + offset, length), length)
            << "one frame";
        std::string texels(size, '\0');
        ASSERT_EQ(ZSTD_decompress(texels.data(), size, bytes.data() + offset, length), size);
        EXPECT_TRUE(texels == as_it_is.substr(as_it_is.size() - size));
        EXPECT_TRUE(is_noise || length < size / 1000) << length;
    }
}

TEST(Ktx2, HoldsAllLevelsTheSmallestFirst) {
    const TemporaryFolder folder;
    for (const auto compression : {Ktx2Compression::none, Ktx2Compression::zstd}) {
        Baked volume = volume_of({8, 6, 5}, 1, PixelType::unorm8, compression);
        volume.levels.resize(3, volume.levels[0]);
        for (std::size_t i = 1; i < 3; ++i) {
            volume.levels[i].size = next_mip_size(volume.levels[i - 1].size);
            volume.levels[i].voxels =
                std::make_shared<testing::FunctionVoxels>([i](int x, int, int, int) {
                    return static_cast<float>(10 * i + static_cast<std::size_t>(x)) / 255;
                });
        }
        const std::string bytes = written(folder, kFormat, volume, 2);
        EXPECT_EQ(word(bytes, 40), 3U);
        std::array<std::uint64_t, 3> offsets{};
        for (std::size_t i = 0; i < 3; ++i) offsets[i] = number<std::uint64_t>(bytes, 80 + 24 * i);
        EXPECT_LT(offsets[2], offsets[1]);
        EXPECT_LT(offsets[1], offsets[0]);
        EXPECT_EQ(number<std::uint64_t>(bytes, 80 + 24 + 16), 4U * 3 * 2);
        if (compression == Ktx2Compression::none) {
            for (const std::uint64_t offset : offsets) EXPECT_EQ(offset % 4, 0U);
            EXPECT_EQ(bytes[offsets[1] + 3], 13);
            EXPECT_EQ(bytes[offsets[2] + 1], 21);
        }
        for (const int level : {1, 2}) {
            const auto found = testing::texels_of(kFormat, volume, level, folder / "a.file");
            ASSERT_EQ(found.size(), level == 1 ? 24U : 2U);
            EXPECT_EQ(found[1], static_cast<float>(10 * level + 1) / 255);
        }
        // A runtime computes the sizes of levels itself.
        volume.levels[1].size = {5, 3, 3};
        EXPECT_EQ(testing::write_code(kFormat, volume), "E0500");
    }
}

TEST(Ktx2, TablesAreFlat) {
    const TemporaryFolder folder;
    Baked table = testing::sample_table();
    table.pixel_type = PixelType::half;
    const std::string bytes = written(folder, kFormat, table, 1);
    EXPECT_EQ(word(bytes, 28), 0U) << "depth";
    EXPECT_NE(bytes.find(std::string("KTXorientation\0rd\0", 18)), std::string::npos);
}

// Cut short, changed in a byte, or of another shape: never a crash, and never taken for the whole.
TEST(Ktx2, RefusesDamagedFiles) {
    for (const auto compression : {Ktx2Compression::none, Ktx2Compression::zstd}) {
        testing::expect_refuses_damage(kFormat,
                                       volume_of({9, 7, 3}, 3, PixelType::unorm16, compression));
    }
}

// Bytes after a complete frame, or a frame of other texels, are no level.
TEST(Ktx2, RefusesFramesOfAnotherLength) {
    const TemporaryFolder folder;
    const Baked volume = volume_of({9, 7, 3}, 1, PixelType::unorm8, Ktx2Compression::zstd);
    const std::string whole = written(folder, kFormat, volume, 1);
    const auto code_of = [&](const std::string& bytes) {
        return testing::read_code(kFormat, folder.write("other", bytes), testing::shape_of(volume));
    };
    EXPECT_EQ(code_of(whole), "");
    const auto with = [&](std::size_t offset, std::uint64_t value, std::string bytes) {
        std::memcpy(bytes.data() + offset, &value, sizeof value);
        return bytes;
    };
    const auto length = number<std::uint64_t>(whole, 88);
    EXPECT_EQ(code_of(with(88, length + 5, whole + "more ")), "E0304");
    EXPECT_EQ(code_of(with(88, length - 1, whole)), "E0304");
    EXPECT_EQ(code_of(with(96, 9 * 7 * 3 + 1, whole)), "E0304");
    std::string frame(ZSTD_compressBound(9 * 7 * 3 + 1), '\0');
    const std::string texels(9 * 7 * 3 + 1, 'a');
    frame.resize(
        ZSTD_compress(frame.data(), frame.size(), texels.data(), texels.size(), zstd_level));
    const auto offset = number<std::uint64_t>(whole, 80);
    EXPECT_EQ(code_of(with(88, frame.size(), whole.substr(0, offset) + frame)), "E0304");
}

}  // namespace
}  // namespace skybake
