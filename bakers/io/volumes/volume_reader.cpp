#include "bakers/io/volumes/volume_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

// Where the voxels that count are, by index along the file's axes.
struct Cut {
    std::array<int, 3> first{};
    std::array<int, 3> size{};
    std::array<double, 3> voxel_size_m{};
    std::array<double, 3> corner_m{};  // in the file's space
    bool has_place = false;            // the file says where it lies
};

struct Problem {
    std::string code;
    std::string reason;
};

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

std::optional<Problem> find_cut(const VolumeFile& volume, const FileVoxels& file, Cut& cut) {
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
            return Problem{"E0110",
                           fmt::format("{} {} voxels along {}, and at most {} are read{}",
                                       is_cut ? "with its crop and border it has" : "it has",
                                       count[i] + border, "xyz"[i], most_voxels,
                                       is_cut ? "" : "; crop_first and crop_size choose a part")};
        }
        const double end = double{1} * file.first[i] + file.size[i];
        if (first[i] >= end || first[i] + count[i] <= file.first[i]) {
            return Problem{
                "E0110",
                fmt::format("its voxels along {} are {} to {}, and the crop is {} to {}", "xyz"[i],
                            file.first[i], end - 1, first[i], first[i] + count[i] - 1)};
        }
        cut.first[i] = static_cast<int>(first[i]);
        cut.size[i] = static_cast<int>(count[i]);
        cut.voxel_size_m[i] = file.voxel_size[i];
        cut.corner_m[i] = file.index_origin[i] + first[i] * file.voxel_size[i];
    }
    cut.has_place = file.has_place;
    return std::nullopt;
}

// Returns numbers along x, y and up of numbers along the file's axes.
template <class T>
std::array<T, 3> turned(const std::array<T, 3>& of_file, VolumeUp up) {
    if (up == VolumeUp::z) return of_file;
    return {of_file[0], of_file[2], of_file[1]};
}

config::VolumeShape shape_of(const VolumeFile& volume, const Cut& cut) {
    config::VolumeShape shape{turned(cut.size, volume.up_axis),
                              turned(cut.voxel_size_m, volume.up_axis),
                              turned(cut.corner_m, volume.up_axis)};
    // With y up, the cloud's y is the file's -z.
    if (volume.up_axis == VolumeUp::y) {
        shape.corner_m[1] = -(cut.corner_m[2] + cut.size[2] * cut.voxel_size_m[2]);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        shape.size[i] += 2 * volume.border;
        shape.corner_m[i] -= volume.border * shape.voxel_size_m[i];
    }
    if (!cut.has_place) shape.corner_m = {};
    return shape;
}

// A cut of a file's voxels whose third axis is up.
//
// With y up, voxel (x, y, z) of the cloud is voxel (x, z, n - 1 - y) of the file's cut, where n is its
// size along z. That is a turn by 90 degrees about x; without the reversal it would mirror the cloud.
class PlacedVoxels : public VoxelSource {
  public:
    PlacedVoxels(const VolumeFile& volume, Cut cut, FileVoxels file)
        : cut_(cut),
          up_(volume.up_axis),
          border_(volume.border),
          inner_(turned(cut.size, volume.up_axis)),
          scale_(volume.scale),
          file_(std::move(file)) {}

    float scaled(float value) const { return static_cast<float>(value * scale_); }

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        float* out = channels[0];
        const VoxelBox inside = clipped(box);
        if (inside.size != box.size) std::fill_n(out, box.count(), scaled(file_.background));
        if (inside.count() == 0) return;
        const VoxelBox source = of_file(inside);
        std::vector<float> values(static_cast<std::size_t>(source.count()));
        file_.voxels->fill(source, {values.data()});
        for (int z = 0; z < inside.size[2]; ++z) {
            for (int y = 0; y < inside.size[1]; ++y) {
                const float* from = values.data() + row_in(source, inside, y, z);
                float* to = out + row_of(box, inside, y, z);
                for (int x = 0; x < inside.size[0]; ++x) to[x] = scaled(from[x]);
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

    // Returns the part of a box that lies within the cut.
    VoxelBox clipped(const VoxelBox& box) const {
        VoxelBox inside;
        for (std::size_t i = 0; i < 3; ++i) {
            const int first = std::max(box.origin[i], margin(i));
            const int end = std::min(box.origin[i] + box.size[i], margin(i) + inner_[i]);
            inside.origin[i] = first;
            inside.size[i] = std::max(end - first, 0);
        }
        return inside;
    }

    VoxelBox of_file(const VoxelBox& inside) const {
        std::array<int, 3> first{};
        for (std::size_t i = 0; i < 3; ++i) first[i] = inside.origin[i] - margin(i);
        if (up_ == VolumeUp::y) first[1] = inner_[1] - first[1] - inside.size[1];
        VoxelBox source{turned(first, up_), turned(inside.size, up_)};
        for (std::size_t i = 0; i < 3; ++i) source.origin[i] += cut_.first[i];
        return source;
    }

    // Returns where the row (y, z) of a part begins in the box of the file that it comes from.
    std::int64_t row_in(const VoxelBox& source, const VoxelBox& inside, int y, int z) const {
        const bool is_up = up_ == VolumeUp::z;
        const int file_y = is_up ? y : z;
        const int file_z = is_up ? z : inside.size[1] - 1 - y;
        return (std::int64_t{file_z} * source.size[1] + file_y) * source.size[0];
    }

    static std::int64_t row_of(const VoxelBox& box, const VoxelBox& inside, int y, int z) {
        const int slice = inside.origin[2] - box.origin[2] + z;
        const int row = inside.origin[1] - box.origin[1] + y;
        return (std::int64_t{slice} * box.size[1] + row) * box.size[0] + inside.origin[0] -
               box.origin[0];
    }

    const Cut cut_;
    const VolumeUp up_;
    const int border_;
    const std::array<int, 3> inner_;
    const double scale_;
    const FileVoxels file_;
};

// Makes diagnostics point to the recipe, if one names the file.
template <class T>
Outcome<T> located(const VolumeFile& volume, std::vector<Diagnostic> diagnostics) {
    for (Diagnostic& diagnostic : diagnostics) {
        if (!volume.file_place.source.empty()) diagnostic.where = volume.file_place;
    }
    return {{}, std::move(diagnostics)};
}

// Warns (W0226) of values below 0, which are no densities.
std::vector<Diagnostic> warnings_of(const VolumeFile& volume, const ValueFaults& faults) {
    const ValueFaults::Kind& found = faults.negative;
    if (found.count == 0) return {};
    const std::string path = volume.path.string();
    Diagnostic warning = file_error(
        "W0226", path,
        fmt::format("`{}`: {}{}; they count as 0", path, words_of_fault(found, "below 0"),
                    found.count > 1 ? fmt::format(", and {} is the least", found.least) : ""),
        "densities are at least 0");
    if (!volume.file_place.source.empty()) warning.where = volume.file_place;
    return {std::move(warning)};
}

template <class T, class Make>
Outcome<T> with_cut(const VolumeFile& volume, VolumePart part, const Make& make) {
    Outcome<FileVoxels> file = open_file(volume, part);
    if (!file.value) return located<T>(volume, std::move(file.diagnostics));
    set_voxel_size(volume, *file.value);
    Cut cut;
    if (const auto problem = find_cut(volume, *file.value, cut)) {
        const std::string path = volume.path.string();
        const std::string message =
            fmt::format("cannot take a volume from `{}`: {}", path, problem->reason);
        return located<T>(volume, {file_error(problem->code, path, message)});
    }
    std::vector<Diagnostic> warnings = warnings_of(volume, file.value->faults);
    return {make(cut, std::move(*file.value)), std::move(warnings)};
}

}  // namespace

Outcome<config::VolumeShape> read_volume_shape(const VolumeFile& volume) {
    return with_cut<config::VolumeShape>(
        volume, VolumePart::shape,
        [&](const Cut& cut, const FileVoxels&) { return shape_of(volume, cut); });
}

Outcome<SourceVoxels> open_volume(const VolumeFile& volume) {
    return with_cut<SourceVoxels>(volume, VolumePart::voxels, [&](const Cut& cut, FileVoxels file) {
        const config::VolumeShape shape = shape_of(volume, cut);
        const auto scaled = [&](float value) { return static_cast<float>(value * volume.scale); };
        SourceVoxels source{shape.size, shape.voxel_size_m, nullptr, scaled(file.background),
                            scaled(file.largest)};
        source.voxels = std::make_shared<PlacedVoxels>(volume, cut, std::move(file));
        return source;
    });
}

}  // namespace skybake
