// What a table of the mean radiance has to fulfil so that views of a scene look right.
//
// The light of higher orders along a ray that an isotropic table gives is linear in its texels:
//
//   integral of T sigma_s Psi dt = sum over texels of w Psi_texel,   w = integral of T sigma_s hat
//
// with the hats of bilinear interpolation. It is to be what the solved light, scattered by each
// layer's own phase function, sends along that ray. Both integrals are taken over the same nodes
// (view_ray.h), so that the quadrature's error is that of the difference alone.
#pragma once

#include <functional>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/sky_ray.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/sun_axis.h"

namespace skybake {

// The cameras, suns and view rays of a scene by which a table is fitted.

// Cameras in the air or in space, and the sun's zenith angle there in radians, up to pi.
struct FitScene {
    double lowest_camera_km = 0;
    double highest_camera_km = 3;
    double smallest_sun_zenith = 0;
    double largest_sun_zenith = 1.7453292519943295;  // 100 degrees
};

// How densely a scene is sampled. Finer does not change the sky by 0.1 % of its mean on Earth;
// fewer cameras are 1 % worse on small planets, fewer suns at sunset.
struct FitDensity {
    int cameras = 6;
    int sky_views = 7;     // zenith angles from the horizon up, Gauss' nodes
    int ground_views = 2;  // from the horizon down, where only the air before the ground counts
    int azimuths = 4;
    int suns_per_column = 2;  // of the solution's axis
};

// Rays of one zenith angle at a camera, for all suns and azimuths.
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
    // Where the air begins for a ray of a view: the same place and inclination for all its rays.
    SkyRay ray(const Shell& shell, const FitView& view, std::size_t index) const;
};

// Cameras closest at the lowest; suns evenly between the axis' columns within the scene's range
// and at its ends; nodes of views closest at the horizon.
FitSample sample_scene(const Shell& shell, const SunAxis& axis, const FitScene& scene,
                       const FitDensity& density);

// The places of a table's texels.
struct FitAxes {
    std::vector<double> sun_cos_zenith_of_columns;  // both ascending
    std::vector<double> altitudes_km_of_rows;
    // The column, a fraction between two, where a runtime looks up a cosine; beyond the table its
    // edge is taken.
    std::function<double(double sun_cos_zenith)> column_of;

    std::size_t width() const { return sun_cos_zenith_of_columns.size(); }
    std::size_t height() const { return altitudes_km_of_rows.size(); }
    std::size_t texels() const { return width() * height(); }
};

// The equations of all rays of a view, as FitSample::ray counts them.
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
