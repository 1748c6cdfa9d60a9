// The coordinates of an aerial-perspective volume: u and v from a point's place in the camera's
// picture, w from its distance along the view ray.
//
//   u, v  place in the picture, from its left and from its top
//   w     linear   distance / reach
//         squared  sqrt(distance / reach)
//
// Distances count from the camera up to a reach of view_distance. With slices_begin = "air" those of a
// camera in space count from where its ray enters the air, up to twice its way to the ground, or up to
// its way through the air, which is the same for the ray that grazes the ground; at most up to
// view_distance. A ray that misses the air begins where it is nearest to it.
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

#include <optional>

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

// The part of a view ray that slices divide: from a distance from the camera on, so far.
struct SlicedWay {
    double begin_km = 0;
    double reach_km = 0;
};

class AerialCamera {
  public:
    AerialCamera(const config::AerialPerspectiveBake& bake, const Shell& shell);

    const SunZenith& sun() const { return sun_; }
    double altitude_km() const { return altitude_km_; }
    ViewDirection direction(double u, double v) const;
    SlicedWay way(double u, double v) const;
    // Returns the distance from the camera.
    double distance_km(double u, double v, double w) const;
    // The air with which the slices begin, or nothing if they begin at the camera.
    const std::optional<Shell>& air() const { return air_; }
    // The camera's distance from the planet's centre.
    double radius_km() const { return radius_km_; }

  private:
    SunZenith sun_;
    double altitude_km_;
    double radius_km_;
    double view_distance_km_;
    std::optional<Shell> air_;
    config::SliceSpacing slices_;
    // The components point towards the sun's azimuth, to its right, and up.
    glm::dvec3 forward_{};
    glm::dvec3 right_{};  // times tan(fov / 2) and aspect
    glm::dvec3 up_{};     // times tan(fov / 2)
};

}  // namespace skybake
