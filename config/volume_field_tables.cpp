// The field tables of bakes that make volumes; field_tables.cpp says how such tables work. The keys
// of their files (VolumeFiles) are described once.
#include "config/fields.h"
#include "config/shared_fields.h"
#include "config/sky_fields.h"

namespace skybake::config {
namespace {

constexpr Range voxel_range{1, 16384};
constexpr Range voxel_size_range{1e-3, 1e8};
constexpr Range level_range{1, 15};
constexpr Range column_range{1, 16384};
constexpr Range cell_range{1, 16};

constexpr std::string_view olajos_2016 = "Olajos 2016, Real-Time Rendering of Volumetric Clouds";

// Choices, each in the order of its enumeration in parameters.h.
constexpr std::array format_choices = {
    Choice{"exr", "slices in one image; float or half"},
    Choice{"vdb", "OpenVDB, a grid per channel; float or half"},
    Choice{"bin", "the voxels alone, little-endian, x fastest; any pixel type"},
};
constexpr std::array pixel_type_choices = {
    Choice{"float", "32 bits a channel"},
    Choice{"half", "16 bits a channel: 3 digits, 6e-8 to 65504"},
    Choice{"unorm8", "8 bits a channel for 0 to 1; bin only"},
    Choice{"unorm16", "16 bits a channel for 0 to 1; bin only"},
};
constexpr std::array layout_choices = {
    Choice{"stack", "slices below each other, slice 0 first"},
    Choice{"atlas", "slices in rows from the left, rows from the top"},
};
constexpr std::array vdb_compression_choices = {
    Choice{"none", "no compression"},
    Choice{"zip", "deflate"},
    Choice{"blosc", "Blosc with LZ4: fast"},
};
constexpr std::array filter_choices = {
    Choice{"nearest", "the voxel that a point lies in"},
    Choice{"trilinear", "between the eight nearest voxels, as GPUs do"},
    Choice{"tricubic", "cubic B-spline over 64 voxels"},
};
constexpr std::array rule_choices = {
    Choice{"exact", "a cell is empty only where no filtered sample in it is above 0"},
    Choice{"thesis", "8 of 64 voxels of a cell, then a ring around; loses thin wisps"},
};
constexpr std::array content_choices = {
    Choice{"occupied", "1, or 0 where the cell is empty"},
    Choice{"leap", "cells to the nearest occupied one, by the greatest of the three axes"},
    Choice{"minimum", "no filtered sample in the cell is below"},
    Choice{"maximum", "no filtered sample in the cell is above"},
};

constexpr std::array aerial_content_choices = {
    Choice{"in_scatter_and_transmittance", "R, G, B light, and A the channels' mean transmittance"},
    Choice{"in_scatter", "light alone"},
    Choice{"transmittance", "transmittance alone, of each channel"},
};
constexpr std::array slices_choices = {
    Choice{"linear", "w = distance / view_distance"},
    Choice{"squared", "w = sqrt(distance / view_distance): closer together near the camera"},
};

constexpr std::string_view atlas[] = {"atlas"};
constexpr Range turn_range{-2 * std::numbers::pi, 2 * std::numbers::pi};
constexpr Range fov_range{0, std::numbers::pi, true, true};
constexpr Range aspect_range{1e-3, 1e3};

// What the keys of files say differently in one asset and the other.
struct FileWords {
    std::string_view formats;  // the default
    std::string_view mips = "levels of detail, the volume itself among them";
};

// A section's own rows, and after them those of VolumeFiles.
template <class Row, std::size_t count>
std::vector<Row> with_file_fields(const std::array<Row, count>& own, const FileWords& words) {
    std::vector<Row> rows(own.begin(), own.end());
    const Row file_rows[] = {
        {{.key = "formats",
          .kind = Kind::choice_list,
          .choices = format_choices,
          .fallback = words.formats,
          .documentation = "files to write, NAME.exr and so on"},
         &VolumeFiles::formats},
        {{.key = "pixel_type",
          .kind = Kind::choice,
          .choices = pixel_type_choices,
          .fallback = R"("half")",
          .documentation = "numbers in the files"},
         &VolumeFiles::pixel_type},
        {{.key = "layout",
          .kind = Kind::choice,
          .choices = layout_choices,
          .fallback = R"("stack")",
          .documentation = "where the slices lie in the EXR file"},
         &VolumeFiles::layout},
        {{.key = "columns",
          .kind = Kind::integer,
          .range = column_range,
          .documentation = "slices in a row of the atlas; left out: near to a square",
          .selector = "layout",
          .selected_by = atlas},
         &VolumeFiles::columns},
        {{.key = "mips",
          .kind = Kind::levels,
          .range = level_range,
          .fallback = "1",
          .documentation = words.mips,
          .hint = "\"all\" goes down to one voxel"},
         &VolumeFiles::mips},
        {compression_field, &VolumeFiles::compression},
        {{.key = "vdb_compression",
          .kind = Kind::choice,
          .choices = vdb_compression_choices,
          .fallback = R"("blosc")",
          .documentation = "of the VDB file, always lossless"},
         &VolumeFiles::vdb_compression},
    };
    rows.insert(rows.end(), std::begin(file_rows), std::end(file_rows));
    return rows;
}

const std::array noise_volume_table = {
    NoiseVolumeField{asset_field, {}},
    NoiseVolumeField{{.key = "noise",
                      .kind = Kind::text,
                      .required = true,
                      .documentation = "NAME of the [noise.NAME] to bake"},
                     &NoiseVolumeBake::noise},
    NoiseVolumeField{{.key = "size",
                      .kind = Kind::voxels,
                      .range = voxel_range,
                      .documentation = "voxels along x, y and z; left out: the noise's size",
                      .hint = "1 along z is a picture"},
                     &NoiseVolumeBake::size},
};

const std::array cloud_volume_table = {
    CloudVolumeField{asset_field, {}},
    CloudVolumeField{{.key = "cloud",
                      .kind = Kind::text,
                      .required = true,
                      .documentation = "NAME of the [clouds.NAME] to bake"},
                     &CloudVolumeBake::cloud},
    CloudVolumeField{{.key = "size",
                      .kind = Kind::voxels,
                      .range = voxel_range,
                      .documentation = "voxels along x, y and z, which is up",
                      .hint = "[512, 512, 128]",
                      .exclusive_group = "size"},
                     &CloudVolumeBake::size},
    CloudVolumeField{{.key = "voxel_size",
                      .kind = Kind::length,
                      .range = voxel_size_range,
                      .documentation = "in place of size: extent / voxel_size voxels, rounded",
                      .hint = "\"12 m\"",
                      .exclusive_group = "size",
                      .only_shown = true},
                     {}},
};

const std::array occupancy_table = {
    OccupancyField{asset_field, {}},
    OccupancyField{{.key = "of",
                    .kind = Kind::text,
                    .required = true,
                    .documentation = "NAME of the [bake.NAME] with asset = \"cloud_volume\""},
                   &OccupancyBake::of},
    OccupancyField{{.key = "channel",
                    .kind = Kind::text,
                    .documentation = "channel of that volume; left out: its first",
                    .hint = "R, G, B or A; Y where it has one"},
                   &OccupancyBake::channel},
    OccupancyField{{.key = "cell",
                    .kind = Kind::power_of_two,
                    .range = cell_range,
                    .fallback = "4",
                    .documentation = "voxels along each edge of a cell",
                    .hint = "1, 2, 4, 8 or 16",
                    .citation = olajos_2016},
                   &OccupancyBake::cell},
    OccupancyField{{.key = "filter",
                    .kind = Kind::choice,
                    .choices = filter_choices,
                    .fallback = R"("trilinear")",
                    .documentation = "how the runtime looks the volume up"},
                   &OccupancyBake::filter},
    OccupancyField{{.key = "rule",
                    .kind = Kind::choice,
                    .choices = rule_choices,
                    .fallback = R"("exact")",
                    .documentation = "when a cell is empty",
                    .citation = olajos_2016},
                   &OccupancyBake::rule},
    OccupancyField{{.key = "contents",
                    .kind = Kind::choice_list,
                    .choices = content_choices,
                    .fallback = R"(["occupied", "leap", "minimum", "maximum"])",
                    .documentation = "what the channels hold, in this order: one, three or four"},
                   &OccupancyBake::contents},
};

const std::array aerial_perspective_table = {
    AerialPerspectiveField{asset_field, {}},
    AerialPerspectiveField{{.key = "size",
                            .kind = Kind::voxels,
                            .range = voxel_range,
                            .fallback = "[32, 32, 32]",
                            .documentation = "voxels across the picture, down it, and slices",
                            .citation = hillaire_2020},
                           &AerialPerspectiveBake::size},
    AerialPerspectiveField{{.key = "content",
                            .kind = Kind::choice,
                            .choices = aerial_content_choices,
                            .fallback = R"("in_scatter_and_transmittance")",
                            .documentation = "what the channels hold"},
                           &AerialPerspectiveBake::content},
    AerialPerspectiveField{camera_altitude_field, &AerialPerspectiveBake::altitude},
    AerialPerspectiveField{{.key = "sun_elevation",
                            .kind = Kind::angle,
                            .range = elevation_range,
                            .required = true,
                            .documentation = "of the sun at the camera",
                            .hint = "-90 deg to 90 deg"},
                           &AerialPerspectiveBake::sun_elevation},
    AerialPerspectiveField{{.key = "heading",
                            .kind = Kind::angle,
                            .range = turn_range,
                            .fallback = R"("0 deg")",
                            .documentation = "of the view, to the right from the sun's azimuth"},
                           &AerialPerspectiveBake::heading},
    AerialPerspectiveField{{.key = "pitch",
                            .kind = Kind::angle,
                            .range = elevation_range,
                            .fallback = R"("0 deg")",
                            .documentation = "of the view, upwards from the horizontal"},
                           &AerialPerspectiveBake::pitch},
    AerialPerspectiveField{{.key = "fov",
                            .kind = Kind::angle,
                            .range = fov_range,
                            .fallback = R"("60 deg")",
                            .documentation = "angle between the lower and the upper edge"},
                           &AerialPerspectiveBake::fov},
    AerialPerspectiveField{{.key = "aspect",
                            .kind = Kind::number,
                            .range = aspect_range,
                            .fallback = "1.7777777777777777",
                            .documentation = "width of the picture over its height"},
                           &AerialPerspectiveBake::aspect},
    AerialPerspectiveField{{.key = "view_distance",
                            .kind = Kind::length,
                            .range = view_distance_range,
                            .documentation = "at w = 1; left out: that of [scene], or its default"},
                           &AerialPerspectiveBake::view_distance},
    AerialPerspectiveField{{.key = "slices",
                            .kind = Kind::choice,
                            .choices = slices_choices,
                            .fallback = R"("squared")",
                            .documentation = "the distance that a slice stands for",
                            .citation = hillaire_2020},
                           &AerialPerspectiveBake::slices},
    AerialPerspectiveField{orders_field, &AerialPerspectiveBake::orders},
    AerialPerspectiveField{layers_field, &AerialPerspectiveBake::layers},
};

}  // namespace

std::span<const AerialPerspectiveField> aerial_perspective_fields() {
    static const auto table = with_file_fields(aerial_perspective_table, {.formats = R"(["exr"])"});
    return table;
}

std::span<const NoiseVolumeField> noise_volume_fields() {
    static const auto table = with_file_fields(noise_volume_table, {.formats = R"(["exr"])"});
    return table;
}

std::span<const CloudVolumeField> cloud_volume_fields() {
    static const auto table = with_file_fields(cloud_volume_table, {.formats = R"(["vdb"])"});
    return table;
}

std::span<const OccupancyField> occupancy_fields() {
    static const auto table = with_file_fields(
        occupancy_table,
        {.formats = R"(["exr"])",
         .mips = "levels of the pyramid of minima and maxima, the cells themselves among them"});
    return table;
}

}  // namespace skybake::config
