// A two-dimensional field that owns its texels.
#pragma once

#include <cstddef>
#include <vector>

namespace skybake {

// Row-major, channels interleaved. Row 0 is v = 0, column 0 is u = 0; texel (x, y) has its centre
// at u = (x + 1/2) / width, v = (y + 1/2) / height.
template <class T>
struct Image2 {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<T> texels;

    Image2() = default;
    Image2(int width_, int height_, int channels_)
        : width(width_),
          height(height_),
          channels(channels_),
          texels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                 static_cast<std::size_t>(channels_)) {}

    std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
    }
    T* texel(int x, int y) { return texels.data() + offset(x, y); }
    const T* texel(int x, int y) const { return texels.data() + offset(x, y); }
};

}  // namespace skybake
