// The coordinates of an aerial-perspective volume: u and v from a point's place in the camera's
// picture, w from its distance along the view ray.
//
//   u, v  place in the picture, from its left and from its top
//   w     linear   distance / view_distance
//         squared  sqrt(distance / view_distance)
//
// Voxel i of an axis samples (i + 1/2) / size. The picture is a perspective one: with X = 2 u - 1
// and Y = 1 - 2 v the ray goes along forward + tan(fov / 2) (aspect X right + Y up). The heading
// turns the view to the right, away from the sun's azimuth; the pitch turns it upwards.
//
// Points below the ground, which only interpolation uses, stand for points on the ground: at the
// same distance and azimuth or, beyond the horizon's distance, for points on the ray that grazes
// the ground. So light and transmittance are continuous at the end of the ground.
//
// Between the camera and the first slice, w0 = 1 / (2 size), light grows from 0 and transmittance
// falls from 1 about linearly with distance; there a runtime interpolates by distance.
#pragma once

#include "bakers/light/sky_ray.h"
#include "bakers/math/vectors.h"
#include "config/assets/aerial_perspective.h"

namespace skybake {

// A direction by its zenith angle and its azimuth from the sun.
struct ViewDirection {
    double mu = 0;
    double sine = 0;
    double azimuth_cosine = 1;  // any value where the direction is vertical
};

// Returns the tangent of half the vertical field of view.
double picture_reach(const config::AerialPerspectiveBake& bake);

class AerialCamera {
  public:
    explicit AerialCamera(const config::AerialPerspectiveBake& bake);

    const SunZenith& sun() const { return sun_; }
    double altitude_km() const { return altitude_km_; }
    ViewDirection direction(double u, double v) const;
    double distance_km(double w) const;

  private:
    SunZenith sun_;
    double altitude_km_;
    double view_distance_km_;
    config::SliceSpacing slices_;
    // The components point towards the sun's azimuth, to its right, and up.
    glm::dvec3 forward_{};
    glm::dvec3 right_{};  // times tan(fov / 2) and aspect
    glm::dvec3 up_{};     // times tan(fov / 2)
};

}  // namespace skybake
