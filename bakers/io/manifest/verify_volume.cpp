#include "bakers/io/manifest/verify_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bakers/field/pixel_type.h"
#include "bakers/field/voxel_bytes.h"
#include "bakers/field/wrong_lookups.h"
#include "bakers/io/files/spelling.h"
#include "bakers/io/formats/bin/bin_volume.h"
#include "bakers/io/formats/exr/exr_volume.h"
#include "bakers/io/formats/vdb/vdb_volume.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/math/hash.h"

namespace skybake {
namespace {

std::int64_t voxel_index(const std::array<int, 3>& size, const std::array<int, 3>& voxel) {
    return (std::int64_t{voxel[2]} * size[1] + voxel[1]) * size[0] + voxel[0];
}

std::vector<ProbeLookup> lookups_of(const VolumeProbe& probe) {
    if (!probe.blend) return {{probe.uvw}};
    return {{probe.uvw, 1 - probe.blend->share}, {probe.blend->uvw, probe.blend->share}};
}

// Goes over a file's voxels once, in order, and keeps what the checks want to know.
class VoxelCheck {
  public:
    VoxelCheck(const ManifestLevel& level, const TextureUse& use, std::size_t channels,
               config::PixelType type)
        : level_(level),
          use_(use),
          channels_(channels),
          type_(type),
          min_(channels, std::numeric_limits<double>::infinity()),
          max_(channels, -std::numeric_limits<double>::infinity()) {
        for (const VolumeProbe& probe : level.probes) {
            for (const ProbeLookup& lookup : lookups_of(probe)) {
                want(use, lookup.uvw);
                for (const WrongLookup& wrong : wrong_lookups(use, 3)) {
                    want(wrong.use, wrong.place(lookup.uvw));
                }
            }
        }
        std::sort(wanted_.begin(), wanted_.end());
        wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
        kept_.reserve(wanted_.size() * channels);
    }

    void add(std::int64_t first, std::int64_t count, const float* values) {
        const auto total = static_cast<std::size_t>(count) * channels_;
        for (std::size_t c = 0; c < channels_; ++c) {
            for (std::size_t i = c; i < total; i += channels_) {
                const double value = values[i];
                not_finite_ += std::isfinite(value) ? 0 : 1;
                min_[c] = std::min(min_[c], value);
                max_[c] = std::max(max_[c], value);
            }
        }
        bytes_.resize(total * static_cast<std::size_t>(bytes_per_value(type_)));
        store_values(values, total, type_, bytes_.data());
        hasher_.update(bytes_);
        // Voxels come in order, and so do the wanted ones.
        while (next_ < wanted_.size() && wanted_[next_] < first + count) {
            const auto at = static_cast<std::size_t>(wanted_[next_++] - first) * channels_;
            kept_.insert(kept_.end(), values + at, values + at + channels_);
        }
    }

    void report(Examination& examination, const ManifestAsset& asset) const {
        examination.expect(not_finite_ == 0, "finite",
                           fmt::format("{} values are NaN or infinite", not_finite_));
        examination.expect_equal(hasher_.hex(), level_.content_hash, "content_hash",
                                 "the hash of the voxels");
        for (std::size_t c = 0; c < channels_; ++c) {
            const std::string name = fmt::format("of channel {}", asset.channels[c]);
            examination.expect_equal(min_[c], level_.statistics[c].min, "statistics",
                                     fmt::format("the smallest value {}", name));
            examination.expect_equal(max_[c], level_.statistics[c].max, "statistics",
                                     fmt::format("the largest value {}", name));
        }
        const ReadableTexture texture = kept_texture();
        std::vector<CaughtProbe> probes;
        for (const VolumeProbe& probe : level_.probes) {
            probes.push_back({lookups_of(probe), probe.value, probe.tolerance});
            check_lookup(examination, fmt::format("uvw ({})", fmt::join(probe.uvw, ", ")),
                         look_up(texture, probes.back().lookups), probe.value, probe.tolerance);
        }
        check_catches(examination, texture, 3, probes, level_.catches);
    }

  private:
    void want(const TextureUse& use, const std::array<double, 3>& uvw) {
        for (const VoxelTap& tap : lookup_taps(use, uvw)) {
            wanted_.push_back(voxel_index(level_.size, tap.voxel));
        }
    }

    // What was kept of the volume: all that probes look at.
    ReadableTexture kept_texture() const {
        const auto read = [this](const std::array<VoxelTap, 8>& taps, float* values) {
            for (const VoxelTap& tap : taps) {
                const std::int64_t index = voxel_index(level_.size, tap.voxel);
                const auto found = std::lower_bound(wanted_.begin(), wanted_.end(), index);
                const auto at = static_cast<std::size_t>(found - wanted_.begin()) * channels_;
                values = std::copy_n(&kept_[at], channels_, values);
            }
        };
        return {use_, channels_, read};
    }

    const ManifestLevel& level_;
    const TextureUse use_;
    const std::size_t channels_;
    const config::PixelType type_;
    std::vector<double> min_;
    std::vector<double> max_;
    long not_finite_ = 0;
    Hasher hasher_;
    std::string bytes_;
    std::vector<std::int64_t> wanted_;  // voxels that probes look at, sorted
    std::vector<float> kept_;           // their values, in that order
    std::size_t next_ = 0;
};

void check_exr(Examination& examination, const std::filesystem::path& path,
               const ManifestAsset& asset, const ManifestFile& file, VoxelCheck& voxels) {
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    config::Outcome<ExrRows> image = ExrRows::open(path);
    if (!examination.expect_read(image, "format")) return;
    const SliceLayout& layout = *file.layout;
    examination.expect_equal(std::string(spell(image.value->pixel_type())),
                             std::string(spell(file.pixel_type)), "pixel_type", "the pixel type");
    examination.expect_equal(std::string(spell(image.value->compression())), file.compression,
                             "compression", "the compression");
    check_attributes(examination, image.value->attributes(), volume_attributes(asset, file));
    const bool channels = examination.expect_equal(image.value->channel_names(), asset.channels,
                                                   "channels", "the list of channels");
    const std::array<std::int64_t, 2> size = {image.value->width(), image.value->height()};
    const bool fits = examination.expect_equal(size, image_size(level.size, layout), "size",
                                               "the size of the image");
    const std::int64_t cells = std::int64_t{layout.columns} * layout.rows;
    const bool cells_fit = examination.expect(
        cells >= level.size[2] && cells - layout.columns < level.size[2], "layout",
        fmt::format("{} x {} cells are not those of {} slices", layout.columns, layout.rows,
                    level.size[2]));
    if (!channels || !fits || !cells_fit) return;
    const auto visit = [&voxels](std::int64_t first, std::int64_t count, const float* values) {
        voxels.add(first, count, values);
        return true;
    };
    if (examination.expect_read(read_exr_volume(*image.value, level.size, layout, visit),
                                "voxels")) {
        voxels.report(examination, asset);
    }
}

void check_bin(Examination& examination, const std::filesystem::path& path,
               const ManifestAsset& asset, const ManifestFile& file, VoxelCheck& voxels) {
    const auto visit = [&voxels](std::int64_t first, std::int64_t count, const float* values) {
        voxels.add(first, count, values);
        return true;
    };
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    const auto read = read_bin_volume(path, level.size, static_cast<int>(asset.channels.size()),
                                      file.pixel_type, visit);
    if (examination.expect_read(read, "size")) voxels.report(examination, asset);
}

void check_vdb(Examination& examination, const std::filesystem::path& path,
               const ManifestAsset& asset, const ManifestFile& file, VoxelCheck& voxels) {
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    const config::Outcome<VdbFile> facts = read_vdb(path);
    if (!examination.expect_read(facts, "format")) return;
    std::vector<std::string> names;
    for (const VdbGrid& grid : facts.value->grids) {
        names.push_back(grid.name);
        const bool half = file.pixel_type == config::PixelType::half;
        examination.expect(grid.half == half, "pixel_type",
                           fmt::format("the grid {} is not {}", grid.name, spell(file.pixel_type)));
    }
    const bool channels =
        examination.expect_equal(names, file.grids, "channels", "the list of grids");
    check_attributes(examination, facts.value->attributes, volume_attributes(asset, file));
    if (!channels) return;
    std::array<int, 3> size{};
    const auto visit = [&](const VdbSlab& slab) {
        size = slab.size;
        if (size != level.size) return false;
        const std::int64_t slice = std::int64_t{size[0]} * size[1];
        voxels.add(slab.first_z * slice, slab.depth * slice, slab.voxels.data());
        return true;
    };
    const config::Outcome<bool> read = read_vdb_voxels(path, visit);
    if (!examination.expect_read(read, "voxels")) return;
    if (examination.expect_equal(size, level.size, "size", "the size")) {
        voxels.report(examination, asset);
    }
}

}  // namespace

void check_volume_file(Examination& examination, const std::filesystem::path& path,
                       const ManifestAsset& asset, const ManifestFile& file) {
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    const TextureUse use = {level.size, repeating_axes(asset.mapping),
                            is_looked_up_nearest(asset.kind)};
    VoxelCheck voxels(level, use, asset.channels.size(), file.pixel_type);
    if (file.format == spell(config::VolumeFormat::exr)) {
        check_exr(examination, path, asset, file, voxels);
    } else if (file.format == spell(config::VolumeFormat::vdb)) {
        check_vdb(examination, path, asset, file, voxels);
    } else {
        check_bin(examination, path, asset, file, voxels);
    }
}

}  // namespace skybake
