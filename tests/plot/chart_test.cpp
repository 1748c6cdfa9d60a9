#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bakers/plot/chart.h"
#include "bakers/plot/chart_points.h"
#include "tests/plot/axes.h"
#include "tests/plot/pixels.h"

namespace skybake {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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
    const PixelBox dark = box_of(chart, sequential_colour(0), chart.width - 80);
    const PixelBox bright = box_of(chart, sequential_colour(1), chart.width - 80);
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
    const PixelBox dark = box_of(chart, sequential_colour(0), chart.width - 80);
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
    const PixelBox line = box_of(chart, red, chart.width);
    ASSERT_GT(line.count, 500);
    for (int x = line.left + 2; x < line.right - 2; x += 50) {
        const PixelBox left = box_of(chart, red, x);
        EXPECT_GT(left.top, line.top) << "rises to the right, up to column " << x;
    }
    EXPECT_GT(line.right - line.left, 550);
}

TEST(LineChart, ShowsNamesBesideSamplesOfTheirColours) {
    const Colour red{200, 0, 0};
    const std::vector<double> x = {0, 1}, y = {0, 1};
    const Picture chart =
        line_chart({{"a", red, x, y}, {"b", {0, 0, 200}, x, y}}, "", "", "", false, false);
    const PixelBox samples =
        box_where(chart, 0, 0, chart.width, 60, [&](Colour colour) { return colour == red; });
    EXPECT_EQ(samples.count, 18 * 3);
    EXPECT_EQ(samples.bottom - samples.top, 2);
}

TEST(LineChart, LeavesGapsWhereThereIsNoValue) {
    const Colour red{200, 0, 0};
    std::vector<double> x, y;
    for (int i = 0; i <= 100; ++i) {
        x.push_back(i);
        y.push_back(i > 40 && i < 60 ? -1.0 : 1.0);  // -1 has no logarithm
    }
    const Picture chart = line_chart({{"", red, x, y}}, "", "", "", false, true);
    const PixelBox line = box_of(chart, red, chart.width);
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

TEST(ContactSheet, IsAsWideAsItsTitles) {
    SheetBlock block{"short", {"one"}, {"row"}, {Picture(20, 20)}};
    const int narrow = contact_sheet({block}).width;
    block.title = std::string(60, 'm');
    EXPECT_GT(contact_sheet({block}).width, narrow + 400);
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
    const PixelBox first = box_of(sheet, colours[0], sheet.width);
    const PixelBox second = box_of(sheet, colours[1], sheet.width);
    const PixelBox third = box_of(sheet, colours[2], sheet.width);
    for (const PixelBox& box : {first, second, third}) EXPECT_EQ(box.count, 80 * 50);
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

// --- Drawings -----------------------------------------------------------------------------------

// Where each line of text is, as wide as its letters and as high as its capitals.
std::vector<std::pair<std::string, Box>> texts_of(const Drawing& drawing) {
    std::vector<std::pair<std::string, Box>> texts;
    for (const DrawingItem& item : drawing.items) {
        const auto* const line = std::get_if<TextLine>(&item);
        if (line == nullptr) continue;
        const double width = text_width(line->text, line->style);
        const double height = 0.73 * line->style.em_pixels;
        const double before = line->align == TextAlign::left     ? 0
                              : line->align == TextAlign::centre ? width / 2
                                                                 : width;
        const auto [x, y] = line->baseline;
        texts.emplace_back(line->text, line->upwards
                                           ? Box{x - height, y - before, x, y - before + width}
                                           : Box{x - before, y - height, x - before + width, y});
    }
    return texts;
}

void expect_legible(const Drawing& drawing) {
    const auto texts = texts_of(drawing);
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const auto& [text, box] = texts[i];
        EXPECT_TRUE(box.left >= 0 && box.top >= 0 && box.right <= drawing.width &&
                    box.bottom <= drawing.height)
            << text << " is cut off";
        for (std::size_t j = 0; j < i; ++j) {
            const Box& other = texts[j].second;
            EXPECT_FALSE(box.left < other.right && other.left < box.right &&
                         box.top < other.bottom && other.top < box.bottom)
                << text << " covers " << texts[j].first;
        }
    }
}

Figure sample_figure() {
    Figure figure;
    figure.title = "air: what accuracy costs";
    figure.subtitles = {
        "error against a reference of so many words that it is wider than the chart "
        "below it, which is not as wide as two of them would be",
        "time"};
    figure.front_name = "Pareto front";
    std::vector<ChartPoint> points;
    for (int i = 0; i < 24; ++i) {
        const int family = family_index(figure.families, "family " + std::to_string(i % 9));
        points.push_back({std::pow(10.0, i % 7), std::pow(10.0, -i % 5), family,
                          "variant " + std::to_string(i), "tooltip", i == 5, i % 4 == 0});
    }
    figure.charts = {scatter_chart(points, "All", "time (ms)", "error, RMS")};
    return figure;
}

TEST(Charts, CoverNoTextByAnother) {
    expect_legible(drawing_of(sample_figure()));
    Chart chart = scatter_chart({}, "A title", "x", "y");
    expect_legible(drawing_of(chart));
    chart.across = axis(-0.31, 0.13);
    chart.up = axis(0, 180, 2, AxisTicks::angles);
    chart.colours = ColourScale{1e-5, 1e3, true, false, "optical depth"};
    for (int i = 0; i < 9; ++i) chart.lines.push_back({"line " + std::to_string(i), {}, {}, {}});
    expect_legible(drawing_of(chart));
}

TEST(Charts, DrawPointsWhereTheTicksSay) {
    Figure figure;
    figure.families = {"circles", "squares"};
    figure.charts = {scatter_chart({{1, 1e-4, 0, "", "a", false, false},
                                    {10, 1e-2, 1, "", "b", true, false},
                                    {100, 1, 1, "", "c", false, false}},
                                   "", "time", "error")};
    const Drawing drawing = drawing_of(figure);
    const Picture picture = painted(drawing);
    const auto centre_of = [&](const std::string& label) {
        for (const auto& [text, box] : texts_of(drawing)) {
            if (text == label)
                return DrawingPoint{(box.left + box.right) / 2, (box.top + box.bottom) / 2};
        }
        ADD_FAILURE() << "no tick " << label;
        return DrawingPoint{};
    };
    const std::vector<std::array<std::string, 3>> ticks = {
        {"a", "1", "10⁻⁴"}, {"b", "10", "0.01"}, {"c", "100", "1"}};
    for (const auto& [name, x, y] : ticks) {
        const auto tooltip = std::find_if(drawing.tooltips.begin(), drawing.tooltips.end(),
                                          [&](const Tooltip& one) { return one.text == name; });
        ASSERT_NE(tooltip, drawing.tooltips.end());
        if (name != "c") {
            EXPECT_NEAR(tooltip->centre.x, centre_of(x).x, 1.5) << name;
        }
        if (name != "c") {
            EXPECT_NEAR(tooltip->centre.y, centre_of(y).y, 1.5) << name;
        }
        const Colour expected = name == "a" ? Colour{0x00, 0x72, 0xb2} : Colour{0xd5, 0x5e, 0x00};
        EXPECT_EQ(pixel(picture, static_cast<int>(tooltip->centre.x),
                        static_cast<int>(tooltip->centre.y)),
                  expected)
            << name;
    }
}

TEST(Charts, TakeAnyNumbers) {
    Figure figure;
    figure.families = {"one"};
    std::vector<ChartPoint> points;
    for (const double value : {0.0, -1.0, 1e-320, 1e308, double{INFINITY}, nan}) {
        points.push_back({value, value, 0, "point", "", false, true});
    }
    figure.charts = {scatter_chart(points, "", "", ""), scatter_chart({}, "", "", "")};
    const std::string svg = svg_of(drawing_of(figure), "");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_GT(svg.size(), 1000u);
    EXPECT_GT(painted(drawing_of(Figure())).width, 0);
}

bool overlap(const Box& a, const Box& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

constexpr Box area = {0, 0, 400, 300};

TEST(LabelPlacement, LabelsOfACrowdTouchNeitherEachOtherNorThePointsNorTheEdge) {
    std::vector<Label> labels;
    std::vector<Box> points;
    for (int i = 0; i < 12; ++i) {
        const double x = 190 + 3 * i;
        const double y = 150 + 2 * (i % 5);
        labels.push_back({x, y, 60, 12});
        points.push_back({x - 4, y - 4, x + 4, y + 4});
    }
    const auto boxes = place_labels(labels, area, points, {});
    ASSERT_EQ(boxes.size(), labels.size());
    int placed = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i]) continue;
        ++placed;
        EXPECT_GE(boxes[i]->left, area.left);
        EXPECT_LE(boxes[i]->right, area.right);
        EXPECT_GE(boxes[i]->top, area.top);
        EXPECT_LE(boxes[i]->bottom, area.bottom);
        for (const Box& point : points) EXPECT_FALSE(overlap(*boxes[i], point));
        for (std::size_t j = 0; j < i; ++j) {
            if (boxes[j]) {
                EXPECT_FALSE(overlap(*boxes[i], *boxes[j]));
            }
        }
    }
    EXPECT_GE(placed, 8);
}

TEST(LabelPlacement, PrefersAPlaceWithoutALine) {
    const std::vector<Segment> lines = {{200, 150, 400, 150}};
    const auto boxes = place_labels({{200, 150, 50, 12}}, area, {}, lines);
    ASSERT_TRUE(boxes[0]);
    EXPECT_FALSE(boxes[0]->right > 200 && boxes[0]->top < 150 && boxes[0]->bottom > 150);
}

TEST(LabelPlacement, LeavesOutWhatDoesNotFit) {
    EXPECT_FALSE(place_labels({{200, 150, 500, 12}}, area, {}, {})[0]);
}

}  // namespace
}  // namespace skybake
