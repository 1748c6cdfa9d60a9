// This header describes the keys that the bake sections of several assets share, and the keys of
// the files that an asset is written to.
#pragma once

#include <array>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/files.h"
#include "config/sections/frames.h"
#include "config/sections/packets.h"
#include "config/sections/scene.h"
#include "config/sections/targets.h"

namespace skybake::config {

// These keys are shared by several bake sections. They are described once here, for all field
// tables.
inline constexpr Field asset_field{
    .key = "asset",
    .kind = Kind::text,
    .documentation = "asset to bake; by default the one that the section's name says"};

inline constexpr std::array orders_choices = {
    Choice{SkyOrders::all, "all", "all light"},
    Choice{SkyOrders::single, "single", "sunlight scattered once, in the air"},
    Choice{SkyOrders::multiple, "multiple",
           "the rest: scattered more than once, or reflected by the ground"},
};
inline constexpr Field orders_field{
    .key = "orders",
    .kind = Kind::choice,
    .choices = orders_choices,
    .fallback = R"("all")",
    .documentation = "which orders of scattering; single and multiple add up to all"};

inline constexpr std::string_view single_orders[] = {"single"};
inline constexpr Field layers_field{.key = "layers",
                                    .kind = Kind::text_list,
                                    .documentation =
                                        "layers of the atmosphere that scatter; by default every "
                                        "one, and all of them always attenuate",
                                    .hint = "for example [\"aerosol\"]",
                                    .selector = "orders",
                                    .selected_by = single_orders};

inline constexpr Field camera_altitude_field{
    .key = "altitude",
    .kind = Kind::length,
    .range = camera_altitude_range,
    .fallback = R"("0 km")",
    .documentation = "altitude of the camera, which may be in space",
    .hint =
        "below 0, as at the Dead Sea: a ground_radius that is smaller by the depth, from which "
        "altitudes count"};

inline constexpr Field max_error_field{
    .key = "max_error",
    .kind = Kind::fraction,
    .range = lookup_error_range,
    .documentation =
        "in place of size, asks for the smallest table whose lookups are within this error",
    .hint = "errors below 0.01 are invisible",
    .exclusive_group = "size"};

// These are the keys of an asset's files (AssetFiles). They are described once here, for the field
// tables of all bakes.
inline constexpr Range voxel_range{1, 16384};
inline constexpr Range level_range{1, 15};
inline constexpr Range column_range{1, 16384};

inline constexpr auto format_choices = []<std::size_t... i>(std::index_sequence<i...>) {
    return std::array{
        Choice{file_formats[i].format, file_formats[i].name, file_formats[i].description}...};
}
(std::make_index_sequence<file_formats.size()>());
inline constexpr std::array pixel_type_choices = {
    Choice{PixelType::float32, "float", "32 bits per channel"},
    Choice{PixelType::half, "half", "16 bits per channel: 3 digits, 6e-8 to 65504"},
    Choice{PixelType::unorm8, "unorm8",
           "8 bits per channel for 0 to 1; bin, dds, ktx2, npy, png and tga"},
    Choice{PixelType::unorm16, "unorm16",
           "16 bits per channel for 0 to 1; bin, dds, ktx2, npy and png"},
    Choice{PixelType::bc4, "bc4", "BC4: 4 bits per texel of one channel, 0 to 1; dds and ktx2"},
    Choice{PixelType::bc6h, "bc6h", "BC6H: 8 bits per texel of R G B, half; dds and ktx2"},
    Choice{PixelType::fp8, "fp8", "NanoVDB's 8 bits between the extremes of 8 x 8 x 8 voxels"},
    Choice{PixelType::fp16, "fp16", "NanoVDB's 16 bits between the extremes of 8 x 8 x 8 voxels"},
};
inline constexpr std::array layout_choices = {
    Choice{SheetLayout::stack, "stack", "slices below each other, slice 0 first"},
    Choice{SheetLayout::atlas, "atlas", "slices in rows from the left, rows from the top"},
};
inline constexpr std::array vdb_compression_choices = {
    Choice{VdbCompression::none, "none", "no compression"},
    Choice{VdbCompression::zip, "zip", "deflate"},
    Choice{VdbCompression::blosc, "blosc", "Blosc with LZ4: fast"},
};
inline constexpr std::array ktx2_compression_choices = {
    Choice{Ktx2Compression::none, "none", "no compression"},
    Choice{Ktx2Compression::zstd, "zstd", "Zstandard, which loaders undo"},
};
inline constexpr std::string_view atlas[] = {"atlas"};

inline constexpr std::array compression_choices = {
    Choice{Compression::none, "none", "no compression"},
    Choice{Compression::zip, "zip", "deflate, 16 lines at a time"},
    Choice{Compression::zips, "zips", "deflate, line by line"},
    Choice{Compression::piz, "piz", "wavelet, lossless; best for noise"},
};

// The keys of files have a few defaults and texts that differ between assets. This struct holds
// them.
struct FileWords {
    std::string_view formats = R"(["exr"])";  // the default
    std::string_view mips = "number of levels of detail, with the volume itself";
    std::string_view pixel_type = R"("half")";  // the default
    std::string_view flip = "false";            // the default; empty if other keys decide it
    std::string_view layout = R"("stack")";     // the default
};

inline constexpr FileWords table_files = {
    .mips = "number of levels of detail, with the table itself", .pixel_type = R"("float")"};

inline constexpr Range packet_number_range{1, most_wavelengths / wavelengths_per_packet};

inline constexpr Range frame_range{1, 100000};
inline constexpr Range frame_rate_range{0.001, 1000};

// Returns a section's own rows, followed by those of LightFiles, VolumeFrames and AssetFiles.
template <class S, std::size_t count>
std::vector<Row<S>> with_file_fields(const std::array<Row<S>, count>& own, const FileWords& words) {
    std::vector<Row<S>> rows(own.begin(), own.end());
    if constexpr (std::is_base_of_v<LightFiles, S>) {
        rows.push_back(
            {{.key = "packet",
              .kind = Kind::integer,
              .range = packet_number_range,
              .documentation = "which four of the wavelengths the channels are; without "
                               "it, of more than four, assets NAME_1, NAME_2 ... hold all"},
             &LightFiles::packet});
    }
    if constexpr (std::is_base_of_v<VolumeFrames, S>) {
        rows.push_back(
            {{.key = "frames",
              .kind = Kind::integer,
              .range = frame_range,
              .documentation = "number of frames in time: assets NAME_0001, NAME_0002 "
                               "... are one each, from the `time` of the noise or the cloud on",
              .hint = "the `period` of the noise or the cloud makes a loop",
              .role = Role::files},
             &VolumeFrames::frames});
        rows.push_back({{.key = "frames_per_second",
                         .kind = Kind::number,
                         .range = frame_rate_range,
                         .fallback = "24",
                         .documentation = "how fast the USD scene plays the frames",
                         .needs = "frames",
                         .role = Role::files},
                        &VolumeFrames::frames_per_second});
        rows.push_back({{.key = "frame",
                         .kind = Kind::integer,
                         .range = frame_range,
                         .documentation = "which frame alone, counted from 1"},
                        &VolumeFrames::frame});
    }
    const Row<S> file_rows[] = {
        {{.key = "target",
          .kind = Kind::choice,
          .choices = target_choices(),
          .documentation = "the program that the files are for; it decides the keys below that the "
                           "section leaves out, and adds the program's own files",
          .role = Role::files},
         &AssetFiles::target},
        {{.key = "formats",
          .kind = Kind::choice_list,
          .choices = format_choices,
          .fallback = words.formats,
          .documentation = "files to write, NAME.exr and so on",
          .role = Role::files},
         &AssetFiles::formats},
        {{.key = "pixel_type",
          .kind = Kind::choice,
          .choices = pixel_type_choices,
          .fallback = words.pixel_type,
          .documentation = "type of the numbers in the files"},
         &AssetFiles::pixel_type},
        {{.key = "layout",
          .kind = Kind::choice,
          .choices = layout_choices,
          .fallback = words.layout,
          .documentation =
              "where the slices lie in EXR, PNG and TGA images; by default an atlas where "
              "a stack would have more than 16384 rows",
          .role = Role::files},
         &AssetFiles::layout},
        {{.key = "columns",
          .kind = Kind::integer,
          .range = column_range,
          .documentation =
              "slices in a row of the atlas; by default a divisor of the slices, near to a square",
          .selector = "layout",
          .selected_by = atlas,
          .role = Role::files},
         &AssetFiles::columns},
        {{.key = "flip",
          .kind = Kind::flag,
          .fallback = words.flip,
          .documentation =
              "whether EXR, PNG and TGA images are upside down, for readers that take the "
              "lower left texel for the first",
          .role = Role::files},
         &AssetFiles::flip},
        {{.key = "mips",
          .kind = Kind::levels,
          .range = level_range,
          .fallback = "1",
          .documentation = words.mips,
          .hint = "\"all\" goes down to one voxel",
          .role = Role::files},
         &AssetFiles::mips},
        {{.key = "compression",
          .kind = Kind::choice,
          .choices = compression_choices,
          .fallback = R"("zip")",
          .documentation = "compression of the EXR file, always lossless",
          .role = Role::files},
         &AssetFiles::compression},
        {{.key = "vdb_compression",
          .kind = Kind::choice,
          .choices = vdb_compression_choices,
          .fallback = R"("blosc")",
          .documentation = "compression of the VDB file, always lossless",
          .role = Role::files},
         &AssetFiles::vdb_compression},
        {{.key = "ktx2_compression",
          .kind = Kind::choice,
          .choices = ktx2_compression_choices,
          .fallback = R"("zstd")",
          .documentation = "compression of the KTX2 file, always lossless",
          .role = Role::files},
         &AssetFiles::ktx2_compression},
    };
    rows.insert(rows.end(), std::begin(file_rows), std::end(file_rows));
    return rows;
}

}  // namespace skybake::config
