#include "bakers/io/manifest/asset_files.h"

#include <fmt/format.h>

#include <utility>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/io/targets/sidecar.h"

namespace skybake {
namespace {

ManifestFile make_file(const Baked& baked, const Format& format, int level) {
    const config::FormatFacts& facts = config::facts_of(format.format);
    ManifestFile file;
    file.path = file_name(baked.name, baked, format.format, level);
    file.format = facts.name;
    file.pixel_type = baked.pixel_type;
    file.level = level;
    file.compression = format.compression ? format.compression(baked) : "none";
    if (facts.has_all_levels) {
        file.levels = static_cast<int>(baked.levels.size());
        file.texture = texture_parts(baked);
    }
    if (format.grids) file.grids = format.grids(baked);
    if (facts.is_image) {
        file.layout = sheet_grid(baked.levels[static_cast<std::size_t>(level)].size, baked);
    }
    return file;
}

// Returns a file of the asset that has no texels.
ManifestFile make_text_file(const Baked& baked, std::string path, std::string_view format) {
    ManifestFile file;
    file.path = std::move(path);
    file.format = format;
    file.pixel_type = baked.pixel_type;
    file.compression = "none";
    return file;
}

Outcome<bool> write_text(std::string_view text, const std::filesystem::path& path) {
    FileOutput output(path);
    output.write(text);
    return output.finished(true);
}

// Stages one file and records its length and hash.
Outcome<WriteResult> stage_file(const Baked& baked, const ManifestAsset& asset, ManifestFile& file,
                                const std::filesystem::path& folder, AtomicFiles& files,
                                int threads, Progress* progress) {
    const auto write = [&](const std::filesystem::path& temporary) {
        Outcome<bool> written = write_asset_file(baked, asset, file, threads, progress, temporary);
        if (!written.value || !*written.value) return written;
        Outcome<FileFingerprint> found = fingerprint(temporary);
        if (!found.value) return Outcome<bool>{{}, std::move(found.diagnostics)};
        file.bytes = found.value->bytes;
        file.xxh3 = found.value->xxh3;
        return written;
    };
    return files.stage(folder / file.path, write, progress);
}

}  // namespace

Outcome<bool> write_asset_file(const Baked& baked, const ManifestAsset& asset,
                               const ManifestFile& file, int threads, Progress* progress,
                               const std::filesystem::path& path) {
    if (baked.companion && file.format == baked.companion->format) {
        return write_text(baked.companion->text, path);
    }
    if (file.format == sidecar_format) {
        return write_text(sidecar_text(baked, asset, file.path), path);
    }
    const Format& format = *find_format(file.format);
    FileContent content{baked, file.level, {}, threads, progress};
    if (format.has_metadata) content.metadata = file_entry_json(asset, file);
    return format.write(content, path);
}

ManifestAsset describe_with_files(const Baked& baked) {
    ManifestAsset asset = describe(baked);
    for (const config::FileFormat format : baked.formats) {
        const int files = config::files_of_levels(format, static_cast<int>(baked.levels.size()));
        for (int level = 0; level < files; ++level) {
            asset.files.push_back(make_file(baked, format_of(format), level));
        }
    }
    if (baked.companion) {
        const std::string& format = baked.companion->format;
        asset.files.push_back(
            make_text_file(baked, companion_file_name(baked.name, format), format));
    }
    for (std::string& name : sidecars_of(baked)) {
        asset.files.push_back(make_text_file(baked, std::move(name), sidecar_format));
    }
    return asset;
}

Outcome<StagedFiles> stage_files(const Baked& baked, ManifestAsset& asset,
                                 const std::filesystem::path& folder, AtomicFiles& files,
                                 int threads, Progress* progress) {
    const Stopwatch stopwatch;
    Outcome<StagedFiles> outcome;
    StagedFiles staged;
    for (const Level& level : baked.levels) {
        if (!level.content_hash.empty()) continue;
        outcome.diagnostics.push_back(
            file_error("E0500", "", fmt::format("`{}` has not been surveyed", baked.name)));
        return outcome;
    }
    for (ManifestFile& file : asset.files) {
        auto result = stage_file(baked, asset, file, folder, files, threads, progress);
        for (Diagnostic& diagnostic : result.diagnostics) {
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

Outcome<bool> read_asset_file(const std::filesystem::path& path, const ManifestAsset& asset,
                              const ManifestFile& file, int level, const VoxelVisitor& visit) {
    const FileShape shape = {asset.levels[static_cast<std::size_t>(file.level)].size,
                             asset.channels.size(),
                             file.pixel_type,
                             file.layout.value_or(SheetGrid{}),
                             file.levels,
                             file.texture};
    const Format& format = *find_format(file.format);
    if (format.read == nullptr) {
        return file_error("E0304", path.string(),
                          fmt::format("`{}` has no voxels of its own", path.string()));
    }
    Outcome<FileInput> input = FileInput::open(path);
    if (!input.value) return {{}, std::move(input.diagnostics)};
    return format.read(*input.value, shape, level, visit);
}

}  // namespace skybake
