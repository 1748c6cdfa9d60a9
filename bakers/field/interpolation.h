// Values between the texels of images and volumes, as a runtime's samplers find them.
#pragma once

#include <algorithm>
#include <array>

#include "bakers/field/image.h"

namespace skybake {

// The lookup that a runtime makes: bilinear between texel centres, clamped to the edge.

// The value at texture coordinates (u, v) in double, into out[0 .. channels). Texel centres stand
// at (x + 1/2) / width, (y + 1/2) / height; beyond the outermost centres the edge goes on.
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

// The lookup that a runtime makes of a volume: trilinear between voxel centres.

// A voxel and its weight.
struct VoxelTap {
    std::array<int, 3> voxel{};
    double weight = 0;
};

// The eight taps of a lookup at texture coordinates `uvw` (any finite numbers; voxel i of an axis
// has its centre at (i + 1/2) / size), x fastest. Their weights sum to 1. Voxels beyond the
// volume's edge are those of its next copy along axes that repeat, else the last ones before it; so
// that one may come twice.
std::array<VoxelTap, 8> trilinear_taps(const std::array<int, 3>& size,
                                       const std::array<double, 3>& uvw,
                                       const std::array<bool, 3>& repeats = {true, true, true});

}  // namespace skybake
