#include "bakers/report/report_files.h"

#include <gtest/gtest.h>

#include <algorithm>
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
    EXPECT_EQ(row["on_texel_front"], true);
}

TEST(ReportText, CsvLeavesCellsOfVolumesEmptyInRowsOfTables) {
    const auto lines =
        parse_csv(report_csv({testing::sample_report(), testing::sample_volume_report()}));
    ASSERT_EQ(lines.size(), 7u);
    for (const auto& line : lines) EXPECT_EQ(line.size(), lines[0].size());
    const auto column = [&](std::size_t line, const std::string& name) {
        const auto at = std::find(lines[0].begin(), lines[0].end(), name) - lines[0].begin();
        return lines[line].at(static_cast<std::size_t>(at));
    };
    EXPECT_EQ(column(1, "height"), "16");
    EXPECT_EQ(column(4, "height"), "32");
    const std::vector<std::pair<const char*, const char*>> cells = {{"depth", "16"},
                                                                    {"format", "vdb"},
                                                                    {"compression", "blosc"},
                                                                    {"write_ms", "7.5"},
                                                                    {"on_bytes_front", "false"}};
    for (const auto& [name, text] : cells) {
        EXPECT_EQ(column(1, name), "") << name;
        EXPECT_EQ(column(4, name), text) << name;
    }
    EXPECT_EQ(column(5, "on_bytes_front"), "true");
}

TEST(ReportText, JsonSaysOfVolumesWhatTablesDoNotHave) {
    const auto json = nlohmann::json::parse(
        report_json({testing::sample_report(), testing::sample_volume_report()}));
    const auto& table = json["assets"][0];
    const auto& volume = json["assets"][1];
    for (const char* key : {"statistics", "seam_error", "write_repetitions"}) {
        EXPECT_FALSE(table.contains(key)) << key;
        EXPECT_TRUE(volume.contains(key)) << key;
    }
    EXPECT_FALSE(table["rows"][0].contains("depth"));
    EXPECT_EQ(volume["rows"][0]["depth"], 16);
    EXPECT_EQ(volume["rows"][0]["write_ms"], 7.5);
    EXPECT_EQ(volume["statistics"][0]["channel"], "Y");
    EXPECT_EQ(volume["statistics"][0]["min"], 0.25);
    EXPECT_EQ(volume["statistics"][0]["max"], 0.75);
    EXPECT_EQ(volume["statistics"][0]["mean"], 0.5);
    EXPECT_EQ(volume["seam_error"], 0.125);
}

TEST(ReportText, OfNoAssetsIsWellFormed) {
    EXPECT_EQ(parse_csv(report_csv({})).size(), 1u);
    EXPECT_TRUE(nlohmann::json::parse(report_json({}))["assets"].empty());
}

}  // namespace
}  // namespace skybake
