// Layers of cloud for tests, held in memory.
#pragma once

#include <array>
#include <cstdint>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/field/baked.h"
#include "bakers/occupancy/cell_grid.h"
#include "tests/support/volumes.h"

namespace skybake::test {

inline cloud_light::CloudLayer layer_of(const std::array<int, 3>& size, float value,
                                        double extinction_per_m = 0.05) {
    cloud_light::CloudLayer layer;
    layer.size = size;
    layer.voxel_m = {10, 12, 8};
    layer.optics.extinction_per_m = extinction_per_m;
    layer.values.assign(occupancy::count_of(size), value);
    return layer;
}

// The same numbers on every machine: values in [0, 1), of which the share `full` is not 0.
inline cloud_light::CloudLayer rough_layer(const std::array<int, 3>& size, double full = 1,
                                           std::uint64_t seed = 1) {
    cloud_light::CloudLayer layer = layer_of(size, 0);
    for (float& value : layer.values) {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        const double share = static_cast<double>(seed >> 11U) * 0x1p-53;
        if (share < full) value = static_cast<float>(share / full);
    }
    return layer;
}

// Rough values in a box of voxels, 0 elsewhere.
inline cloud_light::CloudLayer lone_cloud(const std::array<int, 3>& size,
                                          const std::array<int, 3>& first,
                                          const std::array<int, 3>& last) {
    cloud_light::CloudLayer layer = rough_layer(size);
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        const std::array<int, 3> at = {x, y, z};
        bool inside = true;
        for (std::size_t a = 0; a < 3; ++a) {
            inside = inside && at[a] >= first[a] && at[a] < last[a];
        }
        if (!inside) layer.values[occupancy::index_of(size, x, y, z)] = 0;
    });
    return layer;
}

// A volume as bake_cloud_light needs it.
inline Baked volume_of(const cloud_light::CloudLayer& layer) {
    Baked of;
    of.mapping = "layer";
    of.axes.resize(3);
    const std::array<const char*, 3> quantities = {"x_m", "y_m", "altitude_m"};
    for (std::size_t a = 0; a < 3; ++a) {
        of.axes[a].quantity = quantities[a];
        of.axes[a].wrap = a < 2 ? AxisWrap::repeat : AxisWrap::clamp;
        of.axes[a].end_points = TexelConvention::end_points_on_edges;
        of.axes[a].first = a < 2 ? 0 : 1000;
        of.axes[a].last = of.axes[a].first + layer.voxel_m[a] * layer.size[a];
    }
    of.voxel_size_m = layer.voxel_m;
    of.up_axis = "+z";
    return of;
}

inline void add_edge(double threshold, double softness, cloud_light::CloudLayer& layer) {
    layer.optics.has_edge = true;
    layer.optics.threshold = threshold;
    layer.optics.edge_softness = softness;
}

}  // namespace skybake::test
