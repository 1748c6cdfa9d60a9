// Converts the numbers of a grid to densities.
//
// The numbers of a fog volume are densities. Those of a level set are signed distances to a surface,
// negative inside of it, which are only known within a narrow band; deeper inside they are all minus
// the half width w of the band. Density falls from 1 there to 0 at the surface:
//
//   density(s) = clamp(-s / w, 0, 1)
//
// as OpenVDB's tools::sdfToFogVolume has it, but for the rounding of its product by 1 / w.
// Distances and w are in the same unit, so that the density does not depend on the unit, nor on a
// `voxel_size` of the recipe.
#pragma once

#include <algorithm>
#include <cmath>

namespace skybake {

class DensityRamp {
  public:
    // Numbers are densities.
    DensityRamp() = default;
    // Numbers are distances. half_width is valid if it is finite and above 0.
    explicit DensityRamp(float half_width) : half_width_(half_width), changes_(true) {}

    bool is_valid() const { return !changes_ || (std::isfinite(half_width_) && half_width_ > 0); }
    bool changes() const { return changes_; }
    float operator()(float number) const {
        if (!changes_) return number;
        return number < 0 ? std::min(1.0F, -number / half_width_) : 0.0F;
    }

  private:
    float half_width_ = 0;
    bool changes_ = false;
};

}  // namespace skybake
