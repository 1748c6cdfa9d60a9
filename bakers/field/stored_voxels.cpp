#include "bakers/field/stored_voxels.h"

#include <algorithm>

#include "bakers/field/pixel_type.h"

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

// Of taps that are the same voxel, at an edge or of the nearest one, only the first is asked for.
void StoredVoxels::fetch_once(const std::array<VoxelTap, 8>& taps, std::size_t tap,
                              std::vector<float>& values) const {
    for (std::size_t same = 0; same < tap; ++same) {
        if (taps[same].voxel != taps[tap].voxel) continue;
        std::copy_n(&values[same * channels()], channels(), &values[tap * channels()]);
        return;
    }
    fetch({taps[tap].voxel, {1, 1, 1}}, tap, values);
}

// The box's voxels, in the order of taps, to values from tap `from` on.
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

}  // namespace skybake
