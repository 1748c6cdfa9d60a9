#include "bakers/io/formats/write_volume.h"

#include <fmt/format.h>

#include <utility>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/file_input.h"
#include "bakers/io/files/file_names.h"
#include "bakers/io/files/file_output.h"
#include "bakers/io/files/spelling.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/io/formats/bin/bin_volume.h"
#include "bakers/io/formats/exr/exr_volume.h"
#include "bakers/io/formats/vdb/vdb_volume.h"
#include "bakers/io/manifest/metadata.h"

namespace skybake {
namespace {

using config::VolumeFormat;

ManifestFile make_file(const BakedVolume& volume, VolumeFormat format, int level) {
    ManifestFile file;
    file.path = volume_file_name(volume.name, format, level);
    file.format = spell(format);
    file.pixel_type = volume.pixel_type;
    file.level = level;
    file.compression = "none";
    if (format == VolumeFormat::vdb) {
        file.compression = spell(volume.vdb_compression);
        file.grids = vdb_grid_names(volume);
    }
    if (format == VolumeFormat::exr) {
        file.compression = spell(volume.compression);
        file.layout = volume_layout(volume.levels[static_cast<std::size_t>(level)].size,
                                    volume.layout, volume.columns);
        file.layout->flipped = volume.flipped;
    }
    return file;
}

config::Outcome<bool> write_companion(const CompanionFile& companion,
                                      const std::filesystem::path& path) {
    FileOutput output(path);
    output.write(companion.text);
    if (!output.finish()) return {{}, {output.diagnostic()}};
    return {true, {}};
}

// Stages one file and takes down its length and hash.
config::Outcome<WriteResult> stage_file(const BakedVolume& volume, const ManifestAsset& asset,
                                        ManifestFile& file, const std::filesystem::path& folder,
                                        AtomicFiles& files, int threads, Progress* progress) {
    const auto write = [&](const std::filesystem::path& temporary) {
        config::Outcome<bool> written =
            write_volume_file(volume, asset, file, threads, progress, temporary);
        if (!written.value || !*written.value) return written;
        config::Outcome<FileFingerprint> found = fingerprint(temporary);
        if (!found.value) return config::Outcome<bool>{{}, std::move(found.diagnostics)};
        file.bytes = found.value->bytes;
        file.xxh3 = found.value->xxh3;
        return written;
    };
    return files.stage(folder / file.path, write, progress);
}

}  // namespace

config::Outcome<bool> write_volume_file(const BakedVolume& volume, const ManifestAsset& asset,
                                        const ManifestFile& file, int threads, Progress* progress,
                                        const std::filesystem::path& temporary) {
    if (file.format == spell(VolumeFormat::bin)) {
        return write_bin_volume(volume, file.level, threads, progress, temporary);
    }
    if (volume.companion && file.format == volume.companion->format) {
        return write_companion(*volume.companion, temporary);
    }
    const Attributes attributes = volume_attributes(asset, file);
    if (file.format == spell(VolumeFormat::vdb)) {
        return write_vdb(volume, file.level, attributes, threads, progress, temporary);
    }
    return write_exr_volume(volume, file.level, attributes, threads, progress, temporary);
}

ManifestAsset describe_with_files(const BakedVolume& volume) {
    ManifestAsset asset = describe(volume);
    for (const VolumeFormat format : volume.formats) {
        for (std::size_t level = 0; level < volume.levels.size(); ++level) {
            asset.files.push_back(make_file(volume, format, static_cast<int>(level)));
        }
    }
    if (volume.companion) {
        ManifestFile file;
        file.path = companion_file_name(volume.name, volume.companion->format);
        file.format = volume.companion->format;
        file.pixel_type = volume.pixel_type;
        file.compression = "none";
        asset.files.push_back(std::move(file));
    }
    return asset;
}

config::Outcome<StagedVolume> stage_volume(const BakedVolume& volume, ManifestAsset& asset,
                                           const std::filesystem::path& folder, AtomicFiles& files,
                                           int threads, Progress* progress) {
    const Stopwatch stopwatch;
    config::Outcome<StagedVolume> outcome;
    StagedVolume staged;
    for (const VolumeLevel& level : volume.levels) {
        if (!level.content_hash.empty()) continue;
        outcome.diagnostics.push_back(
            file_error("E0500", "", fmt::format("`{}` has not been surveyed", volume.name)));
        return outcome;
    }
    for (ManifestFile& file : asset.files) {
        auto result = stage_file(volume, asset, file, folder, files, threads, progress);
        for (config::Diagnostic& diagnostic : result.diagnostics) {
            outcome.diagnostics.push_back(std::move(diagnostic));
        }
        if (!result.value) return outcome;
        staged.push_back(*result.value);
        if (*result.value == WriteResult::interrupted) break;
    }
    asset.timing.write_s += stopwatch.seconds();
    outcome.value = std::move(staged);
    return outcome;
}

}  // namespace skybake
