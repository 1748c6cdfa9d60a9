// Volumes as grids of Mitsuba's plug-in `gridvolume`: a head of 48 bytes, then floats, x fastest, then
// y, then z, channels interleaved. Halves are stored as floats, which hold them exactly.
//
// The bounds in the head are those of the volume in metres, from the outer face of the first voxel
// to that of the last along each axis; of noise, which lies nowhere, from 0 to 1. The plug-in reads
// them with `use_grid_bbox`. It takes one, three or six channels, or with `raw` any number. The
// format has no place for metadata; the manifest says what the file means.
//
// Source: Mitsuba 3, "Grid-based volume data source (gridvolume)".
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little,
              "headers are stored as they lie in memory");

struct VolHeader {
    std::array<char, 3> magic = {'V', 'O', 'L'};
    std::uint8_t version = 3;
    std::int32_t encoding = 1;  // float
    std::array<std::int32_t, 3> size{};
    std::int32_t channels = 0;
    std::array<float, 3> first{};  // the bounds
    std::array<float, 3> last{};
};
static_assert(sizeof(VolHeader) == 48);

VolHeader vol_header(const std::array<int, 3>& size, std::size_t channels) {
    VolHeader header;
    header.size = size;
    header.channels = static_cast<std::int32_t>(channels);
    return header;
}

Outcome<bool> write_vol_file(const FileContent& content, const fs::path& path) {
    const Baked& volume = content.baked;
    const Level& level = volume.levels[static_cast<std::size_t>(content.level)];
    VolHeader header = vol_header(level.size, volume.channel_names.size());
    const bool has_place = volume.voxel_size_m[0] > 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double length = volume.voxel_size_m[a] * volume.levels.front().size[a];
        header.first[a] = has_place ? static_cast<float>(volume.minimum_m[a]) : 0;
        header.last[a] = has_place ? static_cast<float>(volume.minimum_m[a] + length) : 1;
    }
    FileOutput output(path);
    output.write({reinterpret_cast<const char*>(&header), sizeof header});
    std::string floats;
    const bool complete =
        write_texels(content, content.level, [&](std::string_view texels) {
            const auto bytes = bytes_per_value(volume.pixel_type);
            const std::size_t count = texels.size() / bytes;
            floats.resize(count * sizeof(float));
            load_values(texels.data(), count, volume.pixel_type,
                        reinterpret_cast<float*>(floats.data()));
            output.write(floats);
            return output.error() == 0;
        });
    return output.finished(complete);
}

config::Diagnostic damaged_vol_file(const FileInput& file, const std::string& reason) {
    const std::string path = file.path().string();
    return file_error(
        "E0304", path,
        fmt::format("skybake cannot read `{}` as a grid volume of Mitsuba: {}", path, reason));
}

Outcome<VolHeader> read_vol_header(FileInput& file) {
    VolHeader header;
    const auto done = file.read(0, reinterpret_cast<char*>(&header), sizeof header);
    if (!done) return file.diagnostic();
    if (*done < sizeof header) return damaged_vol_file(file, "it ends within its head");
    if (header.magic != VolHeader{}.magic || header.version != VolHeader{}.version) {
        return damaged_vol_file(file, "it does not begin with `VOL` and version 3");
    }
    if (header.encoding != VolHeader{}.encoding) {
        return damaged_vol_file(file, fmt::format("its encoding is {}", header.encoding));
    }
    for (std::size_t a = 0; a < 3; ++a) {
        if (std::isfinite(header.first[a]) && header.last[a] > header.first[a]) continue;
        return damaged_vol_file(file, "its bounds are empty");
    }
    return {header, {}};
}

Outcome<FileFacts> inspect_vol(FileInput& file) {
    const Outcome<VolHeader> header = read_vol_header(file);
    if (!header.value) return {{}, header.diagnostics};
    FileFacts facts;
    facts.channels = static_cast<std::size_t>(std::max(0, header.value->channels));
    return {std::move(facts), {}};
}

Outcome<bool> read_vol_file(FileInput& file, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    const Outcome<VolHeader> header = read_vol_header(file);
    if (!header.value) return {{}, header.diagnostics};
    const VolHeader wanted = vol_header(shape.size, shape.channels);
    const StoredTexelRange texels = {shape.size, shape.channels, shape.channels,
                                     config::PixelType::float32};
    if (header.value->size != wanted.size || header.value->channels != wanted.channels ||
        file.size() != sizeof(VolHeader) + texels.bytes()) {
        return other_size(file.path());
    }
    return read_texels(texel_input(file, sizeof(VolHeader)), texels, visit);
}

}  // namespace

Format vol_format() {
    return {.format = config::FileFormat::vol,
            .has_metadata = false,
            .write = write_vol_file,
            .inspect = inspect_vol,
            .read = read_vol_file};
}

}  // namespace skybake
