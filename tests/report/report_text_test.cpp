#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

#include "bakers/report/report_files.h"
#include "tests/config/recipes.h"
#include "tests/report/sample_rows.h"

namespace skybake {

namespace {

// RFC 4180.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
    std::vector<std::vector<std::string>> lines = {{""}};
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char letter = text[i];
        if (letter == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"') {
            lines.back().back() += text[++i];
        } else if (letter == '"') {
            quoted = !quoted;
        } else if (letter == ',' && !quoted) {
            lines.back().emplace_back();
        } else if (letter == '\n' && !quoted) {
            lines.push_back({""});
        } else {
            lines.back().back() += letter;
        }
    }
    lines.pop_back();
    return lines;
}

TEST(ReportText, CsvHasARowForEachVariantAndAnAsManyCells) {
    const auto lines = parse_csv(report_csv({testing::sample_report()}));
    ASSERT_EQ(lines.size(), 4u);
    for (const auto& line : lines) EXPECT_EQ(line.size(), lines[0].size());
    EXPECT_EQ(lines[0][0], "asset");
    EXPECT_EQ(lines[2][2], "128x32, \"fine\"");
    EXPECT_EQ(lines[1][3], "the paper's & ours");
}

TEST(ReportText, JsonSaysTheSame) {
    const auto json = nlohmann::json::parse(report_json({testing::sample_report()}));
    EXPECT_EQ(json["report"]["tool"], "skybake");
    const auto& asset = json["assets"][0];
    EXPECT_EQ(asset["reference"], "a \"reference\" <finer> & slower");
    EXPECT_EQ(asset["rows"].size(), 3u);
    const auto& row = asset["rows"][1];
    EXPECT_EQ(row["width"], 64);
    EXPECT_EQ(row["file_bytes"], 1234);
    EXPECT_EQ(row["time_ms"], 2.0);
    EXPECT_DOUBLE_EQ(row["lookup_error_rms"].get<double>(), 3e-4);
    EXPECT_EQ(row["texel_error_max"], 2e-4);
    EXPECT_EQ(row["of_recipe"], true);
    EXPECT_EQ(row["on_bytes_front"], true);
}

TEST(ReportText, TablesHaveADepthOfOne) {
    const auto json = nlohmann::json::parse(report_json({testing::sample_report()}));
    EXPECT_EQ(json["assets"][0]["rows"][0]["depth"], 1);
    EXPECT_EQ(json["assets"][0]["rows"][2]["depth"], 16);
}

TEST(ReportText, OfNoAssetsIsWellFormed) {
    EXPECT_EQ(parse_csv(report_csv({})).size(), 1u);
    EXPECT_TRUE(nlohmann::json::parse(report_json({}))["assets"].empty());
}

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

TEST(ReportFiles, AreNamedAsAnnounced) {
    std::vector<std::string> names;
    for (const NamedFile& file : report_files({testing::sample_report()})) {
        names.push_back(file.name);
    }
    EXPECT_EQ(names, report_file_names({"air"}));
}

TEST(ReportFiles, KnowTheirOwn) {
    for (const NamedFile& file : report_files({testing::sample_report()})) {
        EXPECT_TRUE(is_report_text(file.name, file.bytes)) << file.name;
        EXPECT_FALSE(is_report_text(file.name, "mine")) << file.name;
        EXPECT_FALSE(is_report_text(file.name, "")) << file.name;
    }
}

TEST(ReportFiles, ForeignOnesAreDiagnosed) {
    const config::testing::TemporaryFolder folder;
    const auto names = report_file_names({"air"});
    EXPECT_TRUE(foreign_report_files(folder.path(), names).empty());
    for (const NamedFile& file : report_files({testing::sample_report()})) {
        folder.write(file.name, file.bytes);
    }
    EXPECT_TRUE(foreign_report_files(folder.path(), names).empty());
    folder.write("air.svg", "<svg/>");
    const auto diagnostics = foreign_report_files(folder.path(), names);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0303");
}

}  // namespace

}  // namespace skybake
