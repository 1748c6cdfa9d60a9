// Measures a mask of blue noise: how even its values are, what remains of them in means
// over pixels, and how much power it has at low frequencies.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/field/conventions.h"

namespace skybake {

// The values of a mask in [0, 1], x fastest, then y, then t.
struct MaskView {
    std::array<int, 3> size{};
    const std::vector<float>* values = nullptr;

    std::size_t pixels() const {
        return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    }
    std::size_t frames() const { return static_cast<std::size_t>(size[2]); }
};

// Returns the differences between the n sorted values of each frame and the means of the n equal
// parts of [0, 1], (i + 1/2) / n: 0 if all values in [0, 1] are equally frequent.
ErrorFigures unevenness(const MaskView& mask);

// The edge of the windows of window_error, in pixels.
inline constexpr int kMaskWindow = 8;

// Returns the differences between 1/2 and the mean of each window of kMaskWindow x kMaskWindow
// pixels, of all places in all frames, which repeat. A smaller frame has windows of its own size.
// Independent values would have an RMS of sqrt(1/12) / kMaskWindow = 0.036.
ErrorFigures window_error(const MaskView& mask);

// Waves of fewer than so many cycles per pixel, or per frame, count as low frequencies.
inline constexpr double kLowFrequency = 0.125;

// Return the mean power of the waves of low frequencies over the mean power of all waves but the
// mean, over all frames; and over all pixels, of waves in time. White noise has 1. Returns 0 where
// there is no such wave, and for values that are all equal.
double low_power_of_frames(const MaskView& mask);
double low_power_over_time(const MaskView& mask);

}  // namespace skybake
