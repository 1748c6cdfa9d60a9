// From texels to coordinates in [0, 1] and back, for the two conventions that tables use.
#pragma once

namespace skybake {

enum class TexelConvention {
    end_points_on_texel_centres,  // x = 0 at the first centre, 1 at the last: u = 1/2N + x (1 -
                                  // 1/N)
    end_points_on_edges,          // u = x
};

// The coordinate at the centre of texel i of `count`. A single texel whose axis has its end points
// on texel centres stands for the middle, 1/2.
inline double texel_coordinate(TexelConvention convention, int i, int count) {
    if (convention == TexelConvention::end_points_on_edges) return (i + 0.5) / count;
    return count == 1 ? 0.5 : static_cast<double>(i) / (count - 1);
}

// The texture coordinate of x.
inline double texture_coordinate(TexelConvention convention, double x, int count) {
    if (convention == TexelConvention::end_points_on_edges) return x;
    return 0.5 / count + x * (1 - 1.0 / count);
}

}  // namespace skybake
