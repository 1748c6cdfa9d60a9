// Two-dimensional fields that own their values, and the two conventions that relate texels to
// coordinates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
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

inline Image2<double> in_double(const Image2<float>& image) {
    Image2<double> result(image.width, image.height, image.channels);
    std::ranges::copy(image.texels, result.texels.begin());
    return result;
}

// A picture of one channel that lies over a cloud's ground plan. Row-major, the picture's first row
// first. Values are in [0, 1] and linear.
struct MapImage {
    int width = 0;
    int height = 0;
    std::vector<float> values;
    std::string content_hash;  // xxh3_hex of width, height and values
};

// The coordinates x in [0, 1] that the texels of a table stand for.
enum class TexelConvention {
    end_points_on_texel_centres,  // x = 0 at the first centre, 1 at the last: u = 1/2N + x (1 -
                                  // 1/N)
    end_points_on_edges,          // u = x
};

// The coordinate at the centre of texel i of `count`. With end points on texel centres, a single
// texel stands for the middle, 1/2.
inline double texel_coordinate(TexelConvention convention, int i, int count) {
    if (convention == TexelConvention::end_points_on_edges) return (i + 0.5) / count;
    return count == 1 ? 0.5 : static_cast<double>(i) / (count - 1);
}

// The texture coordinate of x in a table of `count` texels.
inline double texture_coordinate(TexelConvention convention, double x, int count) {
    if (convention == TexelConvention::end_points_on_edges) return x;
    return 0.5 / count + x * (1 - 1.0 / count);
}

}  // namespace skybake
