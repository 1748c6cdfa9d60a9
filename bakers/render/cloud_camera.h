// The camera of a cloud picture: calculates rays from pixels.
#pragma once

#include "bakers/march/layer_march.h"
#include "bakers/math/vectors.h"
#include "bakers/render/cloud_view.h"

namespace skybake {

class CameraRays {
  public:
    CameraRays(const CloudCamera& camera, int width, int height);

    // Returns the direction of the ray through the middle of pixel (x, y), with row 0 at the top.
    glm::dvec3 through(double x, double y) const;

    // The width of a pixel in the middle of the picture, at distance 1.
    double pixel() const { return 2 * half_width_ / width_; }

  private:
    glm::dvec3 forward_{};
    glm::dvec3 right_{};
    glm::dvec3 up_{};
    double half_width_ = 0;  // of the picture, at distance 1
    int width_ = 0;
    int height_ = 0;
};

}  // namespace skybake
