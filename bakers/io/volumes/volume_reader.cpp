#include "bakers/io/volumes/volume_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/voxel_index.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/nvdb/nvdb_source.h"
#include "bakers/io/formats/vdb/vdb_source.h"
#include "bakers/io/volumes/file_voxels.h"
#include "bakers/io/volumes/raw_volume.h"

namespace skybake {
namespace {

using config::VolumeFile;
using config::VolumeFormat;
using config::VolumeUp;

constexpr std::int64_t most_voxels = 16384;  // along an axis

Outcome<FileVoxels> open_file(const VolumeFile& volume, VolumePart part) {
    const std::filesystem::path& path = volume.path;
    if (volume.format == VolumeFormat::vdb) {
        return open_vdb_grid(path, volume.grid, part, volume.not_finite);
    }
    if (volume.format == VolumeFormat::nvdb) {
        return open_nvdb_grid(path, volume.grid, part, volume.not_finite);
    }
    RawLayout layout{volume.size, volume.type, volume.byte_order, volume.axis_order, 0};
    layout.offset = static_cast<std::uint64_t>(volume.offset);
    return open_raw_volume(path, layout, part, volume.not_finite);
}

// Replaces the file's voxels by those of the recipe.
void set_voxel_size(const VolumeFile& volume, FileVoxels& file) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double edge = volume.voxel_size[i].meters;
        if (edge <= 0) continue;
        if (file.voxel_size[i] > 0) file.index_origin[i] *= edge / file.voxel_size[i];
        file.voxel_size[i] = edge;
    }
}

// Rounds a crop in metres to whole voxels, at least one.
void cut_by_lengths(const VolumeFile& volume, const FileVoxels& file, std::array<double, 3>& first,
                    std::array<double, 3>& count) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double edge = file.voxel_size[i];
        first[i] = std::round((volume.crop_corner[i].meters - file.index_origin[i]) / edge);
        count[i] = std::max(1.0, std::round(volume.crop_extent[i].meters / edge));
    }
}

// Leaves the voxels of the recipe's crop, or all. Returns why there is no such volume, in words, or nothing.
std::optional<std::string> cut_voxels(const VolumeFile& volume, FileVoxels& file) {
    std::array<double, 3> first{};
    std::array<double, 3> count{};
    const bool is_counted = volume.crop_size[0] > 0;
    for (std::size_t i = 0; i < 3; ++i) {
        first[i] = is_counted ? volume.crop_first[i] : file.first[i];
        count[i] = is_counted ? volume.crop_size[i] : file.size[i];
    }
    if (volume.crop_extent[0].meters > 0) cut_by_lengths(volume, file, first, count);
    const std::size_t up = volume.up_axis == VolumeUp::z ? 2 : 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const double border = i == up ? 0 : 2.0 * volume.border;
        if (count[i] + border > most_voxels) {
            const bool is_cut = count[i] != file.size[i] || border > 0;
            return fmt::format("{} {} voxels along {}, and at most {} are read{}",
                               is_cut ? "with its crop and border it has" : "it has",
                               count[i] + border, "xyz"[i], most_voxels,
                               is_cut ? "" : "; crop_first and crop_size choose a part");
        }
        const double end = double{1} * file.first[i] + file.size[i];
        if (first[i] >= end || first[i] + count[i] <= file.first[i]) {
            return fmt::format("its voxels along {} are {} to {}, and the crop is {} to {}",
                               "xyz"[i], file.first[i], end - 1, first[i], first[i] + count[i] - 1);
        }
        file.first[i] = static_cast<int>(first[i]);
        file.size[i] = static_cast<int>(count[i]);
    }
    return std::nullopt;
}

// Returns numbers along x, y and up of numbers along the file's axes.
template <class T>
std::array<T, 3> turned(const std::array<T, 3>& of_file, VolumeUp up) {
    if (up == VolumeUp::z) return of_file;
    return {of_file[0], of_file[2], of_file[1]};
}

config::VolumeShape shape_of(const VolumeFile& volume, const FileVoxels& file) {
    std::array<double, 3> corner_m{};  // in the file's space
    for (std::size_t i = 0; i < 3; ++i) {
        corner_m[i] = file.index_origin[i] + file.first[i] * file.voxel_size[i];
    }
    config::VolumeShape shape{turned(file.size, volume.up_axis),
                              turned(file.voxel_size, volume.up_axis),
                              turned(corner_m, volume.up_axis)};
    // With y up, the cloud's y is the file's -z.
    if (volume.up_axis == VolumeUp::y) {
        shape.corner_m[1] = -(corner_m[2] + file.size[2] * file.voxel_size[2]);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        shape.size[i] += 2 * volume.border;
        shape.corner_m[i] -= volume.border * shape.voxel_size_m[i];
    }
    if (!file.has_place) shape.corner_m = {};
    return shape;
}

// The voxels of a file whose third axis is up, with a border and scaled.
class PlacedVoxels : public VoxelSource {
  public:
    PlacedVoxels(const VolumeFile& volume, FileVoxels file)
        : border_(volume.border), scale_(volume.scale), file_(std::move(file)) {}

    float scaled(float value) const { return static_cast<float>(value * scale_); }

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        float* out = channels[0];
        const VoxelBox inside = clipped(box);
        if (inside.size != box.size) std::fill_n(out, box.count(), scaled(file_.background));
        if (inside.count() == 0) return;
        std::vector<float> values(static_cast<std::size_t>(inside.count()));
        file_.voxels->fill(of_file(inside), {values.data()});
        const float* from = values.data();
        for (int z = inside.origin[2]; z < inside.origin[2] + inside.size[2]; ++z) {
            for (int y = inside.origin[1]; y < inside.origin[1] + inside.size[1]; ++y) {
                float* to = out + index_in(box, {inside.origin[0], y, z});
                for (int x = 0; x < inside.size[0]; ++x) to[x] = scaled(*from++);
            }
        }
    }

    bool is_empty(const VoxelBox& box) const override {
        const VoxelBox inside = clipped(box);
        if (inside.size != box.size && file_.background != 0) return false;
        return inside.count() == 0 || file_.voxels->is_empty(of_file(inside));
    }

  private:
    int margin(std::size_t axis) const { return axis == 2 ? 0 : border_; }

    // Returns the part of a box that lies within the file's voxels.
    VoxelBox clipped(const VoxelBox& box) const {
        VoxelBox inside;
        for (std::size_t i = 0; i < 3; ++i) {
            const int first = std::max(box.origin[i], margin(i));
            const int end = std::min(box.origin[i] + box.size[i], margin(i) + file_.size[i]);
            inside.origin[i] = first;
            inside.size[i] = std::max(end - first, 0);
        }
        return inside;
    }

    VoxelBox of_file(const VoxelBox& inside) const {
        VoxelBox source = inside;
        for (std::size_t i = 0; i < 3; ++i) source.origin[i] += file_.first[i] - margin(i);
        return source;
    }

    const int border_;
    const double scale_;
    const FileVoxels file_;
};

// Makes diagnostics point to the recipe, if one names the file.
std::vector<Diagnostic> located(const VolumeFile& volume, std::vector<Diagnostic> diagnostics) {
    for (Diagnostic& diagnostic : diagnostics) {
        if (!volume.file_place.source.empty()) diagnostic.where = volume.file_place;
    }
    return diagnostics;
}

// Warns (W0226) of values below 0, which are no densities.
std::vector<Diagnostic> warnings_of(const VolumeFile& volume, const ValueFaults& faults) {
    const ValueFaults::Kind& found = faults.negative;
    if (found.count == 0) return {};
    const std::string path = volume.path.string();
    return {file_error(
        "W0226", path,
        fmt::format("`{}`: {}{}; they count as 0", path, words_of_fault(found, "below 0"),
                    found.count > 1 ? fmt::format(", and {} is the least", found.least) : ""),
        "densities are at least 0")};
}

// Opens the voxels that the recipe names, along the axes of the file's space.
Outcome<FileVoxels> open_cut(const VolumeFile& volume, VolumePart part) {
    Outcome<FileVoxels> file = open_file(volume, part);
    if (!file.value) return {{}, located(volume, std::move(file.diagnostics))};
    set_voxel_size(volume, *file.value);
    if (const auto reason = cut_voxels(volume, *file.value)) {
        const std::string path = volume.path.string();
        const std::string message =
            fmt::format("cannot take a volume from `{}`: {}", path, *reason);
        return {{}, located(volume, {file_error("E0110", path, message)})};
    }
    file.diagnostics = located(volume, warnings_of(volume, file.value->faults));
    return file;
}

}  // namespace

Outcome<config::VolumeShape> read_volume_shape(const VolumeFile& volume) {
    Outcome<FileVoxels> file = open_cut(volume, VolumePart::shape);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    return {shape_of(volume, *file.value), std::move(file.diagnostics)};
}

Outcome<SourceVoxels> open_volume(const VolumeFile& volume) {
    Outcome<FileVoxels> file = open_cut(volume, VolumePart::voxels);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const config::VolumeShape shape = shape_of(volume, *file.value);
    // A turn by 90 degrees about x makes y the third axis. An exchange alone would mirror the cloud.
    const IndexAxes y_up{{0, 2, 1}, {false, true, false}};
    if (volume.up_axis == VolumeUp::y) turn_to_space(y_up, *file.value);
    const float background = file.value->background;
    const float largest = file.value->largest;
    const auto placed = std::make_shared<PlacedVoxels>(volume, std::move(*file.value));
    return {SourceVoxels{shape.size, shape.voxel_size_m, placed, placed->scaled(background),
                         placed->scaled(largest)},
            std::move(file.diagnostics)};
}

}  // namespace skybake
