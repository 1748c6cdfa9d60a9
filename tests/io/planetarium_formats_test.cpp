// TIFF files and CalcMySky's textures, held to the bytes that their readers expect.
#include <array>
#include <map>
#include <string>

#include "bakers/io/formats/format.h"
#include "tests/io/files.h"
#include "tests/io/format_checks.h"
#include "tests/io/open_formats.h"

namespace skybake {
namespace {

using config::FileFormat;
using namespace testing;

// --- TIFF ---------------------------------------------------------------------------------------

struct TifEntry {
    std::uint16_t type = 0;
    std::uint32_t count = 0;
    std::uint32_t value = 0;
};

// Reads a directory, whose tags must ascend, and returns where the next one is.
std::uint32_t read_directory(const std::string& bytes, std::uint32_t at,
                             std::map<int, TifEntry>& entries) {
    const auto count = number<std::uint16_t>(bytes, at);
    int before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t entry = at + 2 + 12 * i;
        const int tag = number<std::uint16_t>(bytes, entry);
        EXPECT_GT(tag, before);
        before = tag;
        entries[tag] = {number<std::uint16_t>(bytes, entry + 2),
                        number<std::uint32_t>(bytes, entry + 4),
                        number<std::uint32_t>(bytes, entry + 8)};
    }
    return number<std::uint32_t>(bytes, at + 2 + std::size_t{12} * count);
}

TEST(Tif, HasAPageForEachSlice) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3, 4}) {
        const Baked volume = plain_volume({5, 4, 3}, channels, PixelType::float32);
        const std::string bytes = written(folder, FileFormat::tif, volume, 2);
        EXPECT_EQ(bytes.substr(0, 4), std::string("II*\0", 4));
        auto at = number<std::uint32_t>(bytes, 4);
        for (std::uint32_t z = 0; z < 3; ++z) {
            ASSERT_NE(at, 0U);
            EXPECT_EQ(at % 2, 0U) << "directories begin at words";
            std::map<int, TifEntry> page;
            at = read_directory(bytes, at, page);
            EXPECT_EQ(page[256].value, 5U);
            EXPECT_EQ(page[257].value, 4U);
            EXPECT_EQ(page[277].value, static_cast<unsigned>(channels));
            EXPECT_EQ(page[262].value, channels == 1 ? 1U : 2U);
            EXPECT_EQ(page[297].value, 3U << 16 | z);
            EXPECT_EQ(page.count(338), channels == 4 ? 1U : 0U);
            const std::uint32_t texels = page[273].value;
            EXPECT_EQ(page[279].value, 5U * 4 * 4 * static_cast<unsigned>(channels));
            const std::size_t texel = texels + 4 * static_cast<std::size_t>((2 * 5 + 3) * channels);
            for (int c = 0; c < channels; ++c) {
                EXPECT_EQ(number<float>(bytes, texel + 4 * static_cast<std::size_t>(c)),
                          stored({3, 2, static_cast<int>(z)}, c, PixelType::float32));
            }
        }
        EXPECT_EQ(at, 0U) << "the last page";
        EXPECT_EQ(testing::wrong_values(FileFormat::tif, volume, folder / "a.file"), 0);
        const auto facts = testing::inspect_file(format_of(FileFormat::tif), folder / "a.file");
        ASSERT_TRUE(facts.value.has_value());
        EXPECT_EQ(facts.value->metadata, "{}");
        EXPECT_EQ(facts.value->channels, static_cast<std::size_t>(channels));
    }
}

TEST(Tif, RefusesWhatItCannotHoldAndDamage) {
    const auto code_of = [](const Baked& volume) {
        return testing::write_code(FileFormat::tif, volume);
    };
    EXPECT_EQ(code_of(plain_volume({2, 2, 2}, 1, PixelType::half)), "E0500");
    EXPECT_EQ(code_of(plain_volume({1024, 1024, 1024}, 1, PixelType::float32)), "E0500");
    testing::expect_refuses_damage(FileFormat::tif, plain_volume({9, 7, 3}, 3, PixelType::float32));
}

// --- CalcMySky ----------------------------------------------------------------------------------

TEST(F32, HasTwoSizesOfATableAndFourOfAVolume) {
    const TemporaryFolder folder;
    const Baked table = plain_volume({6, 5, 1}, 3, PixelType::float32);
    const std::string flat = written(folder, FileFormat::f32, table, 1);
    ASSERT_EQ(flat.size(), 4U + 6 * 5 * 16);
    EXPECT_EQ(number<std::uint16_t>(flat, 0), 6);
    EXPECT_EQ(number<std::uint16_t>(flat, 2), 5);
    EXPECT_EQ(number<float>(flat, 4 + 16 * (2 * 6 + 4) + 4),
              stored({4, 2, 0}, 1, table.pixel_type));
    EXPECT_EQ(number<float>(flat, 4 + 16 * (2 * 6 + 4) + 12), 0.0F) << "it has no fourth channel";
    EXPECT_EQ(testing::wrong_values(FileFormat::f32, table, folder / "a.file"), 0);
    const Baked volume = plain_volume({6, 5, 4}, 4, PixelType::float32);
    const std::string deep = written(folder, FileFormat::f32, volume, 1);
    ASSERT_EQ(deep.size(), 8U + 6 * 5 * 4 * 16);
    EXPECT_EQ(number<std::uint16_t>(deep, 4), 1);
    EXPECT_EQ(number<std::uint16_t>(deep, 6), 4);
    EXPECT_EQ(number<float>(deep, 8 + 16 * ((3 * 5 + 2) * 6 + 4) + 12),
              stored({4, 2, 3}, 3, volume.pixel_type));
    EXPECT_EQ(testing::wrong_values(FileFormat::f32, volume, folder / "a.file"), 0);
}

// Bruneton's u is an image nu and a sun in it; CalcMySky's x is the view, and its y the sun and nu.
TEST(F32, TurnsBrunetonsTables) {
    const TemporaryFolder folder;
    Baked volume = plain_volume({8, 6, 3}, 4, PixelType::float32);
    volume.details.emplace_back("nu_size", 2.0);
    const std::string bytes = written(folder, FileFormat::f32, volume, 1);
    const std::array<std::uint16_t, 4> sizes = {6, 2, 4, 3};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(number<std::uint16_t>(bytes, 2 * i), sizes[i]);
    for (int nu = 0; nu < 2; ++nu) {
        for (int sun = 0; sun < 4; ++sun) {
            const int view = (nu + 3 * sun) % 6;
            const int texel = ((2 * 4 + sun) * 2 + nu) * 6 + view;
            EXPECT_EQ(number<float>(bytes, 8 + 16 * static_cast<std::size_t>(texel)),
                      stored({nu * 4 + sun, view, 2}, 0, volume.pixel_type))
                << nu << ' ' << sun;
        }
    }
    EXPECT_EQ(testing::wrong_values(FileFormat::f32, volume, folder / "a.file"), 0);
}

TEST(F32, RefusesWhatItCannotHoldAndDamage) {
    const Baked half = plain_volume({2, 2, 2}, 1, PixelType::half);
    EXPECT_EQ(testing::write_code(FileFormat::f32, half), "E0500");
    testing::expect_refuses_damage(FileFormat::f32, plain_volume({9, 7, 3}, 3, PixelType::float32));
    Baked turned = plain_volume({8, 6, 3}, 4, PixelType::float32);
    turned.details.emplace_back("nu_size", 2.0);
    testing::expect_refuses_damage(FileFormat::f32, turned);
}

}  // namespace
}  // namespace skybake
