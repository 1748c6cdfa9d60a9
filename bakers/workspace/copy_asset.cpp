#include "bakers/workspace/copy_asset.h"

#include <fmt/format.h>

#include "bakers/io/files/file_io.h"
#include "bakers/math/hash.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// Copies a file and hashes the copied bytes, because the file may change between two reads.
Outcome<bool> copy(const fs::path& from, const ManifestFile& expected, const fs::path& to,
                   const Progress& progress) {
    Outcome<FileInput> input = FileInput::open(from);
    if (!input.value) return {{}, std::move(input.diagnostics)};
    FileOutput output(to);
    std::string piece(std::size_t{1} << 20, '\0');
    std::uint64_t position = 0;
    Hasher hasher;
    while (output.error() == 0) {
        if (progress.cancelled()) return {false, {}};
        const auto count = input.value->read(position, piece.data(), piece.size());
        if (!count) return input.value->diagnostic();
        if (*count == 0) break;
        const auto bytes = std::string_view(piece).substr(0, *count);
        hasher.update(bytes);
        output.write(bytes);
        position += *count;
    }
    if (!output.finish()) return output.diagnostic();
    if (hasher.hex() == expected.xxh3) return {true, {}};
    return file_error("E0304", from.string(),
                      fmt::format("`{}` is not what its manifest says", from.string()));
}

}  // namespace

Outcome<std::vector<WriteResult>> AssetSource::stage(const ReadyAsset& asset,
                                                     const fs::path& folder, AtomicFiles& files,
                                                     const Progress& progress) {
    return stage_copies(asset, folder, files, progress);
}

std::optional<ReadyAsset> asset_in_folder(const fs::path& folder, const std::string& key) {
    auto manifest = read_manifest(folder);
    if (!manifest.value || !manifest.value->alterations.empty()) return std::nullopt;
    for (ManifestAsset& asset : manifest.value->assets) {
        if (asset.key == key) return ReadyAsset{folder, std::move(asset)};
    }
    return std::nullopt;
}

std::optional<ReadyAsset> BakedFolders::find(const std::string& key) {
    for (const fs::path& folder : folders_) {
        if (auto found = asset_in_folder(folder, key)) return found;
    }
    return std::nullopt;
}

Outcome<std::vector<WriteResult>> stage_each(const ManifestAsset& entry, const fs::path& folder,
                                             AtomicFiles& files, const Progress& progress,
                                             const AssetFileWriter& write) {
    const std::size_t before = files.size();
    std::vector<WriteResult> results;
    for (const ManifestFile& file : entry.files) {
        const auto write_file = [&](const fs::path& temporary) { return write(file, temporary); };
        const Outcome<WriteResult> staged = files.stage(folder / file.path, write_file, &progress);
        if (!staged.value) {
            files.shrink(before);
            return {{}, staged.diagnostics};
        }
        results.push_back(*staged.value);
        if (results.back() == WriteResult::interrupted) return {std::move(results), {}};
    }
    return {std::move(results), {}};
}

Outcome<std::vector<WriteResult>> stage_copies(const ReadyAsset& asset, const fs::path& folder,
                                               AtomicFiles& files, const Progress& progress) {
    const auto write = [&](const ManifestFile& file, const fs::path& temporary) {
        return copy(asset.folder / file.path, file, temporary, progress);
    };
    return stage_each(asset.entry, folder, files, progress, write);
}

}  // namespace skybake
