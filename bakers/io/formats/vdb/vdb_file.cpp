#include "bakers/io/formats/vdb/vdb_file.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <set>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/load_module.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/vdb/vdb_codec.h"
#include "bakers/io/formats/vdb/vdb_source.h"
#include "bakers/io/formats/vdb/vdb_writer.h"
#include "bakers/io/volumes/grid_files.h"

namespace skybake {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t hash_digits = 32;

const LoadedCodec<VdbCodec>& vdb_codec() {
    static const auto loaded = load_codec<VdbCodec>(vdb_module_name, vdb_codec_symbol);
    return loaded;
}

// Returns what this writer cannot write of the volume, in words, or nothing. Asking for it is a bug
// in the program.
std::optional<std::string> contradiction(const Baked& volume, int level_number) {
    if (level_number < 0 || static_cast<std::size_t>(level_number) >= volume.levels.size()) {
        return fmt::format("a volume without level {}", level_number);
    }
    const Level& level = volume.levels[static_cast<std::size_t>(level_number)];
    for (const int size : level.size) {
        if (size < 1) return "a volume without voxels";
    }
    if (volume.channel_names.empty()) return "a volume without channels";
    const std::vector<std::string>& names = volume.grid_names;
    const std::set<std::string> different(names.begin(), names.end());
    if (!names.empty() && (names.size() != volume.channel_names.size() ||
                           different.size() != names.size() || different.contains(""))) {
        return "grids without a name of their own";
    }
    if (volume.pixel_type != PixelType::half && volume.pixel_type != PixelType::float32) {
        return "VDB files hold float or half";
    }
    if (level.content_hash.size() != hash_digits ||
        level.content_hash.find_first_not_of("0123456789abcdef") != std::string::npos) {
        return fmt::format("`{}` is not a content hash", level.content_hash);
    }
    for (const double edge : volume.voxel_size_m) {
        if (!(edge > 0) || !std::isfinite(edge)) return fmt::format("voxels of {} m", edge);
    }
    return std::nullopt;
}

template <class T, class Read>
Outcome<T> read_with_module(const fs::path& path, Read&& read) {
    Outcome<FileInput> opened = FileInput::open(path);  // OpenVDB does not say why it fails
    if (!opened.value) return {{}, std::move(opened.diagnostics)};
    const LoadedCodec<VdbCodec>& loaded = vdb_codec();
    if (loaded.codec != nullptr) return read(*loaded.codec);
    return cannot_read(path, loaded.reason);
}

std::optional<Diagnostic> vdb_obstacle(const fs::path& path) {
    const LoadedCodec<VdbCodec>& loaded = vdb_codec();
    if (loaded.codec != nullptr) return std::nullopt;
    return cannot_write(path, loaded.reason);
}

Outcome<bool> write_vdb_file(const FileContent& content, const fs::path& path) {
    return write_vdb(content.baked, content.level, {{metadata_name, content.metadata}},
                     content.threads, content.progress, path);
}

}  // namespace

Format vdb_format() {
    return {.format = config::FileFormat::vdb,
            .write = write_vdb_file,
            .inspect = inspect_grids,
            .read = read_grid_voxels,
            .compression =
                [](const config::AssetFiles& files) { return to_string(files.vdb_compression); },
            .grids = vdb_grid_names,
            .obstacle = vdb_obstacle};
}

std::vector<std::string> vdb_grid_names(const Baked& volume) {
    if (!volume.grid_names.empty()) return volume.grid_names;
    if (volume.channel_names.size() == 1) return {"density"};
    return volume.channel_names;
}

std::vector<VdbGridChannels> vdb_grids(const Baked& volume) {
    const std::vector<std::string> names = vdb_grid_names(volume);
    std::vector<VdbGridChannels> grids;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name =
            names[i].ends_with(".x") ? names[i].substr(0, names[i].size() - 2) : "";
        const bool is_vector = !name.empty() && i + 2 < names.size() &&
                               names[i + 1] == name + ".y" && names[i + 2] == name + ".z";
        grids.push_back(is_vector ? VdbGridChannels{name, i, 3} : VdbGridChannels{names[i], i, 1});
        if (is_vector) i += 2;
    }
    return grids;
}

Outcome<bool> write_vdb(const Baked& volume, int level, const Attributes& attributes, int threads,
                        Progress* progress, const fs::path& path, std::size_t most_kept_bytes) {
    if (const auto reason = contradiction(volume, level)) {
        return file_error("E0500", path.string(), *reason);
    }
    const LoadedCodec<VdbCodec>& loaded = vdb_codec();
    if (loaded.codec == nullptr) return cannot_write(path, loaded.reason);
    try {
        VdbWriter writer(volume, volume.levels[static_cast<std::size_t>(level)], *loaded.codec,
                         most_kept_bytes, progress, path);
        return writer.write(attributes, threads);
    } catch (const std::exception& error) {
        return cannot_write(path, error.what());
    }
}

Outcome<VdbFile> read_vdb(const fs::path& path) {
    return read_with_module<VdbFile>(path, [&](const VdbCodec& codec) { return codec.read(path); });
}

Outcome<FileVoxels> open_vdb_grid(const fs::path& path, const std::string& grid, VolumePart part,
                                  config::NotFinite not_finite) {
    return read_with_module<FileVoxels>(
        path, [&](const VdbCodec& codec) { return codec.open_grid(path, grid, part, not_finite); });
}

}  // namespace skybake
