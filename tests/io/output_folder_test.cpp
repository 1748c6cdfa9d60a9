#include "bakers/io/files/output_folder.h"

#include "bakers/io/manifest/claimed_files.h"
#include "tests/io/files.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> files = {"transmittance.exr", "manifest.json"};

TEST(OutputFolder, AMissingOneIsFineAndNotMadeByLooking) {
    const TemporaryFolder folder;
    const auto result = inspect_output_folder(folder / "a/b/c", files, false);
    EXPECT_TRUE(result.value.has_value());
    EXPECT_TRUE(folder.names().empty());
    EXPECT_TRUE(create_output_folder(folder / "a/b/c").value.has_value());
    EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
    EXPECT_TRUE(create_output_folder(folder / "a/b/c").value.has_value());
}

TEST(OutputFolder, TakesBackTheFoldersItMade) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "old");
    const auto made = test::without_errors(create_output_folder(folder / "old/a/b"));
    EXPECT_EQ(made.size(), 2u);
    remove_empty_folders(made);
    EXPECT_FALSE(fs::exists(folder / "old/a"));
    EXPECT_TRUE(fs::exists(folder / "old"));
}

TEST(OutputFolder, LeavesFoldersInUse) {
    const TemporaryFolder folder;
    const auto made = test::without_errors(create_output_folder(folder / "a/b"));
    fs::create_directories(folder / "a/other");
    remove_empty_folders(made);
    EXPECT_FALSE(fs::exists(folder / "a/b"));
    EXPECT_TRUE(fs::exists(folder / "a/other"));
}

TEST(OutputFolder, RelativeAndCurrentFoldersAreFine) {
    EXPECT_TRUE(inspect_output_folder("./skybake-absent/", files, false).value.has_value());
    EXPECT_TRUE(inspect_output_folder(".", {}, false).value.has_value());
}

TEST(OutputFolder, ItsOwnFilesMayBeOverwritten) {
    const TemporaryFolder folder;
    testing::write_sample_bake(folder.path(), {"transmittance"});
    const auto result = test::without_errors(inspect_output_folder(folder.path(), files, false));
    ASSERT_TRUE(result.previous.has_value());
    EXPECT_EQ(result.previous->assets[0].name, "transmittance");
}

TEST(OutputFolder, ForeignFilesAreNotOverwritten) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "transmittance.exr", "mine");
    testing::write_bytes(folder / "manifest.json", "{\"name\": \"a web page\"}");
    const auto refused = inspect_output_folder(folder.path(), files, false);
    EXPECT_FALSE(refused.value.has_value());
    ASSERT_EQ(refused.diagnostics.size(), 2u);  // both are named in one run
    EXPECT_EQ(refused.diagnostics[0].code, "E0303");
    EXPECT_EQ(refused.diagnostics[1].code, "E0303");
    EXPECT_NE(refused.diagnostics[0].label.find("--force"), std::string::npos);

    const auto forced = test::without_errors(inspect_output_folder(folder.path(), files, true));
    EXPECT_FALSE(forced.previous.has_value());
}

TEST(OutputFolder, OtherFilesDoNotMatter) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "notes.txt", "mine");
    EXPECT_TRUE(inspect_output_folder(folder.path(), files, false).value.has_value());
}

TEST(OutputFolder, OfAChangedManifestOnlyClaimsCount) {
    const TemporaryFolder folder;
    testing::write_sample_bake(folder.path(), {"transmittance"});
    std::string text = testing::read_bytes(folder / "manifest.json");
    const std::size_t at = text.find("\"texels_s\": 0.004");
    ASSERT_NE(at, std::string::npos);
    text[at + 14] = '5';
    testing::write_bytes(folder / "manifest.json", text);
    const auto result = test::without_errors(inspect_output_folder(folder.path(), files, false));
    EXPECT_NE(result.reason.find("has been changed"), std::string::npos);
    EXPECT_TRUE(result.previous->assets.empty());
    EXPECT_EQ(result.previous->retired.at(0).path, "transmittance.exr");
}

TEST(OutputFolder, EarlierFormatsClaimTheirFiles) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "transmittance.exr", "texels");
    testing::write_bytes(folder / "manifest.json",
                         R"({"format": 1, "tool": {"name": "skybake", "version": "0.1.0"},
                             "assets": [{"files": [{"path": "transmittance.exr", "xxh3": "0"}]}]})");
    const auto result = test::without_errors(inspect_output_folder(folder.path(), files, false));
    EXPECT_NE(result.reason.find("earlier format"), std::string::npos);
    EXPECT_TRUE(ClaimedFiles(*result.previous).hold("transmittance.exr"));
    testing::write_bytes(folder / "second.exr", "mine");
    const std::vector<std::string> second = {"second.exr"};
    EXPECT_EQ(first_code(inspect_output_folder(folder.path(), second, false).diagnostics), "E0303");
}

TEST(OutputFolder, AManifestDoesNotClaimItsNeighbours) {
    const TemporaryFolder folder;
    testing::write_sample_bake(folder.path(), {"second"});
    testing::write_bytes(folder / "transmittance.exr", "mine");
    EXPECT_EQ(first_code(inspect_output_folder(folder.path(), files, false).diagnostics), "E0303");
}

TEST(OutputFolder, AFileInItsPlaceIsReported) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "file", "x");
    for (const char* path : {"file", "file/below", "file/far/below"}) {
        EXPECT_EQ(first_code(inspect_output_folder(folder / path, files, true).diagnostics),
                  "E0302");
        EXPECT_EQ(first_code(create_output_folder(folder / path).diagnostics), "E0302");
    }
}

}  // namespace
}  // namespace skybake
