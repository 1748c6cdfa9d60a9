// How the light at a point is kept: its moments over directions.
//
// Directions are taken at the point, z up and the sun's azimuth 0; the light is the same for an
// azimuth and its negative, so cosines suffice. With the real, orthonormal spherical harmonics
//
//   Y_lm(mu, phi) = n_lm P_l^m(mu) cos(m phi)      integral over directions of Y Y' = 1 or 0
//
// the moments are L_lm = integral of L Y_lm, and a phase function with Legendre moments chi_l
// scatters towards a direction
//
//   integral of p L = sum over l of chi_l sum over m of L_lm Y_lm(direction)
//
// exactly if L's or p's moments beyond the degree are 0. L_00 = sqrt(4 pi) times the mean radiance.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/solver/sun_axis.h"
#include "bakers/math/vectors.h"

namespace skybake {

// Moments are stored by rising l, and in it by rising m.
inline int moment_count(int degree) { return (degree + 1) * (degree + 2) / 2; }
inline int moment_index(int l, int m) { return l * (l + 1) / 2 + m; }

// n_lm P_l^m(mu) for a direction with this cosine, by index, without the azimuth's cos(m phi).
// `values` has room for moment_count(degree).
void zenith_harmonics(int degree, double mu, double* values);

// The same over sin^m of the zenith angle: smooth in the vertical.
void harmonics_over_sines(int degree, double mu, double* values);

// n_lm = sqrt((2 - [m = 0]) (2 l + 1) / 4pi (l - m)! / (l + m)!).
double harmonic_norm(int l, int m);

// --- The unknowns --------------------------------------------------------------------------------

// The unknowns of a solution: moments of light at every level for every sun, and the sky's
// irradiance of the ground.

// Values stand in groups of kChannelSlots, one per channel and unused ones 0. Moments of azimuthal
// order m are over sin^m of the sun's zenith angle: so they are smooth in its cosine where the sun
// is at the zenith.
struct LightField {
    int levels = 0;
    int suns = 0;
    int degree = 0;
    // [((level * suns + sun) * moment_count(degree) + lm) * kChannelSlots + channel]
    std::vector<double> moments;
    // [sun * kChannelSlots + channel]
    std::vector<double> sky_irradiance;

    LightField() = default;
    LightField(int level_count, int sun_count, int moment_degree)
        : levels(level_count),
          suns(sun_count),
          degree(moment_degree),
          moments(static_cast<std::size_t>(level_count) * level_size()),
          sky_irradiance(static_cast<std::size_t>(sun_count) * kChannelSlots) {}

    std::size_t sun_size() const {
        return static_cast<std::size_t>(moment_count(degree)) * kChannelSlots;
    }
    std::size_t level_size() const { return static_cast<std::size_t>(suns) * sun_size(); }
    const double* at(int level, int sun) const {
        return moments.data() + static_cast<std::size_t>(level) * level_size() +
               static_cast<std::size_t>(sun) * sun_size();
    }
    double* at(int level, int sun) {
        return moments.data() + static_cast<std::size_t>(level) * level_size() +
               static_cast<std::size_t>(sun) * sun_size();
    }
};

// --- The solution --------------------------------------------------------------------------------

// The light that solve_light.h found, on its grid of altitudes and suns.

// Where an altitude stands between levels.
struct LevelPlace {
    int level;        // the lower of two
    double fraction;  // of the way to the upper one
};

struct SolvedLight {
    int channels = 0;
    std::vector<double> altitudes_km;  // ascending, from the ground to the top
    SunAxis suns;
    // 1 for the stencils (by their first column) in which light falls too fast for cubics.
    std::vector<double> steep;
    LightField light;  // scattered or reflected once and more, for a solar irradiance of 1

    int applications = 0;  // of one more order
    double left_out = 0;   // bound of what further orders would add, as a share of the light

    int degree() const { return light.degree; }
    LevelPlace level_at(double altitude_km) const;
    // Weights of the columns around a sun.
    SunStencil stencil(double sun_cos_zenith) const;
    // Moments between the grid's points: values[lm].
    void moments_at(double altitude_km, double sun_cos_zenith, Spectrum* values) const;
    // L_00 / sqrt(4 pi): what Hillaire's texture stands for.
    Spectrum mean_radiance_at(double altitude_km, double sun_cos_zenith) const;
    // Irradiance of level ground by the sky, without the sun.
    Spectrum sky_irradiance_at(double sun_cos_zenith) const;
};

}  // namespace skybake
