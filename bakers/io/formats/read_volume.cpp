#include "bakers/io/formats/read_volume.h"

#include <fmt/format.h>

#include <utility>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/spelling.h"
#include "bakers/io/formats/bin/bin_volume.h"
#include "bakers/io/formats/exr/exr_rows.h"
#include "bakers/io/formats/vdb/vdb_volume.h"

namespace skybake {
namespace {

using config::Outcome;
using config::VolumeFormat;
namespace fs = std::filesystem;

Outcome<bool> other_size(const fs::path& path) {
    return {
        {},
        {file_error("E0304", path.string(),
                    fmt::format("`{}` is not of the size that its manifest says", path.string()))}};
}

Outcome<bool> read_exr(const fs::path& path, const ManifestAsset& asset, const ManifestFile& file,
                       const VoxelVisitor& visit) {
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    Outcome<ExrRows> image = ExrRows::open(path);
    if (!image.value) return {{}, std::move(image.diagnostics)};
    const std::array<std::int64_t, 2> size = {image.value->width(), image.value->height()};
    const bool fits = file.layout && size == image_size(level.size, *file.layout) &&
                      image.value->channel_names() == asset.channels;
    if (!fits) return other_size(path);
    return read_exr_volume(*image.value, level.size, *file.layout, visit);
}

Outcome<bool> read_vdb_file(const fs::path& path, const ManifestAsset& asset,
                            const ManifestFile& file, const VoxelVisitor& visit) {
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    bool fits = true;
    Outcome<bool> read = read_vdb_voxels(path, [&](const VdbSlab& slab) {
        const std::int64_t slice = std::int64_t{slab.size[0]} * slab.size[1];
        const auto count = static_cast<std::size_t>(slab.depth * slice) * asset.channels.size();
        fits = slab.size == level.size && slab.voxels.size() == count;
        return fits && visit(slab.first_z * slice, slab.depth * slice, slab.voxels.data());
    });
    return fits ? std::move(read) : other_size(path);
}

}  // namespace

Outcome<bool> read_volume(const fs::path& path, const ManifestAsset& asset,
                          const ManifestFile& file, const VoxelVisitor& visit) {
    if (file.format == spell(VolumeFormat::exr)) return read_exr(path, asset, file, visit);
    if (file.format == spell(VolumeFormat::vdb)) return read_vdb_file(path, asset, file, visit);
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    return read_bin_volume(path, level.size, static_cast<int>(asset.channels.size()),
                           file.pixel_type, visit);
}

}  // namespace skybake
