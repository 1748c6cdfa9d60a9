#include "bakers/clouds/map_lookup.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace skybake::cloud {
namespace {

using config::MapFilter;
using config::MapWrap;

// The coordinate within the picture.
double wrapped(double coordinate, MapWrap wrap) {
    if (wrap == MapWrap::clamp) return std::clamp(coordinate, 0.0, 1.0);
    return coordinate - std::floor(coordinate);  // [0, 1]: 1 - 1e-20 rounds to 1
}

// `within` as of wrapped(): 1 is the far edge of the last pixel.
int nearest_pixel(double within, int size) {
    return std::min(static_cast<int>(within * size), size - 1);
}

// The two pixels about a place on one axis, and how far it is from the first to the second, in
// [0, 1).
struct Neighbours {
    int first = 0;
    int second = 0;
    double fraction = 0;
};

Neighbours neighbours(double within, int size, MapWrap wrap) {
    const double position = within * size - 0.5;
    const double below = std::floor(position);
    const int first = static_cast<int>(below);  // -1 to size - 1
    const int second = first + 1;
    const double fraction = position - below;
    if (wrap == MapWrap::clamp) return {std::max(first, 0), std::min(second, size - 1), fraction};
    return {first < 0 ? size - 1 : first, second == size ? 0 : second, fraction};
}

// In this form equal ends give themselves, and rounding leads beyond no end: b - a may round up by
// half an ulp, but its product with a fraction below 1 is then rounded to less than b - a itself.
double mixed(double a, double b, double fraction) { return a + (b - a) * fraction; }

}  // namespace

MapLookup::MapLookup(MapImage image, MapWrap wrap, MapFilter filter)
    : image_(std::move(image)), wrap_(wrap), filter_(filter) {}

double MapLookup::pixel(int x, int y) const {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width);
    return double{image_.values[row + static_cast<std::size_t>(x)]};
}

double MapLookup::at(double u, double v) const {
    const double x = wrapped(u, wrap_);
    const double y = wrapped(v, wrap_);
    if (filter_ == MapFilter::nearest) {
        return pixel(nearest_pixel(x, image_.width), nearest_pixel(y, image_.height));
    }
    const Neighbours columns = neighbours(x, image_.width, wrap_);
    const Neighbours rows = neighbours(y, image_.height, wrap_);
    const double upper = mixed(pixel(columns.first, rows.first), pixel(columns.second, rows.first),
                               columns.fraction);
    const double lower = mixed(pixel(columns.first, rows.second),
                               pixel(columns.second, rows.second), columns.fraction);
    return mixed(upper, lower, rows.fraction);
}

}  // namespace skybake::cloud
