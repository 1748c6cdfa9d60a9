#include "bakers/noise/tile_axis.h"

namespace skybake::noise {

std::array<TileAxis, 3> tile_axes(const std::array<int, 3>& size, config::NoiseSampling sampling) {
    using config::NoiseSampling;
    const int across = sampling == NoiseSampling::corners ? 0 : 1;
    const int along = sampling == NoiseSampling::centers ? 1 : 0;
    return {{{size[0], across}, {size[1], across}, {size[2], along}}};
}

}  // namespace skybake::noise
