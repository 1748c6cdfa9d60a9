#include "bakers/io/formats/usda/usda.h"

#include <fmt/format.h>

#include <string>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/io/formats/volume_camera.h"
#include "config/sections/frames.h"

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

// Returns the names of the VDB files that the scene places, one per frame.
std::vector<std::string> vdb_files(const Baked& volume, const std::string& scene) {
    if (volume.frames == 0) return {file_name(volume.name, config::FileFormat::vdb, 0)};
    std::vector<std::string> files;
    for (int frame = 1; frame <= volume.frames; ++frame) {
        const std::string name = config::frame_name(scene, frame, volume.frames);
        files.push_back(file_name(name, config::FileFormat::vdb, 0));
    }
    return files;
}

std::string header(const Baked& volume, const std::string& prim) {
    std::string text = fmt::format("#usda 1.0\n(\n    defaultPrim = \"{}\"\n", prim);
    const bool plays = volume.frames > 0;
    if (plays) text += fmt::format("    endTimeCode = {}\n", volume.frames);
    if (plays) text += fmt::format("    framesPerSecond = {}\n", volume.frames_per_second);
    text += "    metersPerUnit = 1\n";
    if (plays) text += "    startTimeCode = 1\n";
    if (plays) text += fmt::format("    timeCodesPerSecond = {}\n", volume.frames_per_second);
    return text +
           fmt::format("    upAxis = \"{}\"\n)\n\n", volume.up_axis.ends_with("y") ? "Y" : "Z");
}

// The files are those of the time codes 1, 2 ..., if there are several.
std::string file_path(const std::vector<std::string>& files, bool plays) {
    std::string text = fmt::format("        asset filePath = @./{}@\n", files.front());
    if (!plays) return text;
    text += "        asset filePath.timeSamples = {\n";
    for (std::size_t i = 0; i < files.size(); ++i) {
        text += fmt::format("            {}: @./{}@,\n", i + 1, files[i]);
    }
    return text + "        }\n";
}

// A camera beside the volume. A scene that refers to this one takes the volume alone.
std::string camera_text(const Baked& volume) {
    const VolumeCamera camera = volume_camera(volume);
    return fmt::format(
        "\ndef Camera \"camera\"\n{{\n    float2 clippingRange = (1, {:.7g})\n"
        "    float focalLength = {}\n    float horizontalAperture = {}\n"
        "    float verticalAperture = {}\n    matrix4d xformOp:transform = {}\n"
        "    uniform token[] xformOpOrder = [\"xformOp:transform\"]\n}}\n",
        camera.reach_m, camera_focal_length_mm, camera_width_mm, camera_height_mm,
        usd_matrix(camera.axes, camera.position_m));
}

std::string usd_scene(const Baked& volume) {
    const std::string scene = volume.frames > 0 ? config::sequence_name(volume.name) : volume.name;
    const std::string prim = usd_identifier(scene);
    std::array<double, 3> last;
    for (std::size_t a = 0; a < 3; ++a) {
        last[a] = volume.minimum_m[a] + volume.voxel_size_m[a] * volume.levels.front().size[a];
    }
    std::string text = header(volume, prim) +
                       fmt::format("def Volume \"{}\"\n{{\n    float3[] extent = [{}, {}]\n", prim,
                                   point_text(volume.minimum_m), point_text(last));
    const std::vector<VdbGridChannels> grids = vdb_grids(volume);
    for (const VdbGridChannels& grid : grids) {
        text += fmt::format("    rel field:{0} = </{1}/{0}>\n", usd_identifier(grid.name), prim);
    }
    const std::string path = file_path(vdb_files(volume, scene), volume.frames > 0);
    const std::string number = volume.pixel_type == config::PixelType::half ? "half" : "float";
    for (const VdbGridChannels& grid : grids) {
        const bool is_vector = grid.count > 1;
        text += fmt::format(
            "\n    def OpenVDBAsset \"{}\"\n    {{\n{}"
            "        token fieldName = \"{}\"\n        token fieldClass = \"{}\"\n"
            "        token fieldDataType = \"{}\"\n{}    }}\n",
            usd_identifier(grid.name), path, grid.name, is_vector ? "unknown" : "fogVolume",
            is_vector ? number + "3" : number,
            is_vector ? "        token vectorDataRoleHint = \"Vector\"\n" : "");
    }
    text += "}\n";
    return volume.up_axis == "+z" ? text + camera_text(volume) : text;
}

config::Outcome<bool> write_usda_file(const FileContent& content,
                                      const std::filesystem::path& path) {
    FileOutput output(path);
    output.write(usd_scene(content.baked));
    return output.finished(true);
}

}  // namespace

std::string usd_matrix(const glm::dmat3& axes, const glm::dvec3& place) {
    const auto row = [](const glm::dvec3& v, int last) {
        return fmt::format("({:.7g}, {:.7g}, {:.7g}, {})", v.x, v.y, v.z, last);
    };
    return fmt::format("({}, {}, {}, {})", row(axes[0], 0), row(axes[1], 0), row(axes[2], 0),
                       row(place, 1));
}

Format usda_format() {
    return {.format = config::FileFormat::usda,
            .has_metadata = false,
            .write = write_usda_file,
            .inspect = nullptr,
            .read = nullptr};
}

}  // namespace skybake
