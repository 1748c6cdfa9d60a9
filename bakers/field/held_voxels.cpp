#include "bakers/field/held_voxels.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "bakers/field/sparse_rows.h"
#include "bakers/field/voxel_index.h"
#include "bakers/math/memory.h"

namespace skybake {
namespace {

template <class Work>
void for_each_row(const VoxelBox& box, const Work& work) {
    for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
        for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) work(y, z);
    }
}

class HeldSource : public VoxelSource {
  public:
    // `memory` has room for the rows' fixed bytes.
    HeldSource(std::shared_ptr<const VoxelSource> source, std::unique_ptr<VoxelMemory> memory,
               const std::array<int, 3>& size, int channels, PixelType type)
        : source_(std::move(source)),
          size_(size),
          channels_(channels),
          memory_(std::move(memory)),
          rows_(static_cast<std::size_t>(VoxelBox{{}, size}.count() / size[0] * channels),
                static_cast<std::size_t>(size[0]), type, *memory_) {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        assert(static_cast<int>(channels.size()) == channels_);
        for (const VoxelBox& part : missing_parts(box, channels)) make(box, part, channels);
    }

    // Asks the rows that are held, and the source about boxes with others alone: a source may work
    // long for its answer.
    bool is_empty(const VoxelBox& box) const override {
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
            for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
                for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) {
                    const std::size_t row = index_of(c, y, z);
                    if (!rows_.holds(row)) return source_->is_empty(box);
                    if (!rows_.is_zero(row, static_cast<std::size_t>(box.origin[0]),
                                       static_cast<std::size_t>(box.size[0]))) {
                        return false;
                    }
                }
            }
        }
        return true;
    }

  private:
    std::size_t index_of(std::size_t channel, int y, int z) const {
        const auto depth = static_cast<std::size_t>(size_[2]);
        const auto height = static_cast<std::size_t>(size_[1]);
        return (channel * depth + static_cast<std::size_t>(z)) * height +
               static_cast<std::size_t>(y);
    }

    // Writes a row's voxels of all channels that are wanted; returns false, with some of them
    // written, if one is not held.
    bool read_row(const VoxelBox& box, int y, int z, const std::vector<float*>& channels) const {
        const std::int64_t at = index_in(box, {box.origin[0], y, z});
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (channels[c] == nullptr) continue;
            const std::size_t row = index_of(c, y, z);
            if (!rows_.holds(row)) return false;
            rows_.get(row, static_cast<std::size_t>(box.origin[0]),
                      static_cast<std::size_t>(box.size[0]), channels[c] + at);
        }
        return true;
    }

    // Writes the rows that are held, and returns parts of the box that contain the others. Slices
    // that lack the same rows are one part, since sources share work between slices.
    std::vector<VoxelBox> missing_parts(const VoxelBox& box,
                                        const std::vector<float*>& channels) const {
        std::vector<VoxelBox> parts;
        for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
            int first = box.origin[1] + box.size[1];
            int last = box.origin[1];
            for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) {
                if (read_row(box, y, z, channels)) continue;
                first = std::min(first, y);
                last = y + 1;
            }
            if (first >= last) continue;
            const bool as_before = !parts.empty() && parts.back().origin[1] == first &&
                                   parts.back().size[1] == last - first &&
                                   parts.back().origin[2] + parts.back().size[2] == z;
            if (as_before) {
                ++parts.back().size[2];
            } else {
                parts.push_back({{box.origin[0], first, z}, {box.size[0], last - first, 1}});
            }
        }
        return parts;
    }

    // Makes the voxels of a part of the box, in place where they lie side by side there.
    void make(const VoxelBox& box, const VoxelBox& part,
              const std::vector<float*>& channels) const {
        const std::int64_t at = index_in(box, part.origin);
        std::vector<float*> targets(channels.size(), nullptr);
        if (part.size[1] == box.size[1]) {
            for (std::size_t c = 0; c < channels.size(); ++c) {
                if (channels[c] != nullptr) targets[c] = channels[c] + at;
            }
            source_->fill(part, targets);
            hold(part, targets);
            return;
        }
        const auto count = static_cast<std::size_t>(part.count());
        AlignedFloats made(count * channels.size());
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (channels[c] != nullptr) targets[c] = made.data() + c * count;
        }
        source_->fill(part, targets);
        hold(part, targets);
        copy(part, targets, box, channels);
    }

    static void copy(const VoxelBox& part, const std::vector<float*>& made, const VoxelBox& box,
                     const std::vector<float*>& channels) {
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (channels[c] == nullptr) continue;
            for_each_row(part, [&](int y, int z) {
                const std::array<int, 3> first = {part.origin[0], y, z};
                std::copy_n(made[c] + index_in(part, first), part.size[0],
                            channels[c] + index_in(box, first));
            });
        }
    }

    // Holds rows that are whole.
    void hold(const VoxelBox& part, const std::vector<float*>& made) const {
        if (part.size[0] != size_[0]) return;
        for (std::size_t c = 0; c < made.size(); ++c) {
            if (made[c] == nullptr) continue;
            for_each_row(part, [&](int y, int z) {
                rows_.put(index_of(c, y, z), made[c] + index_in(part, {part.origin[0], y, z}));
            });
        }
    }

    std::shared_ptr<const VoxelSource> source_;
    const std::array<int, 3> size_;
    const int channels_;
    std::unique_ptr<VoxelMemory> memory_;
    mutable SparseRows rows_;  // any thread may change them
};

}  // namespace

std::shared_ptr<const VoxelSource> held_voxels(std::shared_ptr<const VoxelSource> source,
                                               const std::array<int, 3>& size, int channels,
                                               const BakeOptions& options, PixelType type) {
    auto memory = std::make_unique<VoxelMemory>(options.held_voxel_bytes);
    const auto rows = static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) *
                      static_cast<std::size_t>(channels);
    if (!memory->take(SparseRows::fixed_bytes(rows, static_cast<std::size_t>(size[0])))) {
        return source;
    }
    return std::make_shared<HeldSource>(std::move(source), std::move(memory), size, channels, type);
}

}  // namespace skybake
