#include "bakers/io/manifest/verify.h"

#include "tests/io/files.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using testing::Checks;
using testing::failed_checks;
using testing::save_manifest;

// Rewrites an image of the bake, and byte count and hash with it, so that only what lies deeper
// fails.
void rewrite(const fs::path& folder, Manifest& manifest,
             const std::function<void(ExrImage&)>& change) {
    ExrImage image = read_exr(folder / manifest.assets[0].files[0].path);
    change(image);
    testing::replace_file(folder, manifest, 0, encode_exr(image));
}

TEST(Verify, PassesWhatWasBaked) {
    const TemporaryFolder folder;
    testing::write_sample_bake(folder.path(), {"transmittance", "second"});
    const auto report = verify_bake(folder.path());
    ASSERT_TRUE(report.value.has_value());
    EXPECT_TRUE(report.value->failures.empty());
    EXPECT_EQ(report.value->files, 2);
    EXPECT_GT(report.value->checks, 2 * 40);
}

TEST(Verify, ReportsEveryFailure) {
    const TemporaryFolder folder;
    testing::write_sample_bake(folder.path(), {"transmittance", "second"});
    fs::remove(folder / "transmittance.exr");
    testing::write_bytes(folder / "second.exr", "garbage");
    EXPECT_EQ(failed_checks(folder.path()), (Checks{"file", "bytes", "xxh3", "format"}));
}

TEST(Verify, FindsAFlippedBit) {
    const TemporaryFolder folder;
    testing::write_sample_bake(folder.path(), {"transmittance"});
    std::string bytes = testing::read_bytes(folder / "transmittance.exr");
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    testing::write_bytes(folder / "transmittance.exr", bytes);
    const Checks failed = failed_checks(folder.path());
    EXPECT_EQ(failed.count("xxh3"), 1u);
    EXPECT_EQ(failed.count("bytes"), 0u);
}

TEST(Verify, FindsRowsUpsideDown) {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_bake(folder.path(), {"transmittance"});
    rewrite(folder.path(), manifest, [](ExrImage& image) {
        const Image2<float> old = image.pixels;
        for (int y = 0; y < old.height; ++y) {
            std::copy(old.texel(0, y), old.texel(0, y) + old.width * old.channels,
                      image.pixels.texel(0, old.height - 1 - y));
        }
    });
    const Checks failed = failed_checks(folder.path());
    EXPECT_EQ(failed.count("content_hash"), 1u);
    EXPECT_GT(failed.count("probe"), 8u);
    EXPECT_EQ(failed.count("xxh3"), 0u);
}

TEST(Verify, FindsChangedAndMissingMetadata) {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_bake(folder.path(), {"transmittance"});
    rewrite(folder.path(), manifest, [](ExrImage& image) {
        std::string& entry = image.attributes[0].second;
        entry.replace(entry.find("transmittance"), 5, "other");
    });
    EXPECT_EQ(failed_checks(folder.path()), Checks{"metadata"});
    rewrite(folder.path(), manifest, [](ExrImage& image) { image.attributes.clear(); });
    EXPECT_EQ(failed_checks(folder.path()), Checks{"metadata"});
}

TEST(Verify, ComparesSizeChannelsAndType) {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_bake(folder.path(), {"transmittance"});
    ManifestAsset& asset = manifest.assets[0];
    asset.size = {8, 16};
    asset.levels[0].size = {8, 16, 1};
    asset.files[0].compression = "piz";
    asset.levels[0].probes.clear();
    asset.levels[0].catches.clear();
    save_manifest(folder.path(), manifest);
    EXPECT_EQ(failed_checks(folder.path()), (Checks{"size", "compression", "metadata", "voxels"}));
}

TEST(Verify, ChecksEachProbe) {
    const TemporaryFolder folder;
    Manifest manifest = testing::write_sample_bake(folder.path(), {"transmittance"});
    std::vector<Probe>& probes = manifest.assets[0].levels[0].probes;
    probes[1].value[2] += 1e-6;
    probes[2].uvw[0] = 1.001;
    probes[3].tolerance.pop_back();
    save_manifest(folder.path(), manifest);
    EXPECT_EQ(failed_checks(folder.path()),
              (Checks{"metadata", "probe", "probe", "probe", "probe"}));
}

TEST(Verify, RunsFurtherChecks) {
    const TemporaryFolder folder;
    testing::write_sample_bake(folder.path(), {"transmittance"});
    const AssetCheck check{"mapping", [](const ManifestAsset&, int& checks) {
                               checks += 3;
                               return std::vector<std::string>{"one", "two"};
                           }};
    EXPECT_EQ(failed_checks(folder.path(), {&check, 1}), (Checks{"mapping", "mapping"}));
    EXPECT_EQ(verify_bake(folder.path(), {&check, 1}).value->checks,
              verify_bake(folder.path()).value->checks + 3);
}

TEST(Verify, NeedsAManifest) {
    const TemporaryFolder folder;
    EXPECT_EQ(testing::first_code(verify_bake(folder.path()).diagnostics), "E0300");
    testing::write_bytes(folder / "manifest.json", "not JSON");
    EXPECT_EQ(testing::first_code(verify_bake(folder.path()).diagnostics), "E0304");
}

}  // namespace
}  // namespace skybake
