#include "bakers/io/formats/usda/usda.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/formats/vdb/vdb_file.h"

namespace skybake {
namespace {

// Returns the name as USD's identifiers are: letters, digits and underscores, no digit first.
std::string usd_identifier(std::string name) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    for (char& c : name) {
        if (!is_letter(c) && !(c >= '0' && c <= '9')) c = '_';
    }
    return is_letter(name.front()) ? name : "_" + name;
}

// Shortest texts that give the same float, as `extent` is of floats.
std::string point_text(const std::array<double, 3>& point) {
    return fmt::format("({}, {}, {})", static_cast<float>(point[0]), static_cast<float>(point[1]),
                       static_cast<float>(point[2]));
}

std::string usd_scene(const Baked& volume) {
    const std::string prim = usd_identifier(volume.name);
    std::array<double, 3> last;
    for (std::size_t a = 0; a < 3; ++a) {
        last[a] = volume.minimum_m[a] + volume.voxel_size_m[a] * volume.levels.front().size[a];
    }
    std::string text = fmt::format(
        "#usda 1.0\n(\n    defaultPrim = \"{}\"\n    metersPerUnit = 1\n    upAxis = \"{}\"\n)\n\n"
        "def Volume \"{}\"\n{{\n    float3[] extent = [{}, {}]\n",
        prim, volume.up_axis.ends_with("y") ? "Y" : "Z", prim, point_text(volume.minimum_m),
        point_text(last));
    const std::vector<std::string> grids = vdb_grid_names(volume);
    for (const std::string& grid : grids) {
        text += fmt::format("    rel field:{0} = </{1}/{0}>\n", usd_identifier(grid), prim);
    }
    for (const std::string& grid : grids) {
        text += fmt::format(
            "\n    def OpenVDBAsset \"{}\"\n    {{\n        asset filePath = @./{}@\n"
            "        token fieldName = \"{}\"\n        token fieldClass = \"fogVolume\"\n"
            "        token fieldDataType = \"{}\"\n    }}\n",
            usd_identifier(grid), file_name(volume.name, config::FileFormat::vdb, 0), grid,
            volume.pixel_type == config::PixelType::half ? "half" : "float");
    }
    return text + "}\n";
}

config::Outcome<bool> write_usda_file(const FileContent& content,
                                      const std::filesystem::path& path) {
    FileOutput output(path);
    output.write(usd_scene(content.baked));
    if (!output.finish()) return {{}, {output.diagnostic()}};
    return {true, {}};
}

}  // namespace

Format usda_format() {
    return {.format = config::FileFormat::usda,
            .has_metadata = false,
            .write = write_usda_file,
            .inspect = nullptr,
            .read = nullptr};
}

}  // namespace skybake
