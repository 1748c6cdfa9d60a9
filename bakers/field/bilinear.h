// The lookup that a runtime makes: bilinear between texel centres, clamped to the edge.
#pragma once

#include <algorithm>

#include "bakers/field/image.h"

namespace skybake {

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
        const double low = low_left[channel] * (1 - s) + low_right[channel] * s;
        const double high = high_left[channel] * (1 - s) + high_right[channel] * s;
        out[channel] = low * (1 - t) + high * t;
    }
}

}  // namespace skybake
