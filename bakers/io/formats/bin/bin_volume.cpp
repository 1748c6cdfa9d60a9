#include "bakers/io/formats/bin/bin_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bakers/field/pixel_type.h"
#include "bakers/field/voxel_boxes.h"
#include "bakers/field/voxel_bytes.h"
#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/file_input.h"
#include "bakers/io/files/file_output.h"
#include "bakers/math/aligned_floats.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

struct Slot {
    AlignedFloats values;  // channel after channel
    std::string bytes;     // channels interleaved
};

void make(const VolumeLevel& level, std::size_t channels, config::PixelType type,
          const VoxelBox& box, Slot& slot) {
    const auto count = static_cast<std::size_t>(box.count());
    slot.values.resize(count * channels);
    std::vector<float*> planes;
    for (std::size_t c = 0; c < channels; ++c) planes.push_back(&slot.values[c * count]);
    level.voxels->fill(box, planes);
    slot.bytes.resize(count * channels * static_cast<std::size_t>(bytes_per_value(type)));
    store_voxels({planes.begin(), planes.end()}, count, type, slot.bytes.data());
}

}  // namespace

config::Outcome<bool> write_bin_volume(const BakedVolume& volume, int index, int threads,
                                       Progress* progress, const std::filesystem::path& path) {
    const VolumeLevel& level = volume.levels[static_cast<std::size_t>(index)];
    const BoxSequence boxes(level.size, static_cast<int>(volume.channel_names.size()));
    std::vector<Slot> slots(static_cast<std::size_t>(box_slots(threads)));
    FileOutput output(path);
    bool complete = true;
    ordered_pipeline(
        boxes.count(), threads, static_cast<int>(slots.size()),
        [&](int i, int slot) {
            if (is_cancelled(progress)) return;
            make(level, volume.channel_names.size(), volume.pixel_type, boxes[i],
                 slots[static_cast<std::size_t>(slot)]);
        },
        [&](int i, int slot) {
            complete = !is_cancelled(progress);
            if (!complete) return false;
            output.write(slots[static_cast<std::size_t>(slot)].bytes);
            if (progress != nullptr) progress->advance("write", (i + 1.0) / boxes.count());
            return output.error() == 0;
        });
    if (!output.finish()) return {{}, {output.diagnostic()}};
    return {complete, {}};
}

config::Outcome<bool> read_bin_volume(const std::filesystem::path& path,
                                      const std::array<int, 3>& size, int channels,
                                      config::PixelType type, const VoxelVisitor& visit) {
    config::Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const std::int64_t voxels = VoxelBox{{}, size}.count();
    const auto voxel_bytes = static_cast<std::uint64_t>(channels * bytes_per_value(type));
    if (file.value->size() != static_cast<std::uint64_t>(voxels) * voxel_bytes) {
        return {
            {},
            {file_error("E0304", path.string(),
                        fmt::format("`{}` has {} bytes, but {} x {} x {} voxels take {}",
                                    path.string(), file.value->size(), size[0], size[1], size[2],
                                    static_cast<std::uint64_t>(voxels) * voxel_bytes))}};
    }
    const std::int64_t most = std::max<std::int64_t>(1, (std::int64_t{1} << 20) / channels);
    std::string bytes;
    std::vector<float> values;
    std::int64_t count = 0;
    for (std::int64_t first = 0; first < voxels; first += count) {
        count = std::min(most, voxels - first);
        bytes.resize(static_cast<std::size_t>(count) * voxel_bytes);
        values.resize(static_cast<std::size_t>(count * channels));
        const auto done = file.value->read(static_cast<std::uint64_t>(first) * voxel_bytes,
                                           bytes.data(), bytes.size());
        if (!done || *done < bytes.size()) return {{}, {file.value->diagnostic()}};
        load_values(bytes.data(), values.size(), type, values.data());
        if (!visit(first, count, values.data())) return {false, {}};
    }
    return {true, {}};
}

}  // namespace skybake
