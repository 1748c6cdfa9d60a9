#include "config/sections/volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/sections.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

VolumeProbe the_probe = nullptr;

// Reports one of two keys that need each other.
void check_pair(const DecodedSection& section, std::string_view first, std::string_view second,
                Decoder& decoder) {
    if (section.gives(first) == section.gives(second) || !decoder.complete) return;
    if (!section.gives(first)) std::swap(first, second);
    decoder.report("E0105", section, first, fmt::format("needs {} beside it", second),
                   fmt::format("give {}, or leave both out", second));
}

// Each length is above 0, where the key is given at all.
void check_positive(const DecodedSection& section, std::string_view key, Decoder& decoder) {
    const auto* lengths = section.value<std::array<double, 3>>(key);
    if (!lengths || std::ranges::all_of(*lengths, [](double meters) { return meters > 0; })) return;
    decoder.report("E0110", section, key, "has a length that is not above 0",
                   "give three lengths above 0");
}

void check_keys(const DecodedSection& section, VolumeFormat format, Decoder& decoder) {
    check_pair(section, "crop_first", "crop_size", decoder);
    check_pair(section, "crop_corner", "crop_extent", decoder);
    check_positive(section, "voxel_size", decoder);
    check_positive(section, "crop_extent", decoder);
    const bool says_size = format != VolumeFormat::raw || section.gives("voxel_size");
    if (says_size || !decoder.complete) return;
    decoder.report("E0105", section, "voxel_size",
                   "is missing: these files do not say how large a voxel is",
                   "give three lengths, such as [\"10 m\", \"10 m\", \"10 m\"]");
}

constexpr Choice volume_format_choices[] = {
    {VolumeFormat::vdb, "vdb", "an OpenVDB file with a grid of float, double, int32 or int64"},
    {VolumeFormat::nvdb, "nvdb", "a NanoVDB file with a grid of type Float, Fp8 or Fp16"},
    {VolumeFormat::raw, "raw", "numbers alone, whose layout the section gives"},
};
constexpr Choice volume_type_choices[] = {
    {PixelType::float32, "float32", "32-bit floats"},
    {PixelType::half, "half", "16-bit floats"},
    {PixelType::unorm8, "unorm8", "bytes, of which 255 is 1"},
    {PixelType::unorm16, "unorm16", "16-bit integers, of which 65535 is 1"},
};
constexpr Choice volume_byte_order_choices[] = {
    {ByteOrder::little, "little", "the lowest byte first"},
    {ByteOrder::big, "big", "the highest byte first"},
};
constexpr Choice volume_axis_order_choices[] = {
    {AxisOrder::xyz, "xyz", "x runs fastest, z slowest"},
    {AxisOrder::xzy, "xzy", "x runs fastest, y slowest"},
    {AxisOrder::yxz, "yxz", "y runs fastest, z slowest"},
    {AxisOrder::yzx, "yzx", "y runs fastest, x slowest"},
    {AxisOrder::zxy, "zxy", "z runs fastest, y slowest"},
    {AxisOrder::zyx, "zyx", "z runs fastest, x slowest, as in OpenVDB's leaves"},
};
constexpr Choice volume_up_choices[] = {
    {VolumeUp::z, "z", "the file's z is up, as in Blender"},
    {VolumeUp::y, "y",
     "the file's y is up, as in Houdini: the cloud's x, y and z are its x, -z and y"},
};
constexpr Choice volume_wrap_choices[] = {
    {VolumeWrap::empty, "empty", "the file's background, which is 0 for raw"},
    {VolumeWrap::repeat, "repeat", "along x and y the volume again; above and below, empty"},
};
constexpr Choice volume_not_finite_choices[] = {
    {NotFinite::refuse, "refuse", "an error that says how many they are and where the first is"},
    {NotFinite::background, "background", "the file's background, 0 for raw"},
};

const Row<VolumeFile> volume_table[] = {
    {"file", Kind::text, &VolumeFile::file, "the volume's file", KeyFlag::required,
     Hint{"for example \"cloud.vdb\"; relative to the folder of the recipe"}},
    {"format", Kind::choice, &VolumeFile::format, "what the file is", volume_format_choices,
     Default{R"("vdb")"}},
    {"grid", Kind::text, &VolumeFile::grid,
     "name of the grid; density by default, or the file's only grid of numbers",
     When{"format", {"vdb", "nvdb"}}},
    {"size", Kind::voxels, &VolumeFile::size, "voxels along the file's x, y and z", texel_range,
     KeyFlag::required, When{"format", "raw"}},
    {"type", Kind::choice, &VolumeFile::type, "how a number is stored", volume_type_choices,
     Default{R"("float32")"}, When{"format", "raw"}},
    {"byte_order", Kind::choice, &VolumeFile::byte_order, "order of the bytes of a number",
     volume_byte_order_choices, Default{R"("little")"}, When{"format", "raw"}},
    {"axis_order", Kind::choice, &VolumeFile::axis_order,
     "the axes from the fastest to the slowest", volume_axis_order_choices, Default{R"("xyz")"},
     When{"format", "raw"}},
    {"offset", Kind::integer, &VolumeFile::offset, "bytes before the first voxel",
     Range{0, 2147483647}, Default{"0"}, When{"format", "raw"}},
    {"voxel_size", Kind::lengths, &VolumeFile::voxel_size,
     "edges of a voxel along the file's x, y and z; an OpenVDB or NanoVDB file says them itself, "
     "in metres, unless this key replaces them",
     Range{1e-6, 1e8}},
    {"crop_first", Kind::voxels, &VolumeFile::crop_first,
     "index of the first voxel that counts, along the file's axes", Range{-1e6, 1e6},
     Exclusive{"crop", "voxels"}},
    {"crop_size", Kind::voxels, &VolumeFile::crop_size,
     "number of voxels that count; by default all of the file's", texel_range,
     Hint{"what the crop has beyond the file is background"}, Exclusive{"crop", "voxels"}},
    {"crop_corner", Kind::lengths, &VolumeFile::crop_corner,
     "lower corner of the part that counts, in the file's space", Range{-1e9, 1e9},
     Hint{"it is rounded to whole voxels"}, Exclusive{"crop", "lengths"}},
    {"crop_extent", Kind::lengths, &VolumeFile::crop_extent,
     "how far the part that counts reaches from its corner", Range{1e-6, 1e9},
     Exclusive{"crop", "lengths"}},
    {"up_axis", Kind::choice, &VolumeFile::up_axis, "which of the file's axes points up",
     volume_up_choices, Default{R"("z")"}},
    {"scale", Kind::number, &VolumeFile::scale,
     "factor from the file's numbers to the cloud's values", Range{1e-9, 1e9}, Default{"1"}},
    {"wrap", Kind::choice, &VolumeFile::wrap, "what voxels at the volume's faces are mixed with",
     volume_wrap_choices, Default{R"("empty")"},
     Hint{"the cloud repeats along x and y in any case"}},
    {"border", Kind::integer, &VolumeFile::border,
     "voxels of background that are added at the four sides", Range{0, 4096}, Default{"0"},
     Hint{"they keep the tiles of a cloud apart"}},
    {"not_finite", Kind::choice, &VolumeFile::not_finite,
     "what voxels that are NaN or infinite mean", volume_not_finite_choices,
     Default{R"("refuse")"}},
};

}  // namespace

void set_volume_probe(VolumeProbe probe) { the_probe = probe; }

VolumeProbe volume_probe() { return the_probe; }

std::filesystem::path path_of_file(const DecodedSection& section, std::string_view what,
                                   Decoder& decoder) {
    const auto* name = section.value<std::string>("file");
    if (!name) return {};
    if (name->empty()) {
        decoder.report("E0110", section, "file", "is empty",
                       fmt::format("give the name of {}", what));
        return {};
    }
    return (section.place_of("file").source->folder / *name).lexically_normal();
}

VolumeFile decode_volume(const Entry& entry, Decoder& decoder) {
    VolumeFile volume;
    volume.name = entry.key;
    const DecodedSection section =
        decode_into(volume, volume_fields(), "volumes.*", join_path("volumes", entry.key),
                    entry.key_place, *as_table(entry.value), decoder);
    volume.path = path_of_file(section, "a volume's file", decoder);
    if (!volume.path.empty()) volume.file_place = source_range(section.place_of("file"));
    check_keys(section, volume.format, decoder);
    return volume;
}

std::span<const Row<VolumeFile>> volume_fields() { return volume_table; }

}  // namespace skybake::config
