#include "bakers/noise/tile_axis.h"

namespace skybake::noise {

std::array<TileAxis, 3> tile_axes(const std::array<int, 3>& size, config::NoiseSampling sampling) {
    using config::NoiseSampling;
    const int across = sampling == NoiseSampling::corners ? 0 : 1;
    const int along = sampling == NoiseSampling::centers ? 1 : 0;
    return {{{size[0], across}, {size[1], across}, {size[2], along}}};
}

bool is_resolved(const std::array<TileAxis, 3>& axes, const std::array<int, 3>& frequency) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (frequency[axis] > axes[axis].size && axes[axis].size > 1) return false;
    }
    return true;
}

}  // namespace skybake::noise
