// The solved light: the moments over directions by which the light at a point is stored, the field
// of these moments, and the solution on its grid of altitudes and suns.
//
// Directions are relative to the point, z up and the sun's azimuth 0. The light is the same for an
// azimuth and its negative, so cosines suffice. With the real, orthonormal spherical harmonics
//
//   Y_lm(mu, phi) = n_lm P_l^m(mu) cos(m phi)      integral over directions of Y Y' = 1 or 0
//
// the moments are L_lm = integral of L Y_lm, and a phase function with Legendre moments chi_l
// scatters towards a direction
//
//   integral of p L = sum over l of chi_l sum over m of L_lm Y_lm(direction)
//
// This is exact if, at each degree beyond the stored one, the moments of L or of p are 0. L_00 is
// sqrt(4 pi) times the mean radiance.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/solver/sun_axis.h"
#include "bakers/math/vectors.h"

namespace skybake {

// Moments are stored by ascending l, and for each l by ascending m.
inline int moment_count(int degree) { return (degree + 1) * (degree + 2) / 2; }
inline int moment_index(int l, int m) { return l * (l + 1) / 2 + m; }

// Computes n_lm P_l^m(mu) for a direction with this cosine, by index, without the azimuth's cos(m
// phi). `values` has room for moment_count(degree).
void zenith_harmonics(int degree, double mu, double* values);

// Where the sun is at the zenith, light of azimuthal order m vanishes as the sine of its zenith angle
// to the power m. Moments are kept over this power of the sine: m itself, or, of high orders, the
// power of the same parity next to it. Either way they are smooth functions of the cosine between
// the columns of a sun axis. But a column's errors grow, on their way to a sun with twice its sine,
// by 2 to that power, and what is left out of a high order is far more than sin^m.
inline constexpr int kLargestSinePower = 8;
inline int sine_power(int m) { return m <= kLargestSinePower ? m : kLargestSinePower - m % 2; }

// The powers of a number from 0 to kLargestSinePower.
using SinePowers = std::array<double, kLargestSinePower + 1>;
SinePowers powers_of(double sine);
// Returns one over each of them.
SinePowers inverse_powers_of(double sine);

// Computes zenith_harmonics divided by the sine of the zenith angle to sine_power(m), which is smooth
// at the vertical.
void harmonics_over_sines(int degree, double mu, double* values);

// Returns n_lm = sqrt((2 - [m = 0]) (2 l + 1) / 4pi (l - m)! / (l + m)!).
double harmonic_norm(int l, int m);

// --- The unknowns --------------------------------------------------------------------------------

// The unknowns of a solution: moments of light at every level for every sun, and the sky's
// irradiance of the ground.

// Values are stored in groups of kChannelSlots, one per channel, and unused ones are 0. Moments of
// azimuthal order m are divided by the sine of the sun's zenith angle to sine_power(m).
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

// Copies the moments of the degrees that both fields have, and the sky's irradiance. The fields have
// the same levels and suns.
void copy_moments(const LightField& from, LightField& to);

// Adds light that is symmetric about the sun's direction to the moments of one level for one sun.
// `light` has its Legendre moments by degree: the same for all degrees if it comes from the sun's
// direction alone.
void add_light_about_sun(const std::vector<Spectrum>& light, double sun_cos_zenith,
                         double* moments);

// --- The solution --------------------------------------------------------------------------------

// The place of an altitude between two levels.
struct LevelPlace {
    int level;        // the lower of two
    double fraction;  // of the way to the upper one
};

// Rows of moments, and their weights in a sum.
struct WeightedRows {
    std::array<const double*, 8> rows;
    std::array<double, 8> weights;
    std::size_t count = 0;
};

struct SolvedLight {
    int channels = 0;
    std::vector<double> altitudes_km;  // ascending, from the ground to the top
    SunAxis suns;
    // 1 for each stencil (indexed by its first column) in which light falls too fast for cubics,
    // else 0: there light is interpolated in its logarithm (steep_weights).
    std::vector<double> steep;
    LightField light;  // scattered or reflected once and more, for a solar irradiance of 1

    int applications = 0;  // how often one more order was computed
    double left_out = 0;   // truncation error, as an estimated share of the light at any point

    int degree() const { return light.degree; }
    LevelPlace level_at(double altitude_km) const;
    // Returns the mean radiance under the sun of a column, summed over channels and times
    // sqrt(4 pi).
    double mean_of(const LevelPlace& at, int column) const;
    // Returns the weights of the columns around a sun for light at that place.
    SunStencil stencil(const LevelPlace& at, double sun_cos_zenith) const;
    // Computes the moments between the grid's points: values[lm], or one of them.
    void moments_at(double altitude_km, double sun_cos_zenith, Spectrum* values) const;
    Spectrum moment_at(double altitude_km, double sun_cos_zenith, int l, int m) const;
    // Returns the rows of moments about a place, of which those there are sums.
    WeightedRows rows_at(double altitude_km, double sun_cos_zenith) const;
    // Returns L_00 / sqrt(4 pi), the quantity that Hillaire's texture holds.
    Spectrum mean_radiance_at(double altitude_km, double sun_cos_zenith) const;
    // Returns the irradiance of level ground by the sky, without the sun.
    Spectrum sky_irradiance_at(double sun_cos_zenith) const;
};

}  // namespace skybake
