#include "bakers/report/report_files.h"

#include <gtest/gtest.h>

#include "tests/config/recipes.h"
#include "tests/report/sample_rows.h"

namespace skybake {
namespace {

TEST(ReportFiles, AreNamedAsAnnounced) {
    std::vector<std::string> names;
    for (const ReportFile& file : report_files({testing::sample_report()})) {
        names.push_back(file.name);
    }
    EXPECT_EQ(names, report_file_names({"air"}));
}

TEST(ReportFiles, KnowTheirOwn) {
    for (const ReportFile& file : report_files({testing::sample_report()})) {
        EXPECT_TRUE(is_report_text(file.name, file.text)) << file.name;
        EXPECT_FALSE(is_report_text(file.name, "mine")) << file.name;
        EXPECT_FALSE(is_report_text(file.name, "")) << file.name;
    }
}

TEST(ReportFiles, ForeignOnesAreDiagnosed) {
    const config::testing::TemporaryFolder folder;
    const auto names = report_file_names({"air"});
    EXPECT_TRUE(foreign_report_files(folder.path(), names).empty());
    for (const ReportFile& file : report_files({testing::sample_report()})) {
        folder.write(file.name, file.text);
    }
    EXPECT_TRUE(foreign_report_files(folder.path(), names).empty());
    folder.write("air.svg", "<svg/>");
    const auto diagnostics = foreign_report_files(folder.path(), names);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0303");
}

}  // namespace
}  // namespace skybake
