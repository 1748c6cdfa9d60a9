#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range volume_voxels_range{1, 16384};
constexpr Range volume_index_range{-1e6, 1e6};
constexpr Range volume_byte_range{0, 2147483647};
constexpr Range volume_slice_range{0, 1e6};
constexpr Range volume_edge_range{1e-6, 1e8};
constexpr Range volume_place_range{-1e9, 1e9};
constexpr Range volume_crop_range{1e-6, 1e9};
constexpr Range volume_scale_range{1e-9, 1e9};
constexpr Range volume_border_range{0, 4096};

constexpr std::array volume_format_choices = {
    Choice{VolumeFormat::vdb, "vdb", "an OpenVDB file with a grid of float, double, int32 or int64"},
    Choice{VolumeFormat::nvdb, "nvdb", "a NanoVDB file with a grid of type Float, Fp8 or Fp16"},
    Choice{VolumeFormat::raw, "raw", "numbers alone, whose layout the section gives"},
    Choice{VolumeFormat::slices, "slices", "numbered EXR, PNG or TIFF pictures, one per slice"},
};
constexpr std::array volume_type_choices = {
    Choice{PixelType::float32, "float32", "32-bit floats"},
    Choice{PixelType::half, "half", "16-bit floats"},
    Choice{PixelType::unorm8, "unorm8", "bytes, of which 255 is 1"},
    Choice{PixelType::unorm16, "unorm16", "16-bit integers, of which 65535 is 1"},
};
constexpr std::array volume_byte_order_choices = {
    Choice{ByteOrder::little, "little", "the lowest byte first"},
    Choice{ByteOrder::big, "big", "the highest byte first"},
};
constexpr std::array volume_axis_order_choices = {
    Choice{AxisOrder::xyz, "xyz", "x runs fastest, z slowest"},
    Choice{AxisOrder::xzy, "xzy", "x runs fastest, y slowest"},
    Choice{AxisOrder::yxz, "yxz", "y runs fastest, z slowest"},
    Choice{AxisOrder::yzx, "yzx", "y runs fastest, x slowest"},
    Choice{AxisOrder::zxy, "zxy", "z runs fastest, y slowest"},
    Choice{AxisOrder::zyx, "zyx", "z runs fastest, x slowest, as in OpenVDB's leaves"},
};
constexpr std::array volume_up_choices = {
    Choice{VolumeUp::z, "z", "the file's z is up, as in Blender"},
    Choice{VolumeUp::y, "y",
           "the file's y is up, as in Houdini: the cloud's x, y and z are its x, -z and y"},
};
constexpr std::array volume_wrap_choices = {
    Choice{VolumeWrap::empty, "empty", "the file's background, which is 0 for raw and slices"},
    Choice{VolumeWrap::repeat, "repeat", "along x and y the volume again; above and below, empty"},
};
constexpr std::array volume_not_finite_choices = {
    Choice{NotFinite::refuse, "refuse", "an error that says how many they are and where the first is"},
    Choice{NotFinite::background, "background", "the file's background, 0 for raw and slices"},
};

constexpr std::string_view of_grids[] = {"vdb", "nvdb"};
constexpr std::string_view of_raw[] = {"raw"};
constexpr std::string_view of_slices[] = {"slices"};

const std::array volume_table = {
    VolumeField{{.key = "file",
                 .kind = Kind::text,
                 .required = true,
                 .documentation = "the volume's file, or the name of its slices with their number",
                 .hint = "for example \"cloud.vdb\" or \"slice_%03d.exr\"; relative to the folder "
                         "of the recipe"},
                &VolumeFile::file},
    VolumeField{{.key = "format",
                 .kind = Kind::choice,
                 .choices = volume_format_choices,
                 .fallback = R"("vdb")",
                 .documentation = "what the file is"},
                &VolumeFile::format},
    VolumeField{{.key = "grid",
                 .kind = Kind::text,
                 .documentation = "name of the grid; density by default, or the file's only grid of "
                                  "numbers",
                 .selector = "format",
                 .selected_by = of_grids},
                &VolumeFile::grid},
    VolumeField{{.key = "channel",
                 .kind = Kind::text,
                 .documentation = "channel of the pictures; their first by default",
                 .hint = "for example \"R\"",
                 .selector = "format",
                 .selected_by = of_slices},
                &VolumeFile::channel},
    VolumeField{{.key = "size",
                 .kind = Kind::voxels,
                 .range = volume_voxels_range,
                 .required = true,
                 .documentation = "voxels along the file's x, y and z",
                 .selector = "format",
                 .selected_by = of_raw},
                &VolumeFile::size},
    VolumeField{{.key = "type",
                 .kind = Kind::choice,
                 .choices = volume_type_choices,
                 .fallback = R"("float32")",
                 .documentation = "how a number is stored",
                 .selector = "format",
                 .selected_by = of_raw},
                &VolumeFile::type},
    VolumeField{{.key = "byte_order",
                 .kind = Kind::choice,
                 .choices = volume_byte_order_choices,
                 .fallback = R"("little")",
                 .documentation = "order of the bytes of a number",
                 .selector = "format",
                 .selected_by = of_raw},
                &VolumeFile::byte_order},
    VolumeField{{.key = "axis_order",
                 .kind = Kind::choice,
                 .choices = volume_axis_order_choices,
                 .fallback = R"("xyz")",
                 .documentation = "the axes from the fastest to the slowest",
                 .selector = "format",
                 .selected_by = of_raw},
                &VolumeFile::axis_order},
    VolumeField{{.key = "offset",
                 .kind = Kind::integer,
                 .range = volume_byte_range,
                 .fallback = "0",
                 .documentation = "bytes before the first voxel",
                 .selector = "format",
                 .selected_by = of_raw},
                &VolumeFile::offset},
    VolumeField{{.key = "first_slice",
                 .kind = Kind::integer,
                 .range = volume_slice_range,
                 .fallback = "0",
                 .documentation = "number of the first slice, which is at the file's z = 0",
                 .selector = "format",
                 .selected_by = of_slices},
                &VolumeFile::first_slice},
    VolumeField{{.key = "slices",
                 .kind = Kind::integer,
                 .range = volume_voxels_range,
                 .required = true,
                 .documentation = "number of slices",
                 .hint = "row 0 of a picture is at y = 0",
                 .selector = "format",
                 .selected_by = of_slices},
                &VolumeFile::slices},
    VolumeField{
        {.key = "voxel_size",
         .kind = Kind::lengths,
         .range = volume_edge_range,
         .documentation = "edges of a voxel along the file's x, y and z; an OpenVDB or NanoVDB "
                          "file says them itself, in metres, unless this key replaces them"},
        &VolumeFile::voxel_size},
    VolumeField{{.key = "crop_first",
                 .kind = Kind::voxels,
                 .range = volume_index_range,
                 .documentation = "index of the first voxel that counts, along the file's axes",
                 .exclusive_group = "crop",
                 .exclusive_side = "voxels"},
                &VolumeFile::crop_first},
    VolumeField{{.key = "crop_size",
                 .kind = Kind::voxels,
                 .range = volume_voxels_range,
                 .documentation = "number of voxels that count; by default all of the file's",
                 .hint = "what the crop has beyond the file is background",
                 .exclusive_group = "crop",
                 .exclusive_side = "voxels"},
                &VolumeFile::crop_size},
    VolumeField{{.key = "crop_corner",
                 .kind = Kind::lengths,
                 .range = volume_place_range,
                 .documentation = "lower corner of the part that counts, in the file's space",
                 .hint = "it is rounded to whole voxels",
                 .exclusive_group = "crop",
                 .exclusive_side = "lengths"},
                &VolumeFile::crop_corner},
    VolumeField{{.key = "crop_extent",
                 .kind = Kind::lengths,
                 .range = volume_crop_range,
                 .documentation = "how far the part that counts reaches from its corner",
                 .exclusive_group = "crop",
                 .exclusive_side = "lengths"},
                &VolumeFile::crop_extent},
    VolumeField{{.key = "up_axis",
                 .kind = Kind::choice,
                 .choices = volume_up_choices,
                 .fallback = R"("z")",
                 .documentation = "which of the file's axes points up"},
                &VolumeFile::up_axis},
    VolumeField{{.key = "scale",
                 .kind = Kind::number,
                 .range = volume_scale_range,
                 .fallback = "1",
                 .documentation = "factor from the file's numbers to the cloud's values"},
                &VolumeFile::scale},
    VolumeField{{.key = "wrap",
                 .kind = Kind::choice,
                 .choices = volume_wrap_choices,
                 .fallback = R"("empty")",
                 .documentation = "what voxels at the volume's faces are mixed with",
                 .hint = "the cloud repeats along x and y in any case"},
                &VolumeFile::wrap},
    VolumeField{{.key = "border",
                 .kind = Kind::integer,
                 .range = volume_border_range,
                 .fallback = "0",
                 .documentation = "voxels of background that are added at the four sides",
                 .hint = "they keep the tiles of a cloud apart"},
                &VolumeFile::border},
    VolumeField{{.key = "not_finite",
                 .kind = Kind::choice,
                 .choices = volume_not_finite_choices,
                 .fallback = R"("refuse")",
                 .documentation = "what voxels that are NaN or infinite mean"},
                &VolumeFile::not_finite},
};

}  // namespace

std::span<const VolumeField> volume_fields() { return volume_table; }

}  // namespace skybake::config
