#include "bakers/report/report_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/report/sample_rows.h"

namespace skybake {
namespace {

TEST(ReportFigure, ShowsTitlesUnitsAndLabels) {
    const Figure figure = report_figure(testing::sample_report());
    EXPECT_EQ(figure.title, "air: what accuracy costs");
    EXPECT_EQ(figure.subtitles[0],
              "error against a \"reference\" <finer> & slower (16 points; absolute)");
    EXPECT_EQ(figure.families, std::vector<std::string>{"size"});
    ASSERT_EQ(figure.charts.size(), 2u);
    EXPECT_EQ(figure.charts[0].across.title, "time (ms)");
    EXPECT_EQ(figure.charts[0].up.title, "lookup error, RMS");
    EXPECT_EQ(figure.charts[1].across.title, "files (KiB)");
    const std::vector<ChartPoint>& points = figure.charts[0].points;
    ASSERT_EQ(points.size(), 3u);
    EXPECT_EQ(points[0].label, "the paper's & ours");
    EXPECT_EQ(points[1].label, "this recipe");
    EXPECT_EQ(points[2].label, "") << "neither emphasised nor on the front";
    EXPECT_EQ(points[1].x, 2);
    EXPECT_DOUBLE_EQ(points[1].y, 3e-4);
    EXPECT_TRUE(points[1].on_front && points[1].emphasised && !points[2].on_front);
    EXPECT_NEAR(figure.charts[1].points[0].x, 1234 / 1024.0, 1e-12);
}

TEST(ReportSvg, IsKnownToReports) {
    const std::string svg = report_svg(report_figure(testing::sample_report()));
    EXPECT_LT(svg.find("<!-- skybake report -->"), 100u);
    EXPECT_NE(svg.find("size 128x32, &quot;fine&quot;: 2 ms, lookup error 0.0003 RMS"),
              std::string::npos);
}

}  // namespace
}  // namespace skybake
