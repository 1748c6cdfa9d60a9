#include "bakers/plot/drawing.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <string>

#include "bakers/io/formats/png/map_image.h"
#include "tests/io/files.h"
#include "tests/plot/pixels.h"

namespace skybake {
namespace {

// --- Text ---------------------------------------------------------------------------------------

// A line of text in black, 20 pixels right of the left edge and 60 below the top.
Picture text(std::string_view words, int em = 14, FontWeight weight = FontWeight::regular) {
    Drawing drawing;
    drawing.width = 400;
    drawing.height = 100;
    drawing.write(words, 20, 60, TextAlign::left, {em, weight, {0, 0, 0}});
    return painted(drawing);
}

// Returns the box of all that is not paper.
PixelBox ink(const Picture& picture) {
    return box_where(picture, [](Colour colour) { return colour[0] < 128; });
}

TEST(Text, ShowsWhatIsNotAscii) {
    ASSERT_FALSE(chart_problem().has_value()) << chart_problem()->message;
    std::set<std::vector<std::uint8_t>> different;
    const std::vector<std::string> words = {"e", "é", "0", "°", "µ", "λ", "−", "×", "⁻⁵", "Ψ", "�"};
    for (const std::string& word : words) different.insert(text(word).rgb);
    EXPECT_EQ(different.size(), words.size());
}

TEST(Text, ReplacesWhatIsNoText) {
    EXPECT_EQ(text("\xff").rgb, text("�").rgb);
    EXPECT_EQ(text("a\xc3").rgb, text("a�").rgb);
    EXPECT_EQ(text("\xed\xa0\x80").rgb, text("���").rgb) << "a surrogate";
    EXPECT_EQ(text("\xc0\xaf").rgb, text("��").rgb) << "a longer form of /";
    EXPECT_EQ(text("a\nb\tc").rgb, text("a b c").rgb);
    EXPECT_NE(text("a b").rgb, text("ab").rgb);
}

TEST(Text, StandsOnItsBaseline) {
    const PixelBox upper = ink(text("H", 40));
    EXPECT_EQ(upper.bottom, 59) << "the row above the baseline";
    EXPECT_NEAR(upper.bottom - upper.top + 1, 0.73 * 40, 1.5) << "the height of DejaVu's capitals";
    EXPECT_GT(ink(text("g", 40)).bottom, 62);
    EXPECT_NEAR(text_width("HHHH", {40}), 4 * text_width("H", {40}), 0.1);
    EXPECT_GT(text_width("HHH", {40, FontWeight::bold}), text_width("HHH", {40}));
    EXPECT_EQ(text_width("", {40}), 0);
}

TEST(Text, IsAlignedAndTurned) {
    Drawing drawing;
    drawing.width = drawing.height = 300;
    const TextStyle style = {20, FontWeight::regular, {0, 0, 0}};
    drawing.write("HHHH", 290, 30, TextAlign::right, style);
    drawing.write("HHHH", 150, 150, TextAlign::centre, style);
    drawing.write_upwards("HHHH", 30, 200, style);
    const Picture picture = painted(drawing);
    const double half = text_width("HHHH", style) / 2;
    const auto ink_in = [&](int left, int top, int right, int bottom) {
        return box_where(picture, left, top, right, bottom,
                         [](Colour colour) { return colour[0] < 128; });
    };
    const PixelBox right = ink_in(100, 0, 300, 50), centre = ink_in(100, 100, 300, 200);
    const PixelBox upwards = ink_in(0, 0, 50, 300);
    EXPECT_NEAR(right.right, 290, 4);
    EXPECT_NEAR(right.left, 290 - 2 * half, 4);
    EXPECT_NEAR((centre.left + centre.right) / 2.0, 150, 1);
    EXPECT_NEAR((upwards.top + upwards.bottom) / 2.0, 200, 1);
    EXPECT_NEAR(upwards.bottom - upwards.top, 2 * half, 6);
    EXPECT_EQ(upwards.right, 29) << "the column left of the baseline";
}

TEST(Text, TakesAnyBytes) {
    EXPECT_TRUE(rc::check([](const std::string& bytes) {
        const int em = *rc::gen::inRange(1, 60);
        RC_ASSERT(std::isfinite(text_width(bytes, {em})));
        RC_ASSERT(text(bytes, em).rgb.size() == 3u * 400 * 100);
    }));
}

// --- Pictures -----------------------------------------------------------------------------------

Picture random_picture() {
    Picture picture(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40));
    for (std::uint8_t& byte : picture.rgb) {
        byte = static_cast<std::uint8_t>(*rc::gen::inRange(0, 256));
    }
    return picture;
}

TEST(Painted, ShowsPicturesAsTheyAre) {
    EXPECT_TRUE(rc::check([] {
        const Picture picture = random_picture();
        Drawing drawing;
        drawing.width = drawing.height = 30;
        const int x = *rc::gen::inRange(-20, 30), y = *rc::gen::inRange(-20, 30);
        drawing.items.emplace_back(PlacedPicture{picture, x, y});
        const Picture whole = painted(drawing);
        testing::for_each_texel(30, 30, [&](int column, int row) {
            const int from_x = column - x, from_y = row - y;
            const bool within =
                from_x >= 0 && from_y >= 0 && from_x < picture.width && from_y < picture.height;
            RC_ASSERT(pixel(whole, column, row) ==
                      (within ? pixel(picture, from_x, from_y) : paper_colour));
        });
    }));
}

TEST(Painted, MayBeLargerThanTheLibrarysSurfaces) {
    Drawing drawing;
    drawing.width = 40000;
    drawing.height = 3;
    drawing.fill(4095, 1, 2, 1, {200, 0, 0});
    drawing.fill(39999, 0, 1, 3, {0, 0, 200});
    const Picture picture = painted(drawing);
    for (const int x : {4095, 4096}) EXPECT_EQ(pixel(picture, x, 1), (Colour{200, 0, 0}));
    EXPECT_EQ(pixel(picture, 4097, 1), paper_colour);
    EXPECT_EQ(pixel(picture, 39999, 2), (Colour{0, 0, 200}));
    EXPECT_TRUE(painted(Drawing()).rgb.empty());
}

// --- SVG ----------------------------------------------------------------------------------------

Drawing sample_drawing() {
    Drawing drawing;
    drawing.width = 200;
    drawing.height = 100;
    drawing.title = "a < b & \"c\" > 'd' \x01";
    drawing.items.emplace_back(PlacedPicture{Picture(4, 4), 10, 10});
    drawing.items.emplace_back(PlacedPicture{Picture(8, 4), 50, 10});
    drawing.write("H", 20, 60, TextAlign::left, {});
    drawing.tooltips.push_back({{20, 30}, "<script>"});
    return drawing;
}

TEST(Svg, IsTheSameBytesForTheSameDrawing) {
    const std::string once = svg_of(sample_drawing(), "a test");
    painted(sample_drawing());  // what else is drawn does not count
    EXPECT_EQ(svg_of(sample_drawing(), "a test"), once);
    EXPECT_NE(once.find("\"image"), std::string::npos);
}

TEST(Svg, SaysItsSizeTitleAndTooltips) {
    const std::string svg = svg_of(sample_drawing(), "a test");
    EXPECT_TRUE(
        svg.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- a test -->\n<svg "))
        << svg;
    EXPECT_NE(svg.find("width=\"200px\" height=\"100px\""), std::string::npos) << svg;
    EXPECT_NE(svg.find("<title>a &lt; b &amp; &quot;c&quot; &gt; &apos;d&apos;  </title>"),
              std::string::npos);
    EXPECT_NE(svg.find("<circle cx=\"20.0\" cy=\"30.0\" r=\"8\" "
                       "fill-opacity=\"0\"><title>&lt;script&gt;</title>"),
              std::string::npos);
    EXPECT_EQ(svg.find("<script>"), std::string::npos);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

// --- PNG ----------------------------------------------------------------------------------------

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

}  // namespace
}  // namespace skybake
