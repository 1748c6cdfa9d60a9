// The field tables of bakes that make volumes; field_tables.cpp says how such tables work.
#include "config/assets/shared_fields.h"
#include "config/assets/sky_fields.h"
#include "config/assets/volume_fields.h"
#include "config/fields/fields.h"
#include "config/fields/shared_ranges.h"

namespace skybake::config {
namespace {

constexpr Range voxel_size_range{1e-3, 1e8};
constexpr Range cloud_extent_range{1e-3, 1e8};
constexpr Range cell_range{1, 16};

// Choices, each in the order of its enumeration in parameters.h.
constexpr std::array filter_choices = {
    Choice{"nearest", "the voxel in which a point lies"},
    Choice{"trilinear", "between the eight nearest voxels, as GPUs do"},
    Choice{"tricubic", "cubic B-spline over 64 voxels"},
};
constexpr std::array rule_choices = {
    Choice{"exact", "a cell is empty only where no filtered sample in it is above 0"},
    Choice{"thesis",
           "samples 8 of 64 voxels of a cell and marks a ring around occupied cells; loses thin "
           "wisps"},
};
constexpr std::array occupancy_content_choices = {
    Choice{"occupied", "1, or 0 where the cell is empty"},
    Choice{"leap", "cells to the nearest occupied one, along the longest of the three axes"},
    Choice{"minimum", "the smallest filtered sample in the cell"},
    Choice{"maximum", "the largest filtered sample in the cell"},
};

constexpr std::array aerial_content_choices = {
    Choice{"in_scatter_and_transmittance",
           "light in R, G, B and the channels' mean transmittance in A"},
    Choice{"in_scatter", "light alone"},
    Choice{"transmittance", "transmittance alone, of each channel"},
};
constexpr std::array slices_choices = {
    Choice{"linear", "w = distance / view_distance"},
    Choice{"squared", "w = sqrt(distance / view_distance): closer together near the camera"},
};

constexpr Range turn_range{-2 * std::numbers::pi, 2 * std::numbers::pi};
constexpr Range fov_range{0, std::numbers::pi, true, true};
constexpr Range picture_aspect_range{1e-3, 1e3};

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
                      .documentation = "voxels along x, y and z; by default the noise's size",
                      .hint = "1 along z gives a picture"},
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
                      .exclusive_group = "size",
                      .exclusive_side = "counted"},
                     &CloudVolumeBake::size},
    CloudVolumeField{
        {.key = "extent",
         .kind = Kind::lengths,
         .range = cloud_extent_range,
         .documentation =
             "what the voxels span, to which the cloud is stretched; by default the cloud's extent",
         .hint = "voxel_size sets it where it does not divide the cloud's extent",
         .exclusive_group = "size",
         .exclusive_side = "counted"},
        &CloudVolumeBake::extent},
    CloudVolumeField{{.key = "voxel_size",
                      .kind = Kind::length,
                      .range = voxel_size_range,
                      .documentation = "edge of a cubic voxel, in place of size; the cloud's "
                                       "extent is rounded up to whole voxels",
                      .hint = "\"12 m\"",
                      .exclusive_group = "size",
                      .exclusive_side = "measured",
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
                    .documentation = "channel of that volume; its first by default",
                    .hint = "R, G, B or A, or Y for a volume of one channel"},
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
                    .choices = occupancy_content_choices,
                    .fallback = R"(["occupied", "leap", "minimum", "maximum"])",
                    .documentation = "what the one, three or four channels hold, in this order"},
                   &OccupancyBake::contents},
};

const std::array aerial_perspective_table = {
    AerialPerspectiveField{asset_field, {}},
    AerialPerspectiveField{
        {.key = "size",
         .kind = Kind::voxels,
         .range = voxel_range,
         .fallback = "[32, 32, 32]",
         .documentation = "voxels across and down the picture, and the number of slices",
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
                            .documentation = "elevation of the sun at the camera",
                            .hint = "-90 deg to 90 deg"},
                           &AerialPerspectiveBake::sun_elevation},
    AerialPerspectiveField{{.key = "heading",
                            .kind = Kind::angle,
                            .range = turn_range,
                            .fallback = R"("0 deg")",
                            .documentation = "camera heading, clockwise from the sun's azimuth"},
                           &AerialPerspectiveBake::heading},
    AerialPerspectiveField{{.key = "pitch",
                            .kind = Kind::angle,
                            .range = elevation_range,
                            .fallback = R"("0 deg")",
                            .documentation = "camera pitch, upwards from the horizontal"},
                           &AerialPerspectiveBake::pitch},
    AerialPerspectiveField{{.key = "fov",
                            .kind = Kind::angle,
                            .range = fov_range,
                            .fallback = R"("60 deg")",
                            .documentation = "angle between the lower and the upper edge"},
                           &AerialPerspectiveBake::fov},
    AerialPerspectiveField{{.key = "aspect",
                            .kind = Kind::number,
                            .range = picture_aspect_range,
                            .fallback = "1.7777777777777777",
                            .documentation = "width of the picture over its height"},
                           &AerialPerspectiveBake::aspect},
    AerialPerspectiveField{
        {.key = "view_distance",
         .kind = Kind::length,
         .range = view_distance_range,
         .documentation = "distance at w = 1; by default that of [scene], or its default"},
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
         .mips = "levels of the pyramid of minima and maxima, with the cells themselves"});
    return table;
}

}  // namespace skybake::config
