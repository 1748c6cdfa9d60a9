#include "bakers/report/report_files.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace skybake
