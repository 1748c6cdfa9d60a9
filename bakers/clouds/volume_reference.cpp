#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/clouds/resampled_volume.h"

namespace skybake::cloud {

namespace {

// A voxel of the source along an axis, and its share.
struct Share {
    int voxel = 0;
    double weight = 0;
};

// `at` is the place in voxels of the source, of which an axis has `from`, and its result `to`.
std::vector<Share> shares_of(double at, int from, int to) {
    if (to >= from) {
        const double below = std::floor(at - 0.5);
        const double fraction = at - 0.5 - below;
        const int voxel = static_cast<int>(below);
        return {{voxel, 1 - fraction}, {voxel + 1, fraction}};
    }
    const double width = static_cast<double>(from) / to;
    const double begin = at - width / 2;
    const double end = at + width / 2;
    std::vector<Share> shares;
    for (double voxel = std::floor(begin); voxel < end; ++voxel) {
        const double shared = std::min(end, voxel + 1) - std::max(begin, voxel);
        shares.push_back({static_cast<int>(voxel), shared / width});
    }
    return shares;
}

int modulo(int voxel, int period) { return (voxel % period + period) % period; }

}  // namespace

VolumeReference::VolumeReference(CloudVolume volume, const std::array<int, 3>& size)
    : volume_(std::move(volume)), size_(size) {}

bool VolumeReference::is_expensive() const {
    constexpr double most_voxels = 4000;
    double voxels = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        voxels *= std::max(1.0, static_cast<double>(volume_.source.size[i]) / size_[i]);
    }
    return voxels > most_voxels;
}

double VolumeReference::operator()(const std::array<double, 3>& place) const {
    const std::array<int, 3>& size = volume_.source.size;
    std::array<std::vector<Share>, 3> shares;
    for (std::size_t i = 0; i < 3; ++i) {
        shares[i] = shares_of(place[i] * size[i], size[i], size_[i]);
        if (i == 2 || volume_.wrap == config::VolumeWrap::empty) continue;
        for (Share& share : shares[i]) share.voxel = modulo(share.voxel, size[i]);
    }
    double sum = 0;
    for (const Share& z : shares[2]) {
        for (const Share& y : shares[1]) {
            for (const Share& x : shares[0]) {
                float value = 0;
                volume_.source.voxels->fill({{x.voxel, y.voxel, z.voxel}, {1, 1, 1}}, {&value});
                sum += x.weight * y.weight * z.weight * double{value};
            }
        }
    }
    return sum;
}

}  // namespace skybake::cloud
