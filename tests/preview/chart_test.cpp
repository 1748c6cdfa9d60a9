#include "bakers/plot/chart.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "bakers/plot/axis_ticks.h"
#include "bakers/plot/colour_map.h"
#include "bakers/plot/field_scaling.h"
#include "bakers/plot/label.h"

namespace skybake {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Colour pixel(const Picture& picture, int x, int y) {
    const auto at = 3 * static_cast<std::size_t>(y * picture.width + x);
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

// Where a colour stands in a picture: its first and last column and row.
struct Box {
    int left = std::numeric_limits<int>::max();
    int top = std::numeric_limits<int>::max();
    int right = -1;
    int bottom = -1;
    int count = 0;
};
Box box_of(const Picture& picture, Colour colour, int x_end) {
    Box box;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < std::min(x_end, picture.width); ++x) {
            if (pixel(picture, x, y) != colour) continue;
            box.left = std::min(box.left, x);
            box.right = std::max(box.right, x);
            box.top = std::min(box.top, y);
            box.bottom = std::max(box.bottom, y);
            ++box.count;
        }
    }
    return box;
}

ChartAxis axis(double first, double last, double power = 1, AxisTicks ticks = AxisTicks::decimal) {
    return {"axis", [=](double t) { return first + std::pow(t, power) * (last - first); }, ticks};
}

std::vector<std::string> labels(const std::vector<AxisTick>& ticks) {
    std::vector<std::string> words;
    for (const AxisTick& tick : ticks) words.push_back(tick.label);
    return words;
}
using Words = std::vector<std::string>;

// --- Ticks --------------------------------------------------------------------------------------

TEST(AxisTicks, StandAtRoundNumbers) {
    EXPECT_EQ(labels(axis_ticks(axis(0, 100), 0.15)), (Words{"0", "20", "40", "60", "80", "100"}));
    EXPECT_EQ(labels(axis_ticks(axis(0.13, -0.31), 0.1)),
              (Words{"0.1", "0.05", "0", "−0.05", "−0.1", "−0.15", "−0.2", "−0.25", "−0.3"}));
    EXPECT_EQ(labels(axis_ticks(axis(0, 180, 1, AxisTicks::angles), 0.1)),
              (Words{"0", "30", "60", "90", "120", "150", "180"}));
    const ChartAxis decades{"", [](double t) { return std::pow(10.0, 3 * t - 5); },
                            AxisTicks::logarithmic};
    EXPECT_EQ(labels(axis_ticks(decades, 0.2)), (Words{"10⁻⁵", "10⁻⁴", "0.001", "0.01"}));
}

TEST(AxisTicks, AreFinerWhereTheAxisIsStretched) {
    // Altitude by its root: kilometres near the ground, tens of them above.
    const std::vector<AxisTick> ticks = axis_ticks(axis(0, 100, 2), 0.07);
    const Words words = labels(ticks);
    EXPECT_NE(std::find(words.begin(), words.end(), "2"), words.end());
    EXPECT_EQ(std::find(words.begin(), words.end(), "99"), words.end());
}

TEST(AxisTicks, LieWhereTheAxisHasTheirValueAndKeepTheirDistance) {
    EXPECT_TRUE(rc::check([] {
        const double first = *rc::gen::inRange(-1000, 1000) / 7.0;
        const double last = *rc::gen::suchThat(
            rc::gen::map(rc::gen::inRange(-1000, 1000), [](int n) { return n / 3.0; }),
            [&](double value) { return std::abs(value - first) > 1e-6; });
        const double power = *rc::gen::inRange(2, 60) / 10.0;
        const double gap = *rc::gen::inRange(2, 50) / 100.0;
        const auto kind = *rc::gen::element(AxisTicks::decimal, AxisTicks::angles);
        const ChartAxis chosen = axis(first, last, power, kind);
        const std::vector<AxisTick> ticks = axis_ticks(chosen, gap);
        double previous = -1;
        for (const AxisTick& tick : ticks) {
            RC_ASSERT(tick.t >= 0 && tick.t <= 1);
            RC_ASSERT(previous < 0 || tick.t - previous >= gap);
            // The value lies between those a billionth of the axis to both sides, but for rounding.
            const double before = chosen.value(std::max(tick.t - 1e-9, 0.0));
            const double after = chosen.value(std::min(tick.t + 1e-9, 1.0));
            const double rounding = 1e-8 * std::abs(last - first);
            RC_ASSERT(tick.value >= std::min(before, after) - rounding);
            RC_ASSERT(tick.value <= std::max(before, after) + rounding);
            previous = tick.t;
        }
        // With so much room there is always a round number.
        RC_ASSERT(gap > 0.1 || !ticks.empty());
    }));
}

TEST(AxisTicks, AreNotThereWithoutARange) {
    EXPECT_TRUE(axis_ticks(axis(3, 3), 0.1).empty());
    EXPECT_TRUE(axis_ticks(axis(0, nan), 0.1).empty());
    EXPECT_TRUE(axis_ticks(axis(0, INFINITY), 0.1).empty());
    const ChartAxis from_zero{"", [](double t) { return t; }, AxisTicks::logarithmic};
    EXPECT_FALSE(axis_ticks(from_zero, 0.1).empty()) << "no logarithms, but numbers";
}

TEST(NumberLabel, IsShort) {
    EXPECT_EQ(number_label(0), "0");
    EXPECT_EQ(number_label(-0.0), "0");
    EXPECT_EQ(number_label(-2.5), "−2.5");
    EXPECT_EQ(number_label(0.1 + 0.2), "0.3");
    EXPECT_EQ(number_label(2.5e-5), "2.5×10⁻⁵");
    EXPECT_EQ(number_label(1e10), "10¹⁰");
    EXPECT_EQ(number_label(-3e20), "−3×10²⁰");
}

// --- Colours ------------------------------------------------------------------------------------

TEST(SequentialColour, IsViridis) {
    // From the original's table of 256 colours, which the polynomials meet within 3 of 255.
    const auto near = [](Colour a, Colour b) {
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 4);
    };
    near(sequential_colour(0), {68, 1, 84});
    near(sequential_colour(127 / 255.0), {33, 144, 141});
    near(sequential_colour(1), {253, 231, 37});
}

TEST(DivergingColour, HasItsMiddleAtOneHalf) {
    EXPECT_EQ(diverging_colour(0.5), (Colour{245, 245, 243}));
    EXPECT_NE(diverging_colour(0.4), diverging_colour(0.6));
    EXPECT_EQ(diverging_colour(1), (Colour{120, 22, 33}));
}

// --- Charts -------------------------------------------------------------------------------------

TEST(FalseColourChart, HasRowZeroAtTheBottomAndTexelsAsSquares) {
    Image2<float> field(4, 2, 1);
    *field.texel(3, 0) = 1;
    const Picture chart =
        false_colour_chart(field, {0, 1, false, false, "value"}, "title", axis(0, 4), axis(0, 2));
    const Box dark = box_of(chart, sequential_colour(0), chart.width - 80);
    const Box bright = box_of(chart, sequential_colour(1), chart.width - 80);
    EXPECT_EQ(dark.right - dark.left + 1, 512);
    EXPECT_EQ(dark.bottom - dark.top + 1, 256);
    EXPECT_EQ(bright.count, 128 * 128);
    EXPECT_EQ(bright.right, dark.right);
    EXPECT_EQ(bright.bottom, dark.bottom);
}

TEST(FalseColourChart, ShowsWhatIsNoNumberInAColourOfItsOwn) {
    Image2<float> field(2, 1, 1);
    *field.texel(0, 0) = std::numeric_limits<float>::quiet_NaN();
    const Picture chart =
        false_colour_chart(field, {0, 1, false, false, ""}, "", axis(0, 1), axis(0, 1));
    const Box dark = box_of(chart, sequential_colour(0), chart.width - 80);
    const Colour missing = pixel(chart, dark.left - 10, dark.top + 10);
    for (int i = 0; i <= 255; ++i) EXPECT_NE(missing, sequential_colour(i / 255.0));
}

TEST(FalseColourChart, TakesAnyFieldAndScale) {
    EXPECT_TRUE(rc::check([] {
        Image2<float> field(*rc::gen::inRange(0, 40), *rc::gen::inRange(0, 40), 1);
        for (float& value : field.texels) value = *rc::gen::arbitrary<float>();
        const ColourScale scale{*rc::gen::arbitrary<double>(), *rc::gen::arbitrary<double>(),
                                *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(),
                                *rc::gen::arbitrary<std::string>()};
        const Picture chart = false_colour_chart(field, scale, "", axis(0, 1), axis(0, 1), 64);
        RC_ASSERT(chart.rgb.size() == 3 * static_cast<std::size_t>(chart.width) *
                                          static_cast<std::size_t>(chart.height));
        RC_ASSERT((chart.width == 0) == field.texels.empty());
    }));
}

TEST(Framed, KeepsThePicturesPixels) {
    Picture picture(60, 40);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        picture.rgb[i] = static_cast<std::uint8_t>(i % 3 == 0 ? 200 : i % 251 / 2);
    }
    const Picture chart = framed(picture, "", axis(0, 1), axis(0, 1));
    int found = 0;
    for (int y = 0; y + 40 <= chart.height; ++y) {
        for (int x = 0; x + 60 <= chart.width; ++x) {
            bool same = true;
            for (int row = 0; row < 40 && same; ++row) {
                const auto at = [&](const Picture& p, int i, int j) {
                    return p.rgb.begin() + 3 * (j * p.width + i);
                };
                same = std::equal(at(picture, 0, row), at(picture, 0, row) + 180,
                                  at(chart, x, y + row));
            }
            found += same ? 1 : 0;
        }
    }
    EXPECT_EQ(found, 1);
    EXPECT_TRUE(framed(Picture(), "", axis(0, 1), axis(0, 1)).rgb.empty());
}

TEST(LineChart, DrawsARisingLineFromLowerLeftToUpperRight) {
    const Colour red{200, 0, 0};
    const Picture chart =
        line_chart({{"", red, {0, 1, 2}, {0, 5, 10}}}, "", "x", "y", false, false);
    const Box line = box_of(chart, red, chart.width);
    ASSERT_GT(line.count, 500);
    for (int x = line.left + 2; x < line.right - 2; x += 50) {
        const Box left = box_of(chart, red, x);
        EXPECT_GT(left.top, line.top) << "rises to the right, up to column " << x;
    }
    EXPECT_GT(line.right - line.left, 550);
}

TEST(LineChart, LeavesGapsWhereThereIsNoValue) {
    const Colour red{200, 0, 0};
    std::vector<double> x, y;
    for (int i = 0; i <= 100; ++i) {
        x.push_back(i);
        y.push_back(i > 40 && i < 60 ? -1.0 : 1.0);  // which has no logarithm
    }
    const Picture chart = line_chart({{"", red, x, y}}, "", "", "", false, true);
    const Box line = box_of(chart, red, chart.width);
    const int middle = (line.left + line.right) / 2;
    for (int row = 0; row < chart.height; ++row) EXPECT_NE(pixel(chart, middle, row), red);
}

TEST(LineChart, TakesAnyNumbers) {
    EXPECT_TRUE(rc::check([] {
        std::vector<ChartLine> lines(*rc::gen::inRange<std::size_t>(0, 4));
        for (ChartLine& line : lines) {
            line.name = *rc::gen::arbitrary<std::string>();
            line.x = *rc::gen::arbitrary<std::vector<double>>();
            line.y = *rc::gen::arbitrary<std::vector<double>>();
            if (*rc::gen::arbitrary<bool>()) line.y.push_back(nan);
            if (*rc::gen::arbitrary<bool>()) line.y.push_back(-INFINITY);
        }
        const Picture chart =
            line_chart(lines, "", "", "", *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>());
        RC_ASSERT(chart.width > 600 && chart.width < 4000 && chart.height > 320);
    }));
}

TEST(ContactSheet, PlacesPicturesInRowsWithTheirCaptions) {
    const std::vector<Colour> colours = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
    std::vector<Picture> pictures;
    for (const Colour& colour : colours) {
        Picture picture(80, 50);
        for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = colour[i % 3];
        pictures.push_back(picture);
    }
    const Picture sheet = contact_sheet(pictures, {"a", "a caption of many words", "c"}, 2);
    const Box first = box_of(sheet, colours[0], sheet.width);
    const Box second = box_of(sheet, colours[1], sheet.width);
    const Box third = box_of(sheet, colours[2], sheet.width);
    for (const Box& box : {first, second, third}) EXPECT_EQ(box.count, 80 * 50);
    EXPECT_EQ(first.top, second.top);
    EXPECT_GT(second.left, first.right);
    EXPECT_EQ(third.left, first.left);
    EXPECT_GT(third.top, first.bottom + 40) << "two lines of caption lie between";
    EXPECT_LT(sheet.width, 4 * 80);
    EXPECT_EQ(contact_sheet(pictures, {}, 99).height, 50 + 2 * 14);
    EXPECT_GT(contact_sheet({}, {}, 0).width, 0);
}

TEST(Fitted, RepeatsOrAverages) {
    Image2<float> field(3, 2, 2);
    for (std::size_t i = 0; i < field.texels.size(); ++i) field.texels[i] = static_cast<float>(i);
    const Image2<float> large = fitted(field, 7, 20);
    EXPECT_EQ(large.width, 9);
    EXPECT_EQ(large.height, 6);
    EXPECT_EQ(large.texel(8, 5)[1], field.texel(2, 1)[1]);
    const Image2<float> small = fitted(field, 1, 2);
    EXPECT_EQ(small.width, 2);
    EXPECT_EQ(small.height, 1);
    EXPECT_EQ(small.texel(0, 0)[0], (0 + 2 + 6 + 8) / 4.0F);
    EXPECT_EQ(small.texel(1, 0)[1], (5 + 11) / 2.0F);
}

// --- Text ---------------------------------------------------------------------------------------

const TextBitmap& text(std::string_view words, int em = 14) {
    return label(words, em, FontWeight::regular);
}

TEST(Label, DrawsWhatIsNotAscii) {
    ASSERT_FALSE(text_problem().has_value()) << text_problem()->message;
    std::set<std::vector<std::uint8_t>> different;
    const std::vector<std::string> words = {"e", "é", "0", "°", "µ", "λ", "−", "×", "⁻⁵", "Ψ", "�"};
    for (const std::string& word : words) different.insert(text(word).coverage);
    EXPECT_EQ(different.size(), words.size());
}

TEST(Label, ReplacesWhatIsNoText) {
    EXPECT_EQ(text("\xff").coverage, text("�").coverage);
    EXPECT_EQ(text("a\xc3").coverage, text("a�").coverage);
    EXPECT_EQ(text("\xed\xa0\x80").coverage, text("���").coverage) << "a surrogate";
    EXPECT_EQ(text("\xc0\xaf").coverage, text("��").coverage) << "a longer form of /";
    EXPECT_EQ(text("a\nb\t").coverage, text("a b ").coverage);
}

TEST(Label, OfNothingIsNothing) {
    for (const char* blank : {"", " ", "   "}) {
        EXPECT_TRUE(text(blank).problem.empty());
        EXPECT_TRUE(text(blank).coverage.empty());
    }
    EXPECT_EQ(text("").advance, 0);
    EXPECT_GT(text(" ").advance, 2);
    EXPECT_FALSE(text("a", 0).problem.empty());
    EXPECT_FALSE(text("a", 257).problem.empty());
    EXPECT_FALSE(text(std::string(5000, 'a')).problem.empty());
}

TEST(Label, StandsOnItsBaseline) {
    const TextBitmap& upper = text("H", 40);
    EXPECT_EQ(upper.baseline, upper.height) << "nothing below the baseline";
    EXPECT_NEAR(upper.height, 0.73 * 40, 1.5) << "the height of DejaVu's capitals";
    EXPECT_GT(text("g", 40).height, text("g", 40).baseline);
    EXPECT_NEAR(text("HHHH", 40).advance, 4 * upper.advance, 1e-3);
    EXPECT_GT(label("HHH", 40, FontWeight::bold).advance, text("HHH", 40).advance);
}

TEST(Label, TakesAnyBytes) {
    EXPECT_TRUE(rc::check([](const std::string& bytes) {
        const TextBitmap& bitmap = text(bytes, *rc::gen::inRange(1, 60));
        RC_ASSERT(bitmap.problem.empty());
        RC_ASSERT(bitmap.coverage.size() ==
                  static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height));
        RC_ASSERT(std::isfinite(bitmap.advance));
    }));
}

}  // namespace
}  // namespace skybake
