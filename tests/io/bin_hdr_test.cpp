#include <cmath>

#include "bakers/field/pixel_type.h"
#include "bakers/io/formats/format.h"
#include "tests/io/format_checks.h"
#include "tests/io/open_formats.h"
#include "tests/support/volumes.h"

namespace skybake {

namespace {

using namespace testing;

TEST(BinVolume, IsXThenYThenZWithChannelsInterleaved) {
    const TemporaryFolder folder;
    const std::array<int, 3> size = {5, 3, 2};
    const std::string bytes =
        written(folder, config::FileFormat::bin, plain_volume(size, 3, PixelType::unorm8), 1);
    ASSERT_EQ(bytes.size(), 5U * 3 * 2 * 3);
    std::size_t i = 0;
    testing::for_each_voxel({5, 3, 2}, [&](int x, int y, int z) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(static_cast<unsigned char>(bytes[i++]),
                      std::lround(sample_voxel(x, y, z, c) * 255.0));
        }
    });
}

TEST(BinVolume, IsLittleEndian) {
    const TemporaryFolder folder;
    const auto one = [](int, int, int, int) { return 0.25F; };
    const auto bytes_of = [&](PixelType type) {
        return written(folder, config::FileFormat::bin, plain_volume({1, 1, 1}, 1, type, one), 1);
    };
    EXPECT_EQ(bytes_of(PixelType::float32), std::string("\x00\x00\x80\x3e", 4));
    EXPECT_EQ(bytes_of(PixelType::half), std::string("\x00\x34", 2));
    EXPECT_EQ(bytes_of(PixelType::unorm8), "\x40");
    EXPECT_EQ(bytes_of(PixelType::unorm16), std::string("\x00\x40", 2));
}

TEST(BinVolume, RefusesAnotherLength) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.bin", "1234567");
    const auto visit = [](std::int64_t, std::int64_t, const float*) { return true; };
    const FileShape shape = {{2, 2, 2}, 1, PixelType::unorm8, {}, 1};
    const auto read = testing::read_file_of(bin_format(), folder / "a.bin", shape, 0, visit);
    ASSERT_EQ(testing::first_code(read.diagnostics), "E0304");
    EXPECT_NE(read.diagnostics[0].message.find("7 bytes"), std::string::npos);
    EXPECT_EQ(testing::read_code(config::FileFormat::bin, folder / "absent", shape), "E0300");
}

TEST(BinVolume, SaysWhyItCannotWrite) {
    testing::expect_says_why_it_cannot_write(config::FileFormat::bin);
}

// Radiance pictures: their head and runs as the format's document has them, read back by OpenImageIO.

using config::FileFormat;

Baked sky_of(Image2<float> image) {
    Baked sky = testing::sample_table("sky");
    sky.pixel_type = PixelType::rgbe;
    round_values(image.texels.data(), image.texels.size(), sky.pixel_type);
    set_image(std::move(image), sky);
    return sky;
}

// The rule of Ward's paper, in double and without bits: steps of a 256th of the power of two above the
// largest, to the nearest.
TEST(Rgbe, RoundsToTheNearestStepOfTheLargestChannel) {
    testing::Random random(5);
    for (int i = 0; i < 100000; ++i) {
        std::array<float, 3> texel{};
        for (float& value : texel) {
            value = std::ldexp(static_cast<float>(random.below(1 << 20)),
                               static_cast<int>(random.below(12)) + i % 200 - 120);
        }
        std::array<float, 3> rounded = texel;
        round_values(rounded.data(), 3, PixelType::rgbe);
        const double largest = *std::max_element(texel.begin(), texel.end());
        if (largest < 1e-32) continue;
        double power = std::exp2(std::floor(std::log2(largest)) + 1);
        if (largest >= power * 255.5 / 256) power *= 2;  // it is rounded to that power itself
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_LE(std::fabs(double{rounded[c]} - texel[c]), power / 512) << texel[c];
        }
        std::array<float, 3> again = rounded;
        round_values(again.data(), 3, PixelType::rgbe);
        EXPECT_EQ(again, rounded);
    }
}

TEST(Rgbe, KeepsThePowerAboveTheLargestAndFindsWhatItCannotHold) {
    std::array<float, 12> texels = {1, 0.5,    0.0041F, 0.9996F,      0.503F, 0,
                                    0, 1e-33F, 0,       largest_rgbe, 0,      0};
    round_values(texels.data(), texels.size(), PixelType::rgbe);
    // 255.9 steps of 1/256 are 128 of 1/128, and 64.4 are 64.
    EXPECT_EQ(texels,
              (std::array<float, 12>{1, 0.5, 0.0078125F, 1, 0.5, 0, 0, 0, 0, largest_rgbe, 0, 0}));
    std::array<float, 6> bad = {-0.3F, 0.3F, 0.3F, 3e38F, 0.3F, 0.3F};
    const std::array<float, 6> before = bad;
    round_values(bad.data(), bad.size(), PixelType::rgbe);
    EXPECT_EQ(bad, before) << "is for the survey to find";
}

// Rows of fewer than 8 texels are four bytes of each: R, G, B and the exponent plus 128.
TEST(Hdr, HasTheHeadAndTheTexelsOfTheFormat) {
    const testing::TemporaryFolder folder;
    Image2<float> image(2, 2, 3);
    image.texels = {1, 0.5, 0.25, 0, 0, 0, 3, 100, 0, 0.001F, 0.002F, 0.003F};
    const std::string bytes = written(folder, FileFormat::hdr, sky_of(image), 2);
    const std::string texels = {char(128), 64,        32, char(129), 0,  0,         0,         0,
                                6,         char(200), 0,  char(135), 66, char(131), char(197), 120};
    EXPECT_EQ(bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + texels +
                         "{}\n# skybake/asset 0000000002\n");
    const auto facts = testing::inspect_file(format_of(FileFormat::hdr), folder / "a.file");
    ASSERT_TRUE(facts.value.has_value());
    EXPECT_EQ(facts.value->metadata, "{}");
}

TEST(Hdr, IsReadBackByOpenImageIO) {
    const testing::TemporaryFolder folder;
    for (const int width : {1, 7, 8, 129, 700}) {
        for (const bool flip : {false, true}) {
            Baked sky = sky_of(testing::sample_image(width, 5, 3));
            sky.flip = flip;
            const std::string bytes = written(folder, FileFormat::hdr, sky, 3);
            EXPECT_EQ(texels_of(FileFormat::hdr, sky, 0, folder / "a.file"), sky.image().texels)
                << width << flip;
            EXPECT_EQ(written(folder, FileFormat::hdr, sky, 1), bytes);
        }
    }
}

TEST(Hdr, RefusesWhatItCannotHoldAndDamage) {
    const Baked sky = sky_of(testing::sample_image(40, 7, 3));
    Baked half = sky;
    half.pixel_type = PixelType::half;
    EXPECT_EQ(testing::write_code(FileFormat::hdr, half), "E0500");
    testing::expect_refuses_damage(FileFormat::hdr, sky);
}

}  // namespace

}  // namespace skybake
