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

#include "bakers/air/sky_medium.h"
#include "bakers/assets/multiple_scattering/fit_sample.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

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
