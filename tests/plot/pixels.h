// Finds what can be seen on a picture.
#pragma once

#include <algorithm>
#include <limits>

#include "bakers/plot/drawing.h"

namespace skybake {

inline Colour pixel(const Picture& picture, int x, int y) {
    const auto at = 3 * static_cast<std::size_t>(y * picture.width + x);
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

// First and last column and row of pixels of a kind.
struct PixelBox {
    int left = std::numeric_limits<int>::max();
    int top = std::numeric_limits<int>::max();
    int right = -1;
    int bottom = -1;
    int count = 0;
};

template <class Kind>
PixelBox box_where(const Picture& picture, int left, int top, int right, int bottom,
                   const Kind& kind) {
    PixelBox box;
    for (int y = top; y < std::min(bottom, picture.height); ++y) {
        for (int x = left; x < std::min(right, picture.width); ++x) {
            if (!kind(pixel(picture, x, y))) continue;
            box.left = std::min(box.left, x);
            box.right = std::max(box.right, x);
            box.top = std::min(box.top, y);
            box.bottom = std::max(box.bottom, y);
            ++box.count;
        }
    }
    return box;
}

template <class Kind>
PixelBox box_where(const Picture& picture, const Kind& kind) {
    return box_where(picture, 0, 0, picture.width, picture.height, kind);
}

// Returns the box of one colour, left of a column.
inline PixelBox box_of(const Picture& picture, Colour colour, int x_end) {
    return box_where(picture, 0, 0, x_end, picture.height,
                     [&](Colour other) { return other == colour; });
}

}  // namespace skybake
