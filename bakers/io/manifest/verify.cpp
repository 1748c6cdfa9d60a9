#include "bakers/io/manifest/verify.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "bakers/field/bilinear.h"
#include "bakers/field/make_probe.h"
#include "bakers/io/files/file_input.h"
#include "bakers/io/files/read_file.h"
#include "bakers/io/files/spelling.h"
#include "bakers/io/manifest/examination.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/io/manifest/verify_volume.h"
#include "bakers/math/hash.h"

namespace skybake {
namespace {

void check_texels(Examination& examination, const ManifestAsset& asset, const ManifestFile& file,
                  const ExrImage& image) {
    long not_finite = 0;
    for (const float value : image.pixels.texels) not_finite += std::isfinite(value) ? 0 : 1;
    examination.expect(not_finite == 0, "finite",
                       fmt::format("{} values are NaN or infinite", not_finite));
    examination.expect_equal(xxh3_hex(stored_bytes(image.pixels, file.pixel_type)),
                             asset.content_hash, "content_hash", "the hash of the texels");
}

std::string place_of(const Probe& probe) {
    std::string place;
    for (const auto& [quantity, value] : probe.at) {
        place += fmt::format("{}{} {}", place.empty() ? "" : ", ", quantity, value);
    }
    return place;
}

void check_probe(Examination& examination, const Probe& probe, const Image2<float>& pixels) {
    const auto [u, v] = probe.uv;
    const bool inside = u >= 0 && u <= 1 && v >= 0 && v <= 1;
    const std::string place = place_of(probe);
    if (!examination.expect(inside, "probe",
                            fmt::format("uv ({}, {}) of {} is outside of [0, 1]", u, v, place))) {
        return;
    }
    std::vector<double> found(static_cast<std::size_t>(pixels.channels));
    bilinear(pixels, u, v, found.data());
    check_lookup(examination, place, found, probe.value, probe.tolerance);
}

// As one texture of one slice.
void check_catches_of_table(Examination& examination, const ManifestAsset& asset,
                            const Image2<float>& pixels) {
    std::vector<CaughtProbe> probes;
    for (const Probe& probe : asset.probes) {
        probes.push_back({{{{probe.uv[0], probe.uv[1], 0.5}}}, probe.value, probe.tolerance});
    }
    check_catches(examination, readable_texture(pixels), 2, probes, asset.catches);
}

void check_image(Examination& examination, const ManifestAsset& asset, const ManifestFile& file,
                 const ExrImage& image) {
    const std::vector<int> size = {image.pixels.width, image.pixels.height};
    examination.expect_equal(size, asset.size, "size", "the size");
    examination.expect_equal(image.channel_names, asset.channels, "channels",
                             "the list of channels");
    examination.expect_equal(spell(image.pixel_type), spell(file.pixel_type), "pixel_type",
                             "the pixel type");
    examination.expect_equal(spell(image.compression), spell(asset.compression), "compression",
                             "the compression");
    check_attributes(examination, image.attributes, exr_attributes(asset));
    check_texels(examination, asset, file, image);
    for (const Probe& probe : asset.probes) check_probe(examination, probe, image.pixels);
    check_catches_of_table(examination, asset, image.pixels);
}

void check_table_file(Examination& examination, const std::filesystem::path& path,
                      const ManifestAsset& asset, const ManifestFile& file) {
    const config::Outcome<std::string> bytes = read_file(path);
    if (!examination.expect_read(bytes, "file")) return;
    const config::Outcome<ExrImage> image = decode_exr(*bytes.value, file.path);
    if (!examination.expect_read(image, "format")) return;
    check_image(examination, asset, file, *image.value);
}

void check_further(VerifyReport& report, const ManifestAsset& asset,
                   std::span<const AssetCheck> further) {
    Examination examination(report, asset.files.empty() ? asset.name : asset.files.front().path);
    for (const AssetCheck& check : further) {
        int checks = 0;
        for (const std::string& message : check.run(asset, checks)) {
            examination.fail(check.name, message);
        }
        examination.count(checks);
    }
}

void check_file(VerifyReport& report, const std::filesystem::path& folder,
                const ManifestAsset& asset, const ManifestFile& file) {
    ++report.files;
    Examination examination(report, file.path);
    const std::filesystem::path path = folder / file.path;
    const config::Outcome<FileFingerprint> found = fingerprint(path);
    if (!examination.expect_read(found, "file")) return;
    examination.expect_equal(found.value->bytes, file.bytes, "bytes", "the number of bytes");
    examination.expect_equal(found.value->xxh3, file.xxh3, "xxh3", "the hash of the file");
    if (file.format == "json") return;  // a text, told by its hash
    if (asset.is_volume()) {
        check_volume_file(examination, path, asset, file);
    } else {
        check_table_file(examination, path, asset, file);
    }
}

// The entries and the rest are as they were written: hand edits show nowhere else.
void check_manifest(VerifyReport& report, const std::string& name, const Manifest& manifest) {
    Examination examination(report, name);
    const std::size_t hashes = manifest.assets.size() + 1;
    examination.count(static_cast<int>(hashes));
    for (const std::string& alteration : manifest.alterations) {
        examination.fail("hash", alteration);
    }
}

}  // namespace

config::Outcome<VerifyReport> verify_bake(const std::filesystem::path& path,
                                          std::span<const AssetCheck> further,
                                          std::span<const FolderCheck> of_folder) {
    const ManifestPlace place = manifest_place(path);
    config::Outcome<Manifest> manifest = read_manifest_file(place.file);
    if (!manifest.value) return {{}, std::move(manifest.diagnostics)};
    VerifyReport report;
    check_manifest(report, place.file.filename().string(), *manifest.value);
    for (const ManifestAsset& asset : manifest.value->assets) {
        for (const ManifestFile& file : asset.files) {
            check_file(report, place.folder, asset, file);
        }
        check_further(report, asset, further);
    }
    for (const FolderCheck& check : of_folder) {
        for (VerifyFailure& failure : check.run(*manifest.value, place.folder, report.checks)) {
            report.failures.push_back(std::move(failure));
        }
    }
    return {std::move(report), std::move(manifest.diagnostics)};
}

}  // namespace skybake
