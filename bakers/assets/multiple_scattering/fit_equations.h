// The equations that a table of the mean radiance has to fulfil so that views of a scene look
// right.
//
// Along a ray, the light of higher orders that an isotropic table gives is linear in its texels:
//
//   integral of T sigma_s Psi dt = sum over texels of w Psi_texel,   w = integral of T sigma_s hat
//
// with the hat functions of bilinear interpolation. The target is the light that the solution,
// scattered by each layer's own phase function, sends along that ray. Both integrals use the same
// nodes (view_ray.h), so that the quadrature's error is only that of their difference.
#pragma once

#include <functional>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/sky_ray.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/sun_axis.h"

namespace skybake {

// The scene for which a table is fitted: cameras in the air or in space, and the sun's zenith angle
// at the cameras in radians, up to pi.
struct FitScene {
    double lowest_camera_km = 0;
    double highest_camera_km = 3;
    double smallest_sun_zenith = 0;
    double largest_sun_zenith = 1.7453292519943295;  // 100 degrees
};

// How densely a scene is sampled. A finer sampling changes the sky on Earth by less than 0.1 % of
// its mean; fewer cameras are 1 % worse on small planets, and fewer suns at sunset.
struct FitDensity {
    int cameras = 6;
    int sky_views = 7;     // zenith angles from the horizon up, Gauss's nodes
    int ground_views = 2;  // from the horizon down, where only the air before the ground counts
    int azimuths = 4;
    int suns_per_column = 2;  // of the solution's axis
};

// The rays of one zenith angle at a camera, for all suns and azimuths.
struct FitView {
    int camera = 0;
    double mu = 0;
    double sine = 0;
    bool meets_ground = false;
    double share = 0;  // of the sky's or the ground's solid angle
};

struct FitSample {
    std::vector<double> cameras_km;
    std::vector<SunZenith> suns;
    std::vector<double> azimuth_cosines;
    std::vector<FitView> views;

    std::size_t rays_per_view() const { return suns.size() * azimuth_cosines.size(); }
    // Returns ray `index` of a view, from where it enters the air. The place and the inclination
    // are the same for all rays of a view.
    SkyRay ray(const Shell& shell, const FitView& view, std::size_t index) const;
};

// Samples the scene: cameras are densest at the lowest one; suns are spaced evenly between the
// axis's columns within the scene's range, and lie at its ends; nodes of views are densest at the
// horizon.
FitSample sample_scene(const Shell& shell, const SunAxis& axis, const FitScene& scene,
                       const FitDensity& density);

// The places of a table's texels.
struct FitAxes {
    std::vector<double> sun_cos_zenith_of_columns;  // both ascending
    std::vector<double> altitudes_km_of_rows;
    // Returns the column, which may be fractional, at which a runtime looks up a cosine. Beyond the
    // table it is the table's edge.
    std::function<double(double sun_cos_zenith)> column_of;

    std::size_t width() const { return sun_cos_zenith_of_columns.size(); }
    std::size_t height() const { return altitudes_km_of_rows.size(); }
    std::size_t texels() const { return width() * height(); }
};

// The equations of all rays of a view, in the order of FitSample::ray.
struct ViewEquations {
    std::vector<std::size_t> first_term = {0};
    std::vector<std::size_t> texels;  // of each term, row * width + column
    std::vector<Spectrum> weights;    // of each term
    std::vector<Spectrum> multiple;   // of each ray: the target
    std::vector<Spectrum> single;  // of each ray: light scattered once, roughly at the terminator
};

ViewEquations view_equations(const SkyMedium& medium, const SolvedLight& light,
                             const FitSample& sample, const FitView& view, const FitAxes& axes);

}  // namespace skybake
