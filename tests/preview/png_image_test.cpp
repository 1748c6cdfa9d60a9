#include "bakers/plot/png_image.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bakers/io/formats/png/map_image.h"
#include "bakers/render/tone_curve.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

Picture random_picture() {
    Picture picture(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40));
    for (std::uint8_t& byte : picture.rgb) {
        byte = static_cast<std::uint8_t>(*rc::gen::inRange(0, 256));
    }
    return picture;
}

// The names of a PNG's chunks, in order.
std::vector<std::string> chunks(const std::string& png) {
    std::vector<std::string> names;
    for (std::size_t at = 8; at + 8 <= png.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            length = length << 8 | static_cast<unsigned char>(png[at + i]);
        }
        names.push_back(png.substr(at + 4, 4));
        at += length + 12;
    }
    return names;
}

TEST(PngBytes, ReadBackEqual) {
    const testing::TemporaryFolder folder;
    EXPECT_TRUE(rc::check([&] {
        const Picture picture = random_picture();
        const auto png = png_bytes(picture);
        RC_ASSERT(png.value.has_value());
        RC_ASSERT(*png.value == *png_bytes(picture).value);
        const auto path = folder / "picture.png";
        std::ofstream(path, std::ios::binary) << *png.value;
        config::CloudMap map;
        map.path = path;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            map.channel = std::string(1, "RGB"[channel]);
            const auto read = read_map_image(map);
            RC_ASSERT(read.value.has_value());
            RC_ASSERT(read.value->width == picture.width);
            RC_ASSERT(read.value->height == picture.height);
            for (std::size_t i = 0; i < read.value->values.size(); ++i) {
                RC_ASSERT(std::lround(255 * read.value->values[i]) == picture.rgb[3 * i + channel]);
            }
        }
    }));
}

TEST(PngBytes, SayNeitherWhenNorByWhat) {
    const auto png = png_bytes(Picture(3, 2));
    ASSERT_TRUE(png.value.has_value());
    std::vector<std::string> names = chunks(*png.value);
    EXPECT_EQ(names.back(), "IEND");
    EXPECT_EQ(std::count(names.begin(), names.end(), "sRGB"), 1);
    for (const char* name : {"tIME", "eXIf", "iTXt", "zTXt"}) {
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 0) << name;
    }
    for (const char* word : {"Software", "DateTime", "Creation", "OpenImageIO"}) {
        EXPECT_EQ(png.value->find(word), std::string::npos) << word;
    }
}

TEST(PngBytes, RefuseDamagedSizes) {
    Picture damaged(4, 4);
    damaged.width = 5;
    Picture negative;
    negative.width = negative.height = -1;
    negative.rgb.resize(3);
    for (const Picture& picture : {Picture(), damaged, negative}) {
        const auto png = png_bytes(picture);
        EXPECT_FALSE(png.value.has_value());
        EXPECT_EQ(testing::first_code(png.diagnostics), "E0500");
    }
}

// --- The tone curve -----------------------------------------------------------------------------

Image2<float> texel(std::vector<float> values) {
    Image2<float> image(1, 1, static_cast<int>(values.size()));
    image.texels = std::move(values);
    return image;
}

TEST(ToneMapped, IsTheCurveThenSrgb) {
    EXPECT_TRUE(rc::check([] {
        const double exposed = *rc::gen::inRange(0, 100000) / 10000.0;
        const double exposure = *rc::gen::inRange(1, 1000) / 10.0;
        const auto radiance = static_cast<float>(exposed / exposure);
        const double linear = 1 - std::exp(-exposed);
        const double srgb =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
        const Picture picture = tone_mapped(texel({radiance, 0, radiance}), exposure);
        RC_ASSERT(std::abs(picture.rgb[0] - 255 * srgb) < 0.75);
        RC_ASSERT(picture.rgb[1] == 0);
        RC_ASSERT(picture.rgb[2] == picture.rgb[0]);
    }));
}

TEST(ToneMapped, OfTheEndsIsBlackAndWhite) {
    EXPECT_EQ(tone_mapped(texel({-1, 0, 1e30F}), 1).rgb, (std::vector<std::uint8_t>{0, 0, 255}));
    EXPECT_EQ(tone_mapped(texel({0.5F}), 1).rgb, (std::vector<std::uint8_t>(3, 168)))
        << "one channel is grey: 1 - exp(-1/2) = 0.393";
}

TEST(ExposureFor, BringsThe99thPercentileTo85Percent) {
    Image2<float> image(1000, 1, 3);
    for (int x = 0; x < 1000; ++x) {
        const float value = x < 980 ? 1.0F : x < 992 ? 4.0F : 1e6F;  // a sun in 8 of 1000 texels
        std::fill_n(image.texel(x, 0), 3, value);
    }
    EXPECT_NEAR(1 - std::exp(-exposure_for(image) * 4), 0.85, 1e-6);
    EXPECT_EQ(exposure_for(texel({0, 0, 0})), 1);
    EXPECT_EQ(exposure_for(Image2<float>()), 1);
}

}  // namespace
}  // namespace skybake
