// The keys of a volume's files (VolumeFiles), described once, for the field tables of the bakes
// that make volumes.
#pragma once

#include <array>
#include <iterator>
#include <vector>

#include "config/assets/shared_fields.h"
#include "config/fields/row.h"
#include "config/sections/files.h"

namespace skybake::config {

inline constexpr Range voxel_range{1, 16384};
inline constexpr Range level_range{1, 15};
inline constexpr Range column_range{1, 16384};

inline constexpr std::array format_choices = {
    Choice{VolumeFormat::exr, "exr", "slices in one image; float or half"},
    Choice{VolumeFormat::vdb, "vdb", "OpenVDB, a grid per channel; float or half"},
    Choice{VolumeFormat::bin, "bin", "the voxels alone, little-endian, x fastest; any pixel type"},
};
inline constexpr std::array pixel_type_choices = {
    Choice{PixelType::float32, "float", "32 bits per channel"},
    Choice{PixelType::half, "half", "16 bits per channel: 3 digits, 6e-8 to 65504"},
    Choice{PixelType::unorm8, "unorm8", "8 bits per channel for 0 to 1; bin only"},
    Choice{PixelType::unorm16, "unorm16", "16 bits per channel for 0 to 1; bin only"},
};
inline constexpr std::array layout_choices = {
    Choice{VolumeLayout::stack, "stack", "slices below each other, slice 0 first"},
    Choice{VolumeLayout::atlas, "atlas", "slices in rows from the left, rows from the top"},
};
inline constexpr std::array vdb_compression_choices = {
    Choice{VdbCompression::none, "none", "no compression"},
    Choice{VdbCompression::zip, "zip", "deflate"},
    Choice{VdbCompression::blosc, "blosc", "Blosc with LZ4: fast"},
};
inline constexpr std::string_view atlas[] = {"atlas"};

// What the keys of files say differently in one asset and the other.
struct FileWords {
    std::string_view formats;  // the default
    std::string_view mips = "number of levels of detail, with the volume itself";
    std::string_view pixel_type = R"("half")";  // the default
};

// A section's own rows, and after them those of VolumeFiles.
template <class S, std::size_t count>
std::vector<Row<S>> with_file_fields(const std::array<Row<S>, count>& own, const FileWords& words) {
    std::vector<Row<S>> rows(own.begin(), own.end());
    const Row<S> file_rows[] = {
        {{.key = "formats",
          .kind = Kind::choice_list,
          .choices = format_choices,
          .fallback = words.formats,
          .documentation = "files to write, NAME.exr and so on",
          .role = Role::files},
         &VolumeFiles::formats},
        {{.key = "pixel_type",
          .kind = Kind::choice,
          .choices = pixel_type_choices,
          .fallback = words.pixel_type,
          .documentation = "type of the numbers in the files"},
         &VolumeFiles::pixel_type},
        {{.key = "layout",
          .kind = Kind::choice,
          .choices = layout_choices,
          .fallback = R"("stack")",
          .documentation = "where the slices lie in the EXR file; by default an atlas where a "
                           "stack would have more than 16384 rows",
          .role = Role::files},
         &VolumeFiles::layout},
        {{.key = "columns",
          .kind = Kind::integer,
          .range = column_range,
          .documentation =
              "slices in a row of the atlas; by default a divisor of the slices, near to a square",
          .selector = "layout",
          .selected_by = atlas,
          .role = Role::files},
         &VolumeFiles::columns},
        {{.key = "mips",
          .kind = Kind::levels,
          .range = level_range,
          .fallback = "1",
          .documentation = words.mips,
          .hint = "\"all\" goes down to one voxel",
          .role = Role::files},
         &VolumeFiles::mips},
        {compression_field, &VolumeFiles::compression},
        {{.key = "vdb_compression",
          .kind = Kind::choice,
          .choices = vdb_compression_choices,
          .fallback = R"("blosc")",
          .documentation = "compression of the VDB file, always lossless",
          .role = Role::files},
         &VolumeFiles::vdb_compression},
    };
    rows.insert(rows.end(), std::begin(file_rows), std::end(file_rows));
    return rows;
}

}  // namespace skybake::config
