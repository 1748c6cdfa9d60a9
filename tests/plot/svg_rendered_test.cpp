// SVG files as another program, librsvg, draws them: they show what the PNG of the same drawing does.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "bakers/io/formats/png/map_image.h"
#include "bakers/plot/chart.h"
#include "tests/io/files.h"
#include "tests/plot/pixels.h"

namespace skybake {
namespace {

// Returns the red, green or blue of a PNG, row by row, from 0 to 255.
std::vector<float> channel_of(const std::filesystem::path& path, const std::string& channel) {
    config::CloudMap map;
    map.path = path;
    map.channel = channel;
    auto read = read_map_image(map);
    if (!read.value) return {};
    for (float& value : read.value->values) value *= 255;
    return std::move(read.value->values);
}

// Returns the largest difference between the means of two pictures over squares of `edge` pixels, in
// any channel. The two renderers place letters up to half a pixel apart, which changes such means by at
// most 13 of 255; a shape at a wrong place changes them by more than 50.
double largest_difference(const Picture& picture, const std::filesystem::path& other, int edge) {
    double largest = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::vector<float> values = channel_of(other, std::string(1, "RGB"[channel]));
        if (3 * values.size() != picture.rgb.size()) return std::numeric_limits<double>::infinity();
        for (int top = 0; top + edge <= picture.height; top += edge) {
            for (int left = 0; left + edge <= picture.width; left += edge) {
                double sum = 0;
                for (int y = top; y < top + edge; ++y) {
                    for (int x = left; x < left + edge; ++x) {
                        const auto at = static_cast<std::size_t>(y * picture.width + x);
                        sum += picture.rgb[3 * at + channel] - values[at];
                    }
                }
                largest = std::max(largest, std::abs(sum) / (edge * edge));
            }
        }
    }
    return largest;
}

// Two charts with titles, legends, ticks, lines, a front, markers and labels.
Figure sample_figure() {
    Figure figure;
    figure.title = "what accuracy costs";
    figure.subtitles = {"error against a reference"};
    figure.families = {"first", "second", "third"};
    figure.front_name = "Pareto front";
    std::vector<ChartPoint> points;
    for (int i = 0; i < 9; ++i) {
        points.push_back({std::exp2(i), std::pow(0.3, i) * (i % 3 + 1), i % 3,
                          "size " + std::to_string(i), "", i == 4, i % 2 == 0});
    }
    figure.charts.push_back(scatter_chart(points, "Lookups", "time (ms)", "error, RMS"));
    figure.charts.push_back(scatter_chart(points, "Texels", "time (ms)", "error, max"));
    figure.charts[1].lines = {{"a line", {200, 30, 30}, {1, 16, 256}, {1, 1e-3, 1e-4}},
                              {"another", {30, 30, 200}, {1, 4, 256}, {1e-4, 0.1, 1}}};
    return figure;
}

// A picture under axes, with a bar of colours.
Chart sample_field() {
    Picture picture(96, 64);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        picture.rgb[i] = static_cast<std::uint8_t>(i % 251);
    }
    const ChartAxis axis = linear_axis("metres", 0, 100);
    return {"a field", axis, axis, 96, 64, picture, ColourScale{}};
}

TEST(Svg, LooksLikeThePngOfTheSameDrawing) {
    if (std::system("rsvg-convert --version >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "rsvg-convert is not installed";
    }
    const testing::TemporaryFolder folder;
    const std::string svg = folder / "drawing.svg", png = folder / "drawing.png";
    for (const Drawing& light : {drawing_of(sample_figure()), drawing_of(sample_field())}) {
        for (const Drawing& drawing : {light, on_dark_paper(light)}) {
            testing::write_bytes(svg, svg_of(drawing, "a test"));
            ASSERT_EQ(std::system(("rsvg-convert '" + svg + "' -o '" + png + "'").c_str()), 0);
            EXPECT_LT(largest_difference(painted(drawing), png, 8), 20) << drawing.title;
        }
    }
}

}  // namespace
}  // namespace skybake
