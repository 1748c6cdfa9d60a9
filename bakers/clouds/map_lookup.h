// Lookups in a map that lies over a cloud's ground plan.
//
//   linear    m(u, v) = (1 - t) ((1 - s) m00 + s m10) + t ((1 - s) m01 + s m11)
//   nearest   m(u, v) = the pixel that (u, v) lies in
//
// u runs along x, from the first column to the last, v along y, from the picture's first row down:
// row 0 begins at v = 0. Pixel (i, j) has its centre at ((i + 1/2) / width, (j + 1/2) / height);
// s and t are the distances to the centres before (u, v), in pixels.
#pragma once

#include "bakers/field/map_image.h"
#include "config/sections/cloud.h"

namespace skybake::cloud {

class MapLookup {
  public:
    // `image` has at least one pixel.
    MapLookup(MapImage image, config::MapWrap wrap, config::MapFilter filter);

    // The value at any finite (u, v): never beyond the values of the pixels about it, and just
    // theirs where they are all the same. Outside of [0, 1] the picture repeats, or its edge goes
    // on. Any number of threads may ask.
    double at(double u, double v) const;

  private:
    double pixel(int x, int y) const;

    MapImage image_;
    config::MapWrap wrap_;
    config::MapFilter filter_;
};

}  // namespace skybake::cloud
