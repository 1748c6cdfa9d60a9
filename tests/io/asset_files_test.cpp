#include "bakers/io/manifest/asset_files.h"

#include <fmt/format.h>

#include <chrono>

#include "bakers/io/files/output_folder.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/math/hash.h"
#include "config/assets/noise_volume.h"
#include "config/assets/transmittance.h"
#include "tests/io/small_disks.h"
#include "tests/support/cancelled_at.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using config::FileFormat;
using testing::sample_volume;
using Names = std::vector<std::string>;

TEST(WriteVolume, MakesAFileForEachFormatAndLevel) {
    const TemporaryFolder folder;
    const Baked volume =
        sample_volume({12, 10, 7}, 3, PixelType::half, {FileFormat::exr, FileFormat::bin}, 3);
    const Manifest manifest = testing::write_sample_volume(folder.path(), volume);
    EXPECT_EQ(folder.names(), (Names{"manifest.json", "shape.bin", "shape.exr", "shape.mip1.bin",
                                     "shape.mip1.exr", "shape.mip2.bin", "shape.mip2.exr"}));
    const ManifestAsset& asset = manifest.assets[0];
    ASSERT_EQ(asset.files.size(), 6U);
    for (const ManifestFile& file : asset.files) {
        const std::string bytes = read_bytes(folder / file.path);
        EXPECT_EQ(file.bytes, bytes.size());
        EXPECT_EQ(file.xxh3, xxh3_hex(bytes));
        // Bare voxels are what the content hash is taken of.
        const auto& level = asset.levels[static_cast<std::size_t>(file.level)];
        if (file.format == "bin") {
            EXPECT_EQ(file.xxh3, level.content_hash);
        }
    }
    EXPECT_GT(asset.timing.write_s, 0);
}

TEST(WriteVolume, NamesFollowFromTheRecipe) {
    config::NoiseVolumeBake bake;
    bake.formats = {FileFormat::exr, FileFormat::vdb};
    bake.mips = 2;
    EXPECT_EQ(file_names({"shape", bake}),
              (Names{"shape.exr", "shape.mip1.exr", "shape.vdb", "shape.mip1.vdb"}));
    EXPECT_EQ(file_names({"sky", config::TransmittanceBake{}}), Names{"sky.exr"});
    const Baked volume = sample_volume({4, 4, 4}, 1, PixelType::half, bake.formats, 2);
    Names described;
    for (const ManifestFile& file : describe_with_files(volume).files) {
        described.push_back(file.path);
    }
    EXPECT_EQ(described, file_names({"shape", bake}));
}

TEST(WriteVolume, FilesSayWhatTheyAre) {
    const TemporaryFolder folder;
    Baked volume = sample_volume({12, 10, 7}, 3, PixelType::half, {FileFormat::exr}, 2);
    volume.layout = config::SheetLayout::atlas;
    volume.columns = 3;
    const Manifest manifest = testing::write_sample_volume(folder.path(), volume);
    const auto entry = entry_of_file(folder / "shape.exr");
    ASSERT_TRUE(entry.value.has_value());
    ASSERT_EQ(entry.value->levels.size(), 1U);
    EXPECT_EQ(entry.value->levels[0].size, (std::array<int, 3>{12, 10, 7}));
    EXPECT_EQ(entry.value->content_hash, volume.levels[0].content_hash);
    EXPECT_EQ(entry.value->levels[0].probes.size(), 16U);
    EXPECT_EQ(entry.value->parameters, volume.parameters);
    EXPECT_EQ(entry.value->files[0].path, "shape.exr");
    EXPECT_EQ(entry.value->files[0].layout->columns, 3);
    const auto mip = entry_of_file(folder / "shape.mip1.exr");
    ASSERT_TRUE(mip.value.has_value());
    EXPECT_EQ(mip.value->content_hash, volume.levels[1].content_hash);
    EXPECT_EQ(mip.value->size, (std::vector<int>{6, 5, 3}));
    EXPECT_EQ(mip.value->files[0].level, 0);
}

TEST(WriteVolume, LeavesEqualFilesAlone) {
    const TemporaryFolder folder;
    Baked volume = sample_volume();
    testing::write_sample_volume(folder.path(), volume);
    const auto old_time = fs::file_time_type::clock::now() - std::chrono::hours(48);
    fs::last_write_time(folder / "shape.exr", old_time);
    fs::last_write_time(folder / "shape.bin", old_time);
    volume.parameters = "[noise.shape]\nseed = 8\n";  // in the EXR's metadata, not in bare voxels
    ManifestAsset asset = describe_with_files(volume);
    AtomicFiles files;
    const auto staged = stage_files(volume, asset, folder.path(), files, 2);
    EXPECT_EQ(staged.value, (StagedFiles{WriteResult::written, WriteResult::unchanged}));
    EXPECT_TRUE(files.commit().empty());
    EXPECT_NE(fs::last_write_time(folder / "shape.exr"), old_time);
    EXPECT_EQ(fs::last_write_time(folder / "shape.bin"), old_time);
    EXPECT_EQ(asset.files[1].xxh3, xxh3_hex(read_bytes(folder / "shape.bin")));
}

// A file-size limit and a full disk, in the middle of a file of 2 MiB.
std::string failure_of(const TemporaryFolder& folder) {
    const Baked volume =
        sample_volume({64, 64, 64}, 4, PixelType::half, {FileFormat::bin, FileFormat::exr});
    ManifestAsset asset = describe_with_files(volume);
    AtomicFiles files;
    const auto staged = stage_files(volume, asset, folder.path(), files, 2);
    if (staged.value || staged.diagnostics.size() != 1) return "no failure";
    return staged.diagnostics[0].code + " " + staged.diagnostics[0].message;
}

TEST(WriteVolume, ASizeLimitIsReportedAndNothingStays) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "shape.bin", "old");
    {
        const testing::LargestFile limit(1 << 20);
        EXPECT_EQ(failure_of(folder), fmt::format("E0301 cannot write `{}`: File too large",
                                                  (folder / "shape.bin").string()));
    }
    EXPECT_EQ(read_bytes(folder / "shape.bin"), "old");
    EXPECT_EQ(folder.names(), Names{"shape.bin"});
}

TEST(WriteVolume, AFullDiskIsReportedAndNothingStays) {
    testing::expect_on_small_disk("3m", [](const TemporaryFolder& folder) {
        // The bare voxels fit, the image beside them does not.
        const std::string wanted = fmt::format("E0301 cannot write `{}`: No space left on device",
                                               (folder / "shape.exr").string());
        if (failure_of(folder) != wanted) return 1;
        return folder.names().empty() ? 0 : 2;
    });
}

TEST(WriteVolume, AnInterruptionLeavesNothing) {
    const TemporaryFolder folder;
    const Baked volume =
        sample_volume({256, 256, 64}, 4, PixelType::half, {FileFormat::bin, FileFormat::exr});
    for (const int calls : {1, 5, 18, 25}) {
        ManifestAsset asset = describe_with_files(volume);
        testing::CancelledAt progress("", calls);
        {
            AtomicFiles files;
            const auto staged = stage_files(volume, asset, folder.path(), files, 2, &progress);
            ASSERT_TRUE(staged.value.has_value());
            EXPECT_EQ(staged.value->back(), WriteResult::interrupted) << calls;
        }
        EXPECT_EQ(folder.names(), Names{});
    }
}

TEST(WriteTexels, TellHowFarTheyAreAndStop) {
    const Baked volume = sample_volume({256, 256, 32}, 4, PixelType::half);
    const auto is_written = [&](testing::CancelledAt& told) {
        return write_texels({volume, 0, "", 2, &told}, 0, [](std::string_view) { return true; });
    };
    testing::CancelledAt whole("", 99);
    EXPECT_TRUE(is_written(whole));
    EXPECT_EQ(whole.seen, 16);
    EXPECT_EQ(whole.last, 1);
    testing::CancelledAt part("", 3);
    EXPECT_FALSE(is_written(part));
    EXPECT_EQ(part.seen, 3);
}

TEST(WriteVolume, WantsASurveyedVolume) {
    const TemporaryFolder folder;
    Baked volume = sample_volume();
    volume.levels[0].content_hash.clear();
    ManifestAsset asset = describe_with_files(volume);
    AtomicFiles files;
    const auto staged = stage_files(volume, asset, folder.path(), files, 1);
    EXPECT_EQ(testing::first_code(staged.diagnostics), "E0500");
    EXPECT_EQ(folder.names(), Names{});
}

}  // namespace
}  // namespace skybake
