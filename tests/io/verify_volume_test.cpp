
#include "bakers/io/manifest/verify.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

using config::FileFormat;
using testing::Checks;
using testing::failed_checks;
using testing::replace_file;
using testing::sample_volume;
using testing::save_manifest;

TEST(VerifyVolume, AcceptsWhatWasWritten) {
    for (const auto layout : {config::SheetLayout::stack, config::SheetLayout::atlas}) {
        for (const int channels : {1, 3, 4}) {
            const TemporaryFolder folder;
            Baked volume = sample_volume({13, 6, 7}, channels, PixelType::half,
                                         {FileFormat::exr, FileFormat::bin}, 3);
            volume.layout = layout;
            volume.columns = 3;
            testing::write_sample_volume(folder.path(), volume);
            EXPECT_EQ(failed_checks(folder.path()), Checks{});
            const auto report = verify_bake(folder.path());
            EXPECT_EQ(report.value->files, 6);
            EXPECT_GT(report.value->checks, 6 * 16);
            EXPECT_EQ(verify_bake(folder / "manifest.json").value->checks, report.value->checks);
        }
    }
}

// The containers of runtimes, and what verification says of one whose texels are turned over.
TEST(VerifyVolume, ReadsEveryContainer) {
    const TemporaryFolder folder;
    const std::vector<FileFormat> formats = {FileFormat::ktx2, FileFormat::nvdb, FileFormat::vol,
                                             FileFormat::npy,  FileFormat::dds,  FileFormat::vdb,
                                             FileFormat::usda};
    const Baked volume = sample_volume({13, 6, 7}, 3, PixelType::half, formats);
    Manifest manifest = testing::write_sample_volume(folder.path(), volume);
    EXPECT_EQ(failed_checks(folder.path()), Checks{});
    Baked turned = volume;
    turned.levels[0].voxels = std::make_shared<testing::FunctionVoxels>(
        [](int x, int y, int z, int c) { return testing::sample_voxel(12 - x, y, z, c); });
    for (std::size_t i = 0; i + 2 < formats.size(); ++i) {
        ManifestAsset& asset = manifest.assets[0];
        const auto path = folder / "turned";
        testing::write_bytes(path, "");
        ASSERT_EQ(write_asset_file(turned, asset, asset.files[i], 1, nullptr, path).value, true);
        replace_file(folder.path(), manifest, i, testing::read_bytes(path));
        EXPECT_TRUE(failed_checks(folder.path()).contains("content_hash")) << i;
    }
}

TEST(VerifyVolume, AcceptsEachPixelTypeOfBareVoxels) {
    for (const PixelType type :
         {PixelType::float32, PixelType::half, PixelType::unorm8, PixelType::unorm16}) {
        const TemporaryFolder folder;
        testing::write_sample_volume(folder.path(),
                                     sample_volume({64, 96, 80}, 4, type, {FileFormat::bin}));
        EXPECT_EQ(failed_checks(folder.path()), Checks{});
    }
}

TEST(VerifyVolume, AcceptsOpenVdb) {
    for (const int channels : {1, 4}) {
        const TemporaryFolder folder;
        testing::write_sample_volume(
            folder.path(),
            sample_volume({17, 9, 21}, channels, PixelType::half, {FileFormat::vdb}, 2));
        EXPECT_EQ(failed_checks(folder.path()), Checks{});
    }
}

TEST(VerifyVolume, AcceptsSparseOpenVdbWithGridsOfOtherNames) {
    const TemporaryFolder folder;
    Baked volume =
        sample_volume({17, 9, 21}, 1, PixelType::half, {FileFormat::exr, FileFormat::vdb}, 2);
    volume.sparse = true;
    volume.grid_names = {"extinction"};
    Manifest manifest = testing::write_sample_volume(folder.path(), volume);
    EXPECT_EQ(manifest.assets[0].files[2].grids, volume.grid_names);
    EXPECT_EQ(failed_checks(folder.path()), Checks{});
    manifest.assets[0].files[2].grids = {"density"};
    save_manifest(folder.path(), manifest);
    EXPECT_EQ(failed_checks(folder.path()), (Checks{"channels", "metadata"}));
}

TEST(VerifyVolume, FindsGridsInAnotherOrder) {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_volume(
        folder.path(), sample_volume({8, 8, 8}, 3, PixelType::half, {FileFormat::vdb}));
    std::swap(manifest.assets[0].files[0].grids[0], manifest.assets[0].files[0].grids[2]);
    save_manifest(folder.path(), manifest);
    EXPECT_EQ(failed_checks(folder.path()), (Checks{"channels", "metadata"}));
}

TEST(VerifyVolume, FindsSlicesInAnotherOrder) {
    const TemporaryFolder folder;
    const Baked volume =
        sample_volume({12, 10, 7}, 3, PixelType::half, {FileFormat::exr, FileFormat::bin});
    Manifest manifest = testing::write_sample_volume(folder.path(), volume);
    ExrImage image = read_exr(folder / "shape.exr");
    const Image2<float> old = image.pixels;
    for (int z = 0; z < 7; ++z) {
        std::copy_n(old.texel(0, 10 * z), 12 * 10 * 3, image.pixels.texel(0, 10 * (6 - z)));
    }
    replace_file(folder.path(), manifest, 0, encode_exr(image));
    const Checks failed = failed_checks(folder.path());
    EXPECT_EQ(failed.count("content_hash"), 1U);
    EXPECT_GT(failed.count("probe"), 8U);
    EXPECT_EQ(failed.count("statistics"), 0U);
    EXPECT_EQ(failed.count("metadata"), 0U);
}

TEST(VerifyVolume, FindsAChangedVoxel) {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_volume(
        folder.path(), sample_volume({12, 10, 7}, 1, PixelType::half, {FileFormat::bin}));
    std::string bytes = testing::read_bytes(folder / "shape.bin");
    bytes[1001] = '\x44';  // the upper byte of voxel 500, now above 4
    replace_file(folder.path(), manifest, 0, bytes);
    const Checks failed = failed_checks(folder.path());
    EXPECT_EQ(failed.count("content_hash"), 1U);
    EXPECT_EQ(failed.count("statistics"), 1U);
    bytes[1001] = '\x7e';  // not a number
    replace_file(folder.path(), manifest, 0, bytes);
    EXPECT_EQ(failed_checks(folder.path()).count("finite"), 1U);
    replace_file(folder.path(), manifest, 0, bytes.substr(2));
    EXPECT_EQ(failed_checks(folder.path()), Checks{"voxels"});
}

TEST(VerifyVolume, ComparesWhatTheManifestSays) {
    const TemporaryFolder folder;
    const Baked volume = sample_volume({12, 10, 7}, 3, PixelType::half, {FileFormat::exr});
    Manifest manifest = testing::write_sample_volume(folder.path(), volume);
    manifest.assets[0].files[0].layout = SheetGrid{config::SheetLayout::atlas, 2, 4};
    save_manifest(folder.path(), manifest);
    EXPECT_EQ(failed_checks(folder.path()), (Checks{"metadata", "size", "voxels"}));
    manifest = testing::write_sample_volume(folder.path(), volume);
    manifest.assets[0].levels[0].probes[3].value[1] += 1e-6;
    manifest.assets[0].levels[0].probes[4].tolerance.pop_back();
    manifest.assets[0].files[0].compression = "piz";
    save_manifest(folder.path(), manifest);
    EXPECT_EQ(failed_checks(folder.path()), (Checks{"compression", "metadata", "probe", "probe"}));
    manifest = testing::write_sample_volume(folder.path(), volume);
    manifest.assets[0].levels[0].statistics[2].max += 1e-3;
    manifest.assets[0].seam_error = 0.5;
    save_manifest(folder.path(), manifest);
    EXPECT_EQ(failed_checks(folder.path()), (Checks{"metadata", "statistics"}));
}

TEST(VerifyVolume, ReportsMissingAndDamagedFiles) {
    const TemporaryFolder folder;
    testing::write_sample_volume(folder.path(), sample_volume({12, 10, 7}, 3, PixelType::half,
                                                              {FileFormat::exr, FileFormat::bin}));
    std::filesystem::remove(folder / "shape.bin");
    const auto whole = std::filesystem::file_size(folder / "shape.exr");
    std::filesystem::resize_file(folder / "shape.exr", whole - 500);
    EXPECT_EQ(failed_checks(folder.path()), (Checks{"bytes", "file", "voxels", "xxh3"}));
}

}  // namespace
}  // namespace skybake
