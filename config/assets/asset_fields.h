// This header describes the keys that the bake sections of several assets share, and the keys of
// the files that an asset is written to.
//
// This header describes the keys of the droplets of clouds, which assets of a cloud's light share.
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
#include "config/sections/scene.h"
#include "config/sections/targets.h"

namespace skybake::config {

// These keys are shared by several bake sections. They are described once here, for all field
// tables.
inline constexpr Field asset_field =
    key("asset", Kind::text, "asset to bake; by default the one that the section's name says");

inline constexpr Choice orders_choices[] = {
    {SkyOrders::all, "all", "all light"},
    {SkyOrders::single, "single", "sunlight scattered once, in the air"},
    {SkyOrders::multiple, "multiple",
     "the rest: scattered more than once, or reflected by the ground"},
};
inline constexpr Field orders_field =
    key("orders", Kind::choice, "which orders of scattering; single and multiple add up to all",
        orders_choices, Default{R"("all")"});

inline constexpr Field layers_field = key(
    "layers", Kind::text_list,
    "layers of the atmosphere that scatter; by default every one, and all of them always attenuate",
    Hint{"for example [\"aerosol\"]"}, When{"orders", "single"});

inline constexpr Choice sun_mapping_choices[] = {
    {MultipleScatteringMapping::hillaire, "hillaire",
     "linear in sun cosine and altitude, with end points on texel centres"},
    {MultipleScatteringMapping::twilight, "twilight", "more texels near sunrise and sunset"},
};

inline constexpr Field camera_altitude_field =
    key("altitude", Kind::length, "altitude of the camera, which may be in space",
        camera_altitude_range, Default{R"("0 km")"},
        Hint{"below 0, as at the Dead Sea: a ground_radius that is smaller by the depth, from "
             "which altitudes count"});

inline constexpr Field max_error_field =
    key("max_error", Kind::fraction,
        "in place of size, asks for the smallest table whose lookups are within this error",
        lookup_error_range, Hint{"errors below 0.01 are invisible"}, Exclusive{"size"});

// These are the keys of an asset's files (AssetFiles). They are described once here, for the field
// tables of all bakes.

inline constexpr auto format_choices = []<std::size_t... i>(std::index_sequence<i...>) {
    return std::array{
        Choice{file_formats[i].format, file_formats[i].name, file_formats[i].description}...};
}
(std::make_index_sequence<file_formats.size()>());
inline constexpr Choice pixel_type_choices[] = {
    {PixelType::float32, "float", "32 bits per channel"},
    {PixelType::half, "half", "16 bits per channel: 3 digits, 6e-8 to 65504"},
    {PixelType::unorm8, "unorm8",
     "8 bits per channel for 0 to 1; bin, dds, ktx2, npy, png and tga"},
    {PixelType::unorm16, "unorm16", "16 bits per channel for 0 to 1; bin, dds, ktx2, npy and png"},
    {PixelType::bc4, "bc4", "BC4: 4 bits per texel of one channel, 0 to 1; dds and ktx2"},
    {PixelType::bc6h, "bc6h", "BC6H: 8 bits per texel of R G B, half; dds and ktx2"},
    {PixelType::rgbe, "rgbe", "8 bits of each of R G B, with one exponent for the three; hdr"},
};
inline constexpr Choice layout_choices[] = {
    {SheetLayout::stack, "stack", "slices below each other, slice 0 first"},
    {SheetLayout::atlas, "atlas", "slices in rows from the left, rows from the top"},
};
inline constexpr Choice vdb_compression_choices[] = {
    {VdbCompression::none, "none", "no compression"},
    {VdbCompression::zip, "zip", "deflate"},
    {VdbCompression::blosc, "blosc", "Blosc with LZ4: fast"},
};
inline constexpr Choice ktx2_compression_choices[] = {
    {Ktx2Compression::none, "none", "no compression"},
    {Ktx2Compression::zstd, "zstd", "Zstandard, which loaders undo"},
};

inline constexpr Choice compression_choices[] = {
    {Compression::none, "none", "no compression"},
    {Compression::zip, "zip", "deflate, 16 lines at a time"},
    {Compression::zips, "zips", "deflate, line by line"},
    {Compression::piz, "piz", "wavelet, lossless; best for noise"},
};

// The keys of files have a few defaults and texts that differ between assets. This struct holds
// them.
struct FileWords {
    std::string_view formats = R"(["exr"])";  // the default
    std::string_view mips = "number of levels of detail, with the first";
    std::string_view pixel_type = R"("half")";  // the default
    std::string_view flip = "false";            // the default; empty if other keys decide it
    std::string_view layout = R"("stack")";     // the default
    bool dithers = false;                       // whether the key `dither` is offered
};

inline constexpr FileWords table_files = {.pixel_type = R"("float")", .dithers = true};

inline constexpr Range frame_range{1, 100000};

// Returns the row of `asset`, a section's own rows, and those of LightFiles, VolumeFrames and AssetFiles.
template <class S, std::size_t count>
std::vector<Row<S>> with_file_fields(const Row<S> (&own)[count], const FileWords& words) {
    std::vector<Row<S>> rows = {{asset_field, {}}};
    rows.insert(rows.end(), std::begin(own), std::end(own));
    if constexpr (std::is_base_of_v<LightFiles, S>) {
        rows.push_back({"packet", Kind::integer, &LightFiles::packet,
                        "which four of the wavelengths the channels are; without it, of more than "
                        "four, assets NAME_1, NAME_2 ... hold all",
                        Range{1, most_wavelengths / wavelengths_per_packet}});
    }
    if constexpr (std::is_base_of_v<VolumeFrames, S>) {
        rows.push_back({"frames", Kind::integer, &VolumeFrames::frames,
                        "number of frames in time: assets NAME_0001, NAME_0002 ... are one each, "
                        "from the `time` of the noise or the cloud on",
                        frame_range, Hint{"the `period` of the noise or the cloud makes a loop"},
                        Role::files});
        rows.push_back({"frames_per_second", Kind::number, &VolumeFrames::frames_per_second,
                        "how fast the USD scene plays the frames", Range{0.001, 1000},
                        Default{"24"}, Needs{"frames"}, Role::files});
        rows.push_back({"frame", Kind::integer, &VolumeFrames::frame,
                        "which frame alone, counted from 1", frame_range});
    }
    const Row<S> file_rows[] = {
        {"target", Kind::choice, &AssetFiles::target,
         "the program that the files are for; it decides the keys below that the section leaves "
         "out, and adds the program's own files",
         target_choices(), Role::files},
        {"formats", Kind::choice_list, &AssetFiles::formats, "files to write, NAME.exr and so on",
         format_choices, Default{words.formats}, Role::files},
        {"pixel_type", Kind::choice, &AssetFiles::pixel_type, "type of the numbers in the files",
         pixel_type_choices, Default{words.pixel_type}},
        {"layout", Kind::choice, &AssetFiles::layout,
         "where the slices lie in EXR, PNG and TGA images; by default an atlas where a stack would "
         "have more than 16384 rows",
         layout_choices, Default{words.layout}, Role::files},
        {"columns", Kind::integer, &AssetFiles::columns,
         "slices in a row of the atlas; by default a divisor of the slices, near to a square",
         Range{1, 16384}, When{"layout", "atlas"}, Role::files},
        {"flip", Kind::flag, &AssetFiles::flip,
         "whether EXR, PNG, TGA and HDR images are upside down, for readers that take the lower "
         "left texel for the first",
         Default{words.flip}, Role::files},
        {"mips", Kind::levels, &AssetFiles::mips, words.mips, Range{1, 15}, Default{"1"},
         Hint{"\"all\" goes down to one voxel, or as far as cells and faces halve"}, Role::files},
        {"compression", Kind::choice, &AssetFiles::compression,
         "compression of the EXR file, always lossless", compression_choices, Default{R"("zip")"},
         Role::files},
        {"vdb_compression", Kind::choice, &AssetFiles::vdb_compression,
         "compression of the VDB file, always lossless", vdb_compression_choices,
         Default{R"("blosc")"}, Role::files},
        {"ktx2_compression", Kind::choice, &AssetFiles::ktx2_compression,
         "compression of the KTX2 file, always lossless", ktx2_compression_choices,
         Default{R"("zstd")"}, Role::files},
    };
    rows.insert(rows.end(), std::begin(file_rows), std::end(file_rows));
    if (words.dithers) {
        rows.push_back({"dither", Kind::flag, &AssetFiles::dither,
                        "whether neighbours are rounded up and down by turns, so that gradients "
                        "show no bands; texels are then off by up to a step",
                        When{"pixel_type", {"unorm8", "unorm16"}}});
    }
    return rows;
}

// The lookups have the harmonics up to this degree.
inline constexpr Range harmonics_degree_range{0, 3};

// Returns a shared key for a section where it applies under a condition.
constexpr Field with(Field field, const When& when) {
    say(field, when);
    return field;
}

// The fit of the droplets' phase function holds from 5 to 50 um.
inline constexpr Range droplet_range{5e-6, 50e-6};
inline constexpr Field droplet_diameter_field =
    key("droplet_diameter", Kind::length,
        "diameter of the droplets, which chooses their phase function", droplet_range,
        Default{R"("12 um")"}, Hint{"clouds have 8 to 30 um; it says nothing of ice"},
        Cited{"Jendersie & d'Eon 2023, \"An Approximate Mie Scattering Function for Fog and Cloud "
              "Rendering\""});

inline constexpr Field single_scattering_albedo_field =
    key("single_scattering_albedo", Kind::number, "share of the extinction that is scattering",
        Range{1e-6, 1}, Default{"1"}, Hint{"droplets in visible light have 1"});

}  // namespace skybake::config
