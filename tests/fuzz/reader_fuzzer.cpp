// Readers of files whose code is skybake's own, or stands in front of a library: bin, PNG, DDS, KTX2,
// NanoVDB, vol, npy and TGA. (EXR and VDB are read by OpenEXR and OpenVDB; tests/io damages those.)
//
// An input either is a file, or a list of changes to a file that a writer made. Properties: a reader
// ends; what it calls read has each voxel once, in order; what it refuses has a code and names the
// file.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "bakers/field/block_voxels.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/nvdb/nvdb_source.h"
#include "bakers/io/formats/texture.h"
#include "tests/fuzz/properties.h"
#include "tests/io/open_formats.h"
#include "tests/support/memory_file.h"
#include "tests/support/volumes.h"
#include "tests/support/zipped_nvdb.h"

namespace skybake {
namespace {

using config::FileFormat;
using config::fuzzing::require;
using skybake::testing::MemoryFile;

struct Sample {
    FileFormat format;
    FileShape shape;
    std::string bytes;
};

Sample sample_of(FileFormat format, Baked volume, int levels, bool is_compressed) {
    volume.voxel_size_m = {1, 1, 1};
    volume.ktx2_compression =
        is_compressed ? config::Ktx2Compression::zstd : config::Ktx2Compression::none;
    while (static_cast<int>(volume.levels.size()) < levels) {
        Level level = volume.levels.back();
        level.size = next_mip_size(level.size);
        volume.levels.push_back(std::move(level));
    }
    code_levels(volume);
    const MemoryFile file;
    const auto written =
        format_of(format).write({volume, 0, "{\"name\": \"sample\"}", 1, nullptr}, file.path());
    require(written.value == true, "samples can be written");
    const std::array<int, 3>& size = volume.levels[0].size;
    return {format,
            {size, volume.channel_names.size(), volume.pixel_type, sheet_grid(size, volume), levels,
             texture_parts(volume)},
            file.bytes()};
}

Sample sample_of(FileFormat format, PixelType type, int channels, int levels, bool is_compressed) {
    return sample_of(format, testing::plain_volume({9, 6, 10}, channels, type), levels,
                     is_compressed);
}

Sample zipped_nvdb() {
    Sample sample = sample_of(FileFormat::nvdb, PixelType::float32, 1, 1, false);
    sample.bytes = testing::zipped_nvdb(sample.bytes);
    return sample;
}

Sample cube_of(FileFormat format, bool is_compressed) {
    Baked cube = testing::plain_volume({4, 24, 1}, 3, PixelType::half);
    cube.axes.resize(2);
    cube.mapping = "cube";
    return sample_of(format, std::move(cube), 3, is_compressed);
}

const std::vector<Sample>& samples() {
    static const std::vector<Sample> all = {
        sample_of(FileFormat::bin, PixelType::half, 1, 1, false),
        sample_of(FileFormat::png, PixelType::unorm8, 3, 1, false),
        sample_of(FileFormat::png, PixelType::unorm16, 1, 1, false),
        sample_of(FileFormat::dds, PixelType::half, 3, 3, false),
        sample_of(FileFormat::dds, PixelType::bc4, 1, 2, false),
        sample_of(FileFormat::dds, PixelType::bc6h, 3, 1, false),
        sample_of(FileFormat::ktx2, PixelType::unorm8, 3, 3, false),
        sample_of(FileFormat::ktx2, PixelType::half, 1, 3, true),
        sample_of(FileFormat::ktx2, PixelType::bc6h, 3, 1, true),
        sample_of(FileFormat::nvdb, PixelType::float32, 1, 1, false),
        sample_of(FileFormat::nvdb, PixelType::half, 1, 1, false),
        sample_of(FileFormat::nvdb, PixelType::float32, 3, 1, false),
        sample_of(FileFormat::vol, PixelType::half, 3, 1, false),
        sample_of(FileFormat::npy, PixelType::unorm16, 4, 1, false),
        sample_of(FileFormat::tga, PixelType::unorm8, 4, 1, false),
        sample_of(FileFormat::tga, PixelType::unorm8, 1, 1, false),
        sample_of(FileFormat::tif, PixelType::float32, 3, 1, false),
        sample_of(FileFormat::hdr, PixelType::rgbe, 3, 1, false),
        sample_of(FileFormat::f32, PixelType::float32, 3, 1, false),
        cube_of(FileFormat::dds, false),
        cube_of(FileFormat::ktx2, false),
        cube_of(FileFormat::ktx2, true),
        zipped_nvdb()};
    return all;
}

// Applies changes of twelve bytes each: a place (three bytes), a width (1, 2, 4 or 8; 255 cuts the
// file there) and the new bytes.
std::string changed(std::string bytes, const std::uint8_t* data, std::size_t size) {
    for (constexpr std::size_t each = 12; size >= each; data += each, size -= each) {
        if (bytes.empty()) break;
        const std::size_t place =
            static_cast<std::size_t>(data[0] | data[1] << 8 | data[2] << 16) % bytes.size();
        const std::size_t width = std::size_t{1} << data[3] % 4;
        if (data[3] == 255) {
            bytes.resize(place);
        } else {
            std::memcpy(&bytes[place], data + 4, std::min(width, bytes.size() - place));
        }
    }
    return bytes;
}

void require_located(const std::vector<config::Diagnostic>& diagnostics, const std::string& path) {
    require(!diagnostics.empty(), "what is refused has a diagnostic");
    require(diagnostics[0].code == "E0304" || diagnostics[0].code == "E0300", "its code is known");
    require(diagnostics[0].where.source == path, "it names the file");
}

// A file that is opened as a volume can be read anywhere.
void read_as_volume(const std::string& path) {
    const auto grid = open_nvdb_grid(path, "density", VolumePart::voxels);
    if (!grid.value) return require_located(grid.diagnostics, path);
    const FileVoxels& file = *grid.value;
    std::vector<float> values(9 * 9 * 9);
    for (const int corner : {-5, 0, 3, file.size[0] - 4}) {
        file.voxels->fill({{file.first[0] + corner, file.first[1], file.first[2]}, {9, 9, 9}},
                          {values.data()});
        for (const float value : values) require(value <= file.largest, "no value is above");
    }
}

void read_all(const Sample& sample, const std::string& path) {
    const Format& format = format_of(sample.format);
    if (sample.format == FileFormat::nvdb) read_as_volume(path);
    if (format.inspect != nullptr) {
        const auto facts = skybake::testing::inspect_file(format, path);
        if (!facts.value) require_located(facts.diagnostics, path);
    }
    std::array<int, 3> size = sample.shape.size;
    for (int level = 0; level < sample.shape.levels; ++level, size = next_mip_size(size)) {
        std::int64_t next = 0;
        const auto visit = [&](std::int64_t first, std::int64_t count, const float* values) {
            require(first == next && count > 0, "voxels come in order");
            next += count;
            volatile float last =
                values[static_cast<std::size_t>(count) * sample.shape.channels - 1];
            static_cast<void>(last);
            return true;
        };
        const auto read = skybake::testing::read_file_of(format, path, sample.shape, level, visit);
        if (!read.value) require_located(read.diagnostics, path);
        if (read.value == true) require(next == (VoxelBox{{}, size}.count()), "each voxel comes");
    }
}

}  // namespace
}  // namespace skybake

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skybake;
    if (size < 2) return 0;
    static const MemoryFile file;
    const Sample& sample = samples()[data[0] % samples().size()];
    const bool is_whole = data[1] % 4 == 0;
    file.assign(is_whole ? std::string(reinterpret_cast<const char*>(data + 2), size - 2)
                         : changed(sample.bytes, data + 2, size - 2));
    read_all(sample, file.path());
    return 0;
}
