// Values between the texels of images and volumes, as a runtime's samplers find them.
#pragma once

#include <algorithm>
#include <array>

#include "bakers/field/image.h"

namespace skybake {

// Writes the bilinear lookup at texture coordinates (u, v), calculated in double, to `out`, one
// value per channel. Texel centres are at (x + 1/2) / width and (y + 1/2) / height. Beyond the
// outermost centres, lookups are clamped to the edge.
inline void bilinear(const Image2<float>& image, double u, double v, double* out) {
    const double x = std::clamp(u * image.width - 0.5, 0.0, image.width - 1.0);
    const double y = std::clamp(v * image.height - 0.5, 0.0, image.height - 1.0);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, image.width - 1);
    const int y1 = std::min(y0 + 1, image.height - 1);
    const double s = x - x0;
    const double t = y - y0;
    const float* low_left = image.texel(x0, y0);
    const float* low_right = image.texel(x1, y0);
    const float* high_left = image.texel(x0, y1);
    const float* high_right = image.texel(x1, y1);
    for (int channel = 0; channel < image.channels; ++channel) {
        const double low = double{low_left[channel]} * (1 - s) + double{low_right[channel]} * s;
        const double high = double{high_left[channel]} * (1 - s) + double{high_right[channel]} * s;
        out[channel] = low * (1 - t) + high * t;
    }
}

// A voxel and its weight.
struct VoxelTap {
    std::array<int, 3> voxel{};
    double weight = 0;
};

// Returns the eight taps of a trilinear lookup at texture coordinates `uvw`, x fastest. `uvw` may
// be any finite numbers; voxel i of an axis has its centre at (i + 1/2) / size. The weights sum to
// 1. Along an axis that repeats, voxels beyond the volume's edge are those of its next copy; along
// other axes, they are the last voxels before the edge, so that one voxel may occur twice.
std::array<VoxelTap, 8> trilinear_taps(const std::array<int, 3>& size,
                                       const std::array<double, 3>& uvw,
                                       const std::array<bool, 3>& repeats = {true, true, true});

}  // namespace skybake
