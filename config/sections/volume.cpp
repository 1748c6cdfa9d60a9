#include "config/sections/volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "config/fields/section_decoder.h"
#include "config/sections/sections.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

VolumeProbe the_probe = nullptr;

// This is one volume while its keys are checked.
struct VolumeDecoder {
    const DecodedSection& section;
    VolumeFile& volume;
    Decoder& decoder;

    bool gives(std::string_view key) const { return section.at(key).source != nullptr; }

    // Files are looked for where includes are: in the folder of the recipe that names them.
    void resolve_path() const {
        const DecodedField& file = section.at("file");
        if (!file.source || !file.value) return;
        if (volume.file.empty()) {
            return decoder.report("E0110", section, "file", "is empty",
                                  "give the name of a volume's file");
        }
        const Source* source = file.source->place.source;
        const std::filesystem::path folder = source ? source->folder : std::filesystem::path();
        volume.file_place = source_range(file.source->place);
        volume.path = (folder / volume.file).lexically_normal();
    }

    void check_pair(std::string_view first, std::string_view second) const {
        if (gives(first) == gives(second) || !decoder.complete) return;
        const std::string_view missing = gives(first) ? second : first;
        decoder.report("E0105", section, gives(first) ? first : second,
                       fmt::format("needs {} beside it", missing),
                       fmt::format("give {}, or leave both out", missing));
    }

    // Each length is above 0, where the key is given at all.
    void check_positive(std::string_view key, const std::array<Length, 3>& lengths) const {
        const auto is_positive = [](Length length) { return length.meters > 0; };
        if (!section.at(key).value) return;
        if (std::ranges::all_of(lengths, is_positive)) return;
        decoder.report("E0110", section, key, "has a length that is not above 0",
                       "give three lengths above 0");
    }

    void check_keys() const {
        check_pair("crop_first", "crop_size");
        check_pair("crop_corner", "crop_extent");
        check_positive("voxel_size", volume.voxel_size);
        check_positive("crop_extent", volume.crop_extent);
        const bool is_grid =
            volume.format == VolumeFormat::vdb || volume.format == VolumeFormat::nvdb;
        const bool says_size = is_grid || gives("voxel_size");
        if (says_size || !decoder.complete) return;
        decoder.report("E0105", section, "voxel_size",
                       "is missing: these files do not say how large a voxel is",
                       "give three lengths, such as [\"10 m\", \"10 m\", \"10 m\"]");
    }
};

}  // namespace

void set_volume_probe(VolumeProbe probe) { the_probe = probe; }

VolumeProbe volume_probe() { return the_probe; }

VolumeFile decode_volume(const std::string& name, const Place& place, const Table& table,
                         Place& file_place, Decoder& decoder) {
    const std::string path = join_path("volumes", name);
    VolumeFile volume;
    volume.name = name;
    const DecodedSection section =
        decode_section(*find_section("volumes.*"), path, place, table, Absent::filled_in, decoder);
    append_values(section, decoder);
    bind_section(section, volume_fields(), volume);
    const VolumeDecoder reader{section, volume, decoder};
    reader.resolve_path();
    reader.check_keys();
    file_place = section.place_of("file");
    return volume;
}

}  // namespace skybake::config
