#include "bakers/io/formats/format.h"

#include <fmt/format.h>

#include <algorithm>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/take_boxes.h"
#include "bakers/math/memory.h"

namespace skybake {

std::span<const Format> formats() {
    static const std::array all = {exr_format(), vdb_format(),  bin_format(),  png_format(),
                                   dds_format(), ktx2_format(), nvdb_format(), vol_format(),
                                   npy_format(), tga_format(),  usda_format(), tif_format(),
                                   f32_format(), hdr_format()};
    return all;
}

const Format& format_of(config::FileFormat format) {
    return *std::ranges::find(formats(), format, &Format::format);
}

const Format* find_format(std::string_view word) {
    for (const Format& row : formats()) {
        if (config::facts_of(row.format).name == word) return &row;
    }
    return nullptr;
}

std::optional<std::string> file_part(FileInput& file, std::uint64_t offset, std::size_t count) {
    if (offset > file.size() || count > file.size() - offset) return std::nullopt;
    std::string part(count, '\0');
    const auto done = file.read(offset, part.data(), count);
    if (!done || *done < count) return std::nullopt;
    return part;
}

config::Diagnostic damaged_file(const std::filesystem::path& path, const char* format,
                                const std::string& reason) {
    return file_error(
        "E0304", path.string(),
        fmt::format("skybake cannot read `{}` as a {} file: {}", path.string(), format, reason));
}

config::Diagnostic other_size(const std::filesystem::path& path) {
    return file_error("E0304", path.string(),
                      fmt::format("`{}` is not of the size that its manifest says", path.string()));
}

config::Diagnostic contradiction(const std::filesystem::path& path, const std::string& what) {
    return file_error("E0500", path.string(), what);
}

namespace {

struct Slot {
    AlignedFloats values;  // of one part, channel after channel
    std::string bytes;     // of a box, channels interleaved
};

// The floats of a part of a box. They stay in a processor's cache until they are converted.
constexpr std::int64_t floats_per_part = 1 << 17;

// Calls `work` with the parts of a box, which are rows of one slice, in the order of voxels.
template <class Work>
void for_each_part(const VoxelBox& box, std::size_t channels, const Work& work) {
    const std::int64_t row = box.size[0] * static_cast<std::int64_t>(channels);
    const auto rows =
        static_cast<int>(std::clamp<std::int64_t>(floats_per_part / row, 1, box.size[1]));
    for (int z = 0; z < box.size[2]; ++z) {
        for (int y = 0; y < box.size[1]; y += rows) {
            work(VoxelBox{{box.origin[0], box.origin[1] + y, box.origin[2] + z},
                          {box.size[0], std::min(rows, box.size[1] - y), 1}});
        }
    }
}

void make(const Level& level, std::size_t channels, std::size_t stored_channels,
          config::PixelType type, const VoxelBox& box, Slot& slot) {
    const std::size_t texel = stored_channels * bytes_per_value(type);
    slot.bytes.resize(static_cast<std::size_t>(box.count()) * texel);
    char* to = slot.bytes.data();
    for_each_part(box, stored_channels, [&](const VoxelBox& part) {
        const auto count = static_cast<std::size_t>(part.count());
        slot.values.resize(count * stored_channels);
        std::vector<float*> planes;
        for (std::size_t c = 0; c < stored_channels; ++c) planes.push_back(&slot.values[c * count]);
        level.voxels->fill(part, {planes.begin(), planes.begin() + static_cast<long>(channels)});
        for (std::size_t c = channels; c < stored_channels; ++c) {
            std::fill_n(planes[c], count, 1.0F);
        }
        store_voxels({planes.begin(), planes.end()}, count, type, to);
        to += count * texel;
    });
}

// Drops the stored channels that nobody asked for.
void drop_padding(const std::vector<float>& stored, const StoredTexelRange& texels,
                  std::vector<float>& values) {
    const std::size_t count = stored.size() / texels.stored_channels;
    values.resize(count * texels.channels);
    for (std::size_t i = 0; i < count; ++i) {
        std::copy_n(&stored[i * texels.stored_channels], texels.channels,
                    &values[i * texels.channels]);
    }
}

}  // namespace

bool write_texels(const FileContent& content, int level_number, const TexelSink& put, bool pads) {
    const Level& level = content.baked.levels[static_cast<std::size_t>(level_number)];
    const std::size_t channels = content.baked.channel_names.size();
    const std::size_t stored = pads && channels == 3 ? 4 : channels;
    const BoxSequence boxes(level.size, static_cast<int>(channels));
    return write_boxes<Slot>(
        boxes.count(), content.threads, content.progress,
        [&](int i, Slot& slot) {
            make(level, channels, stored, content.baked.pixel_type, boxes[i], slot);
        },
        [&](int, const Slot& slot) { return put(slot.bytes); });
}

TexelSink texel_sink(FileOutput& output) {
    return [&output](std::string_view bytes) {
        output.write(bytes);
        return output.error() == 0;
    };
}

std::uint64_t StoredTexelRange::bytes() const {
    return static_cast<std::uint64_t>(VoxelBox{{}, size}.count()) * stored_channels *
           bytes_per_value(type);
}

config::Outcome<bool> read_texels(const TexelInput& next, const StoredTexelRange& texels,
                                  const VoxelVisitor& visit) {
    const std::int64_t voxels = VoxelBox{{}, texels.size}.count();
    const auto stored = static_cast<std::int64_t>(texels.stored_channels);
    const std::int64_t most = std::max<std::int64_t>(1, (std::int64_t{1} << 20) / stored);
    const std::size_t voxel_bytes = texels.stored_channels * bytes_per_value(texels.type);
    std::string bytes;
    std::vector<float> values;
    std::vector<float> wanted;
    std::int64_t count = 0;
    for (std::int64_t first = 0; first < voxels; first += count) {
        count = std::min(most, voxels - first);
        bytes.resize(static_cast<std::size_t>(count) * voxel_bytes);
        values.resize(static_cast<std::size_t>(count * stored));
        if (const auto problem = next(bytes.data(), bytes.size())) return *problem;
        load_values(bytes.data(), values.size(), texels.type, values.data());
        const bool padded = texels.channels != texels.stored_channels;
        if (padded) drop_padding(values, texels, wanted);
        if (!visit(first, count, padded ? wanted.data() : values.data())) return {false, {}};
    }
    return {true, {}};
}

TexelInput texel_input(FileInput& file, std::uint64_t offset) {
    return [&file, offset](char* bytes,
                           std::size_t count) mutable -> std::optional<config::Diagnostic> {
        const auto done = file.read(offset, bytes, count);
        offset += count;
        if (done && *done == count) return std::nullopt;
        return file.diagnostic();
    };
}

}  // namespace skybake
