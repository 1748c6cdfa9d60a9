// Estimates of what a bake will take, before it is made.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "config/sections/forward.h"
#include "config/sections/scene.h"

namespace skybake {

// Rough figures, meant for people and for limits, not for results.
struct Estimate {
    std::vector<int> size;  // 0 x 0 if max_error chooses it
    double seconds = 0;     // on one thread of a machine of 2022
    double memory_mib = 0;  // without the program's own
    double disk_mib = 0;
};

inline constexpr double kMebibyte = 1024.0 * 1024.0;

// The time to solve for the light of all orders, needed unless only single scattering is asked for.
inline constexpr double kSecondsToSolve = 1;
double seconds_to_solve(config::SkyOrders orders);

inline constexpr double kSecondsPerOctave = 1e-9;  // and per voxel
double octaves_of(const Noise& noise);

// Returns the number of voxels of all levels.
double voxels_of(const std::array<int, 3>& size, int levels);

// Estimates a table, or of size {} the memory of the largest that a search for `max_error` tries. `certification`
// is the time that measuring its error takes, in seconds. A texture holds at most four of the channels.
Estimate estimate_texels(const config::AssetFiles& files, const std::array<int, 2>& size,
                         std::size_t channels, double seconds_per_texel, double certification);

// Estimates an asset with `size`, or with `max_error` instead.
template <class Asset>
Estimate estimate_table(const Asset& asset, std::size_t channels, double seconds_per_texel,
                        double certification) {
    const std::array<int, 2> size = asset.max_error ? std::array<int, 2>{} : asset.size;
    return estimate_texels(asset, size, channels, seconds_per_texel, certification);
}

Estimate estimate_volume(const config::AssetFiles& files, const std::array<int, 3>& size,
                         std::size_t channels, double seconds_per_voxel);

}  // namespace skybake
