#include "bakers/field/stored_voxels.h"

#include <algorithm>
#include <cstdint>

#include "bakers/field/pixel_type.h"
#include "bakers/field/voxel_index.h"

namespace skybake {

std::vector<float> StoredVoxels::at(const std::array<VoxelTap, 8>& taps) const {
    const std::array<int, 3>& first = taps[0].voxel;
    const std::array<int, 3>& last = taps[7].voxel;
    std::vector<float> values(8 * channels());
    if (last == std::array<int, 3>{first[0] + 1, first[1] + 1, first[2] + 1}) {
        fetch({first, {2, 2, 2}}, 0, values);
    } else {
        for (std::size_t i = 0; i < 8; ++i) fetch_once(taps, i, values);
    }
    return values;
}

// Taps may be the same voxel, at an edge or in a nearest lookup. It is then fetched only once.
void StoredVoxels::fetch_once(const std::array<VoxelTap, 8>& taps, std::size_t tap,
                              std::vector<float>& values) const {
    for (std::size_t same = 0; same < tap; ++same) {
        if (taps[same].voxel != taps[tap].voxel) continue;
        std::copy_n(&values[same * channels()], channels(), &values[tap * channels()]);
        return;
    }
    fetch({taps[tap].voxel, {1, 1, 1}}, tap, values);
}

// Writes the box's voxels, in the order of taps, to `values` from tap `from` on.
void StoredVoxels::fetch(const VoxelBox& box, std::size_t from, std::vector<float>& values) const {
    const auto count = static_cast<std::size_t>(box.count());
    std::vector<float> planar(count * channels());
    std::vector<float*> targets;
    for (std::size_t c = 0; c < channels(); ++c) targets.push_back(planar.data() + c * count);
    level_.voxels->fill(box, targets);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < channels(); ++c) {
            values[(from + i) * channels() + c] = round_to_pixel_type(planar[c * count + i], type_);
        }
    }
}

namespace {

// The finer voxels that a coarse voxel covers along an axis, from `first` on. The weights sum to 1.
struct Footprint {
    int first = 0;
    std::vector<double> weights;
};

// Calculates in units of 1/size of a finer voxel, in which all bounds are integers.
Footprint footprint_of(int coarse, int finer_size, int size) {
    const std::int64_t begin = std::int64_t{coarse} * finer_size;
    const std::int64_t end = begin + finer_size;
    Footprint footprint;
    footprint.first = static_cast<int>(begin / size);
    for (std::int64_t voxel = footprint.first; voxel * size < end; ++voxel) {
        const std::int64_t overlap =
            std::min(end, (voxel + 1) * size) - std::max(begin, voxel * size);
        footprint.weights.push_back(static_cast<double>(overlap) / finer_size);
    }
    return footprint;
}

std::vector<Footprint> footprints(int first, int count, int finer_size, int size) {
    std::vector<Footprint> result;
    for (int i = 0; i < count; ++i) result.push_back(footprint_of(first + i, finer_size, size));
    return result;
}

// How many finer voxels a range of coarse voxels covers.
int extent_of(const std::vector<Footprint>& under) {
    return under.back().first + static_cast<int>(under.back().weights.size()) - under.front().first;
}

float mean_under(const VoxelBox& finer, const float* values, const Footprint& x, const Footprint& y,
                 const Footprint& z) {
    double sum = 0;
    for (std::size_t k = 0; k < z.weights.size(); ++k) {
        for (std::size_t j = 0; j < y.weights.size(); ++j) {
            const float* row = values + index_in(finer, {x.first, y.first + static_cast<int>(j),
                                                         z.first + static_cast<int>(k)});
            double row_sum = 0;
            for (std::size_t i = 0; i < x.weights.size(); ++i) row_sum += x.weights[i] * row[i];
            sum += z.weights[k] * y.weights[j] * row_sum;
        }
    }
    return static_cast<float>(sum);
}

}  // namespace

std::array<int, 3> next_mip_size(const std::array<int, 3>& size) {
    return {std::max(1, size[0] / 2), std::max(1, size[1] / 2), std::max(1, size[2] / 2)};
}

std::array<int, 3> next_slice_size(const std::array<int, 3>& size) {
    return {std::max(1, size[0] / 2), std::max(1, size[1] / 2), size[2]};
}

MipSource::MipSource(std::shared_ptr<const VoxelSource> finer, const std::array<int, 3>& finer_size,
                     const std::array<int, 3>& size)
    : finer_(std::move(finer)), finer_size_(finer_size), size_(size) {}

void MipSource::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    // Takes as many coarse rows and slices at a time as keep the finer voxels within 8 MiB, but at
    // least one row.
    constexpr std::int64_t kFinerFloats = 1 << 21;
    const std::int64_t row =
        std::int64_t{2} * (box.size[0] + 1) * 9 * static_cast<std::int64_t>(channels.size());
    const auto rows =
        static_cast<int>(std::clamp<std::int64_t>(kFinerFloats / row, 1, box.size[1]));
    const auto depth =
        static_cast<int>(std::clamp<std::int64_t>(kFinerFloats / (row * rows), 1, box.size[2]));
    for (int z = 0; z < box.size[2]; z += depth) {
        for (int y = 0; y < box.size[1]; y += rows) {
            const VoxelBox part{
                {box.origin[0], box.origin[1] + y, box.origin[2] + z},
                {box.size[0], std::min(rows, box.size[1] - y), std::min(depth, box.size[2] - z)}};
            fill_part(box, part, channels);
        }
    }
}

void MipSource::fill_part(const VoxelBox& box, const VoxelBox& part,
                          const std::vector<float*>& channels) const {
    std::array<std::vector<Footprint>, 3> under;
    VoxelBox finer;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        under[axis] =
            footprints(part.origin[axis], part.size[axis], finer_size_[axis], size_[axis]);
        finer.origin[axis] = under[axis].front().first;
        finer.size[axis] = extent_of(under[axis]);
    }
    const auto count = static_cast<std::size_t>(finer.count());
    std::vector<float> values(count * channels.size());
    std::vector<float*> finer_channels(channels.size(), nullptr);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (channels[c] != nullptr) finer_channels[c] = values.data() + c * count;
    }
    finer_->fill(finer, finer_channels);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (channels[c] == nullptr) continue;
        for (int z = 0; z < part.size[2]; ++z) {
            for (int y = 0; y < part.size[1]; ++y) {
                float* target = channels[c] + index_in(box, {box.origin[0], part.origin[1] + y,
                                                             part.origin[2] + z});
                for (const Footprint& x : under[0]) {
                    *target++ = mean_under(finer, finer_channels[c], x,
                                           under[1][static_cast<std::size_t>(y)],
                                           under[2][static_cast<std::size_t>(z)]);
                }
            }
        }
    }
}

}  // namespace skybake
