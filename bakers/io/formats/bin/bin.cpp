// Assets as files of bare texels: little-endian, without a header, x fastest, then y, then z,
// channels interleaved. The manifest says what they mean. Values are float, half, unorm8 (v * 255)
// or unorm16 (v * 65535), rounded to nearest.
#include <fmt/format.h>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "config/sections/file_formats.h"

namespace skybake {
namespace {

config::Outcome<bool> write_bin_file(const FileContent& content,
                                     const std::filesystem::path& path) {
    FileOutput output(path);
    const bool complete = write_texels(content, content.level, texel_sink(output));
    return output.finished(complete);
}

config::Outcome<bool> read_bin_file(FileInput& file, const FileShape& shape, int,
                                    const VoxelVisitor& visit) {
    const StoredTexelRange texels = {shape.size, shape.channels, shape.channels, shape.pixel_type};
    if (file.size() != texels.bytes()) {
        const std::string path = file.path().string();
        return file_error(
            "E0304", path,
            fmt::format("`{}` has {} bytes, but {} x {} x {} voxels take {}", path, file.size(),
                        shape.size[0], shape.size[1], shape.size[2], texels.bytes()));
    }
    return read_texels(texel_input(file, 0), texels, visit);
}

}  // namespace

Format bin_format() {
    return {.format = config::FileFormat::bin,
            .has_metadata = false,
            .write = write_bin_file,
            .inspect = nullptr,
            .read = read_bin_file};
}

}  // namespace skybake
