#include "bakers/io/volumes/raw_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/voxel_index.h"
#include "bakers/io/files/file_io.h"
#include "bakers/math/half_conversion.h"

namespace skybake {
namespace {

using config::AxisOrder;
using config::ByteOrder;

std::size_t bytes_of(PixelType type) {
    if (type == PixelType::float32) return 4;
    return type == PixelType::unorm8 ? 1 : 2;
}

// The axes from the fastest to the slowest.
std::array<std::size_t, 3> axes_of(AxisOrder order) {
    // In the order of the enumerators.
    static constexpr std::array<std::size_t, 3> kAxes[] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                                           {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    return kAxes[static_cast<std::size_t>(order)];
}

std::uint32_t number_at(const char* bytes, std::size_t count, ByteOrder order) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = order == ByteOrder::big ? i : count - 1 - i;
        number = number << 8U | static_cast<unsigned char>(bytes[at]);
    }
    return number;
}

float value_at(const char* bytes, PixelType type, ByteOrder order) {
    const std::uint32_t number = number_at(bytes, bytes_of(type), order);
    if (type == PixelType::float32) return std::bit_cast<float>(number);
    if (type == PixelType::half) return float_of_half(static_cast<std::uint16_t>(number));
    const float largest = type == PixelType::unorm8 ? 255.0F : 65535.0F;
    return static_cast<float>(number) / largest;
}

// The voxels along the axes of the file, of which the first is the fastest.
class RawVoxels : public VoxelSource {
  public:
    RawVoxels(FileInput file, const RawLayout& layout)
        : file_(std::move(file)), layout_(layout), axes_(axes_of(layout.axis_order)) {
        for (std::size_t i = 0; i < 3; ++i) voxels_.size[i] = layout.size[axes_[i]];
    }

    std::uint64_t bytes() const {
        return layout_.offset +
               static_cast<std::uint64_t>(voxels_.count()) * bytes_of(layout_.type);
    }
    std::uint64_t file_bytes() const { return file_.size(); }

    const std::array<int, 3>& size() const { return voxels_.size; }

    // The axes of space among those of the file.
    IndexAxes axes() const {
        IndexAxes axes;
        for (std::size_t i = 0; i < 3; ++i) axes.index[axes_[i]] = i;
        return axes;
    }

    // Reads all voxels once, for the largest value, at least 0, and the faults.
    void survey(FileVoxels& voxels) const {
        constexpr std::int64_t most = 1 << 18;
        const std::int64_t count = voxels_.count();
        std::string bytes;
        std::vector<float> values(most);
        for (std::int64_t first = 0; first < count; first += most) {
            const auto part = static_cast<std::size_t>(std::min(most, count - first));
            read(first, part, bytes, values.data());
            for (std::size_t i = 0; i < part; ++i) {
                if (ValueFaults::is_fault(values[i])) {
                    voxels.faults.add(values[i], index_of(first + static_cast<std::int64_t>(i)));
                } else {
                    voxels.largest = std::max(voxels.largest, values[i]);
                }
            }
        }
    }

    // Voxels along the fastest axis are read together.
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        std::fill_n(channels[0], box.count(), 0.0F);
        std::array<int, 3> first{};
        std::array<int, 3> end{};
        for (std::size_t i = 0; i < 3; ++i) {
            first[i] = std::max(box.origin[i], 0);
            end[i] = std::min(box.origin[i] + box.size[i], voxels_.size[i]);
            if (first[i] >= end[i]) return;
        }
        const auto count = static_cast<std::size_t>(end[0] - first[0]);
        std::string bytes;
        for (int z = first[2]; z < end[2]; ++z) {
            for (int y = first[1]; y < end[1]; ++y) {
                float* const line = channels[0] + index_in(box, {first[0], y, z});
                read(index_in(voxels_, {first[0], y, z}), count, bytes, line);
                for (std::size_t i = 0; i < count; ++i) {
                    if (!std::isfinite(line[i])) line[i] = 0;
                }
            }
        }
    }

  private:
    // Returns the indices of a voxel along x, y and z, given its number in the file's order.
    std::array<std::int64_t, 3> index_of(std::int64_t number) const {
        const std::array<int, 3> in_file = voxel_at(voxels_, number);
        std::array<std::int64_t, 3> index{};
        for (std::size_t i = 0; i < 3; ++i) index[axes_[i]] = in_file[i];
        return index;
    }

    // Reads voxels in the file's order.
    void read(std::int64_t first, std::size_t count, std::string& bytes, float* values) const {
        const std::size_t each = bytes_of(layout_.type);
        bytes.resize(count * each);
        const std::uint64_t position = layout_.offset + static_cast<std::uint64_t>(first) * each;
        {
            const std::lock_guard lock(mutex_);
            if (file_.read(position, bytes.data(), bytes.size()) != bytes.size()) {
                throw std::runtime_error("a volume's file has changed while it was read");
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            values[i] = value_at(bytes.data() + i * each, layout_.type, layout_.byte_order);
        }
    }

    mutable std::mutex mutex_;  // guards the file
    mutable FileInput file_;
    const RawLayout layout_;
    const std::array<std::size_t, 3> axes_;
    VoxelBox voxels_;
};

Outcome<FileVoxels> not_such_a_volume(const std::filesystem::path& path,
                                      const std::string& reason) {
    return file_error("E0304", path.string(),
                      fmt::format("cannot read `{}` as a raw volume: {}", path.string(), reason));
}

}  // namespace

Outcome<FileVoxels> open_raw_volume(const std::filesystem::path& path, const RawLayout& layout,
                                    VolumePart part, config::NotFinite not_finite) {
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const auto source = std::make_shared<RawVoxels>(std::move(*file.value), layout);
    if (source->bytes() != source->file_bytes()) {
        return not_such_a_volume(path, fmt::format("it has {} bytes, and the layout has {}",
                                                   source->file_bytes(), source->bytes()));
    }
    FileVoxels voxels;
    voxels.size = layout.size;
    if (part == VolumePart::shape) return {std::move(voxels), {}};
    try {
        source->survey(voxels);
    } catch (const std::exception& error) {
        return not_such_a_volume(path, error.what());
    }
    if (not_finite == config::NotFinite::refuse && voxels.faults.not_finite.count > 0) {
        return not_such_a_volume(path, refusal_of(voxels.faults));
    }
    voxels.size = source->size();
    voxels.voxels = source;
    turn_to_space(source->axes(), voxels);
    return {std::move(voxels), {}};
}

}  // namespace skybake
