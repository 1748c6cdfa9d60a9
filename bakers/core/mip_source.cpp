#include "bakers/core/mip_source.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace skybake {

namespace {

// The finer voxels under a coarse one along an axis, from `first` on, with weights of sum 1.
struct Footprint {
    std::int64_t first = 0;  // may lie outside of the tile
    std::vector<double> weights;
};

// In units of 1 / (2 m) of a finer voxel everything is an integer.
Footprint footprint_of(int coarse, int finer_size, int size, bool centered) {
    const std::int64_t unit = std::int64_t{2} * size;
    const std::int64_t shift = centered ? 0 : size - std::int64_t{finer_size};
    const std::int64_t begin = std::int64_t{2} * coarse * finer_size + shift;
    const std::int64_t end = begin + std::int64_t{2} * finer_size;
    Footprint footprint;
    footprint.first = begin >= 0 ? begin / unit : -((-begin + unit - 1) / unit);
    for (std::int64_t voxel = footprint.first; voxel * unit < end; ++voxel) {
        const std::int64_t overlap =
            std::min(end, (voxel + 1) * unit) - std::max(begin, voxel * unit);
        footprint.weights.push_back(static_cast<double>(overlap) /
                                    static_cast<double>(end - begin));
    }
    return footprint;
}

int wrapped(std::int64_t voxel, int size) {
    return static_cast<int>(((voxel % size) + size) % size);
}

// The finer voxels that a range of coarse ones lies over: [first, first + count), not wrapped.
struct FinerRange {
    std::int64_t first = 0;
    int count = 0;
};

FinerRange range_of(const std::vector<Footprint>& footprints) {
    const std::int64_t first = footprints.front().first;
    const Footprint& last = footprints.back();
    return {first, static_cast<int>(last.first - first) + static_cast<int>(last.weights.size())};
}

std::vector<Footprint> footprints(int first, int count, int finer_size, int size, bool centered) {
    std::vector<Footprint> result;
    for (int i = 0; i < count; ++i) {
        result.push_back(footprint_of(first + i, finer_size, size, centered));
    }
    return result;
}

// Finer voxels of one channel: whole rows, [z][y][x].
struct FinerBox {
    FinerRange y, z;
    int width = 0;
    std::size_t row(std::int64_t fine_y, std::int64_t fine_z) const {
        return (static_cast<std::size_t>(fine_z - z.first) * static_cast<std::size_t>(y.count) +
                static_cast<std::size_t>(fine_y - y.first)) *
               static_cast<std::size_t>(width);
    }
    std::size_t count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(y.count) *
               static_cast<std::size_t>(z.count);
    }
};

// Fills the box from the tile, piece by piece where it reaches over the seam.
void fill_finer(const VoxelSource& source, const std::array<int, 3>& size, const FinerBox& box,
                const std::vector<float*>& channels) {
    for (int k = 0; k < box.z.count; ++k) {
        const int z = wrapped(box.z.first + k, size[2]);
        for (int j = 0; j < box.y.count;) {
            const int y = wrapped(box.y.first + j, size[1]);
            const int rows = std::min(box.y.count - j, size[1] - y);
            const bool whole = j == 0 && rows == box.y.count;
            const int slices = whole ? std::min(box.z.count - k, size[2] - z) : 1;
            std::vector<float*> targets = channels;
            for (float*& target : targets) {
                if (target != nullptr) target += box.row(box.y.first + j, box.z.first + k);
            }
            source.fill({{0, y, z}, {size[0], rows, slices}}, targets);
            if (whole) k += slices - 1;
            j += rows;
        }
    }
}

float mean_under(const FinerBox& finer, const float* values, const Footprint& x, const Footprint& y,
                 const Footprint& z) {
    double sum = 0;
    for (std::size_t k = 0; k < z.weights.size(); ++k) {
        for (std::size_t j = 0; j < y.weights.size(); ++j) {
            const float* row = values + finer.row(y.first + static_cast<std::int64_t>(j),
                                                  z.first + static_cast<std::int64_t>(k));
            double row_sum = 0;
            for (std::size_t i = 0; i < x.weights.size(); ++i) {
                const int fine = wrapped(x.first + static_cast<std::int64_t>(i), finer.width);
                row_sum += x.weights[i] * row[fine];
            }
            sum += z.weights[k] * y.weights[j] * row_sum;
        }
    }
    return static_cast<float>(sum);
}

}  // namespace

std::array<int, 3> next_mip_size(const std::array<int, 3>& size) {
    return {std::max(1, size[0] / 2), std::max(1, size[1] / 2), std::max(1, size[2] / 2)};
}

MipSource::MipSource(std::shared_ptr<const VoxelSource> finer, const std::array<int, 3>& finer_size,
                     const std::array<bool, 3>& centered)
    : finer_(std::move(finer)),
      finer_size_(finer_size),
      size_(next_mip_size(finer_size)),
      centered_(centered) {}

void MipSource::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    // As many coarse slices at a time as keep the finer ones within a few MiB.
    constexpr std::int64_t kFinerFloats = 1 << 21;
    const std::int64_t finer_per_slice = std::int64_t{finer_size_[0]} * (2 * box.size[1] + 2) * 2 *
                                         static_cast<std::int64_t>(channels.size());
    const int depth =
        static_cast<int>(std::clamp<std::int64_t>(kFinerFloats / finer_per_slice, 1, box.size[2]));
    for (int z = 0; z < box.size[2]; z += depth) {
        VoxelBox part = box;
        part.origin[2] = box.origin[2] + z;
        part.size[2] = std::min(depth, box.size[2] - z);
        std::vector<float*> targets = channels;
        const auto offset = static_cast<std::size_t>(z) * static_cast<std::size_t>(box.size[1]) *
                            static_cast<std::size_t>(box.size[0]);
        for (float*& target : targets) {
            if (target != nullptr) target += offset;
        }
        fill_part(part, targets);
    }
}

void MipSource::fill_part(const VoxelBox& box, const std::vector<float*>& channels) const {
    const auto along = [&](std::size_t axis) {
        return footprints(box.origin[axis], box.size[axis], finer_size_[axis], size_[axis],
                          centered_[axis]);
    };
    const std::array<std::vector<Footprint>, 3> under = {along(0), along(1), along(2)};
    const FinerBox finer{range_of(under[1]), range_of(under[2]), finer_size_[0]};
    std::vector<float> values(finer.count() * channels.size());
    std::vector<float*> finer_channels(channels.size(), nullptr);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (channels[c] != nullptr) finer_channels[c] = values.data() + c * finer.count();
    }
    fill_finer(*finer_, finer_size_, finer, finer_channels);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        float* target = channels[c];
        if (target == nullptr) continue;
        for (const Footprint& z : under[2]) {
            for (const Footprint& y : under[1]) {
                for (const Footprint& x : under[0]) {
                    *target++ = mean_under(finer, finer_channels[c], x, y, z);
                }
            }
        }
    }
}

}  // namespace skybake
