// The kinds of particles of a table of columns, other ways to compute columns, and the errors of a
// stored table. The kinds are layers of an atmosphere, each with density 1 in place of its
// coefficients, so that one table serves all wavelengths:
//
//   transmittance = exp(-sum over kinds of extinction_per_km * column),
//   column = integral of density ds, in km.
#pragma once

#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/optical_depth/column_mapping.h"
#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/field/conventions.h"
#include "bakers/field/level.h"
#include "config/sections/atmosphere.h"
#include "config/sections/layer.h"
#include "config/sections/pixel_types.h"

namespace skybake {

struct ColumnKind {
    std::string name;
    Medium unit;                   // one channel, its extinction is the density in 1/km
    Spectrum extinction_per_km{};  // of density 1
    double mean_height_km = 0;     // exponential: the scale height; else vertical column over the
                                   // greatest density
    config::Layer layer;
};

// Makes the kinds in the order of `names`, which must all be layers of the atmosphere.
std::vector<ColumnKind> make_column_kinds(const config::Atmosphere& atmosphere,
                                          const std::vector<std::string>& names);

// Returns their shell, with altitudes as fine as the thinnest kind requires: fine_km is twice its
// mean height, which gave air, dust and fog the least errors among the multiples tried.
ColumnGeometry column_geometry(const std::vector<ColumnKind>& kinds);

double density_of(const ColumnKind& kind, double altitude_km);

// Returns the column of a path divided by its length, or the density if the path has no length. The
// relative error is about 1e-14.
double mean_density(const ColumnKind& kind, const ColumnPath& path);

// Returns the same for many paths, in vectors.
std::vector<double> mean_densities(const ColumnKind& kind, const std::vector<ColumnPath>& paths);

// Returns the same by adaptive quadrature of the definition, with a relative error of 1e-10.
double reference_mean_density(const ColumnKind& kind, const ColumnPath& path);

// Columns as sums over shells of the air with one density per shell, as runtimes and an earlier
// baker compute them in place of quadrature. They are kept for comparison. The shells are those of
// Ai et al. 2014, which dim light from straight above equally.
//
// With the mean scale height H = sum_k sigma_k H_k / sum_k sigma_k over the kinds, sigma_k the mean
// extinction over channels, light from above is dimmed through a shell by exp(-(sum_k sigma_k) H
// (e(h_i) - e(h_i+1))), e(h) = exp(-h / H). It is the same in all N shells up to h_N where e(h_i)
// are equally spaced:
//
//   h_i = -H ln(1 - i / N (1 - exp(-h_N / H))).
//
// Uniform shells have h_i = i h_N / N. Along a ray each shell has the density at the middle of the
// ray's path through it; where the ray passes its nearest point, the two sides count separately.

// Returns H in km.
double mean_scale_height_km(const std::vector<ColumnKind>& kinds);

// Returns h_0 = 0 to h_N = max_altitude, ascending.
std::vector<double> equal_attenuation_shells_km(double mean_scale_height_km, double max_altitude_km,
                                                int count);
std::vector<double> uniform_shells_km(double max_altitude_km, int count);

// Returns the column of a path divided by its length, without the air above the last boundary, or
// the density if the path has no length.
double sampled_mean_density(const ColumnKind& kind, const std::vector<double>& shells_km,
                            const ColumnPath& path);

// Returns the transmittances of a path from the mean densities of each kind, in this order: all
// kinds together, with the layers' own extinction in each of `channels` colours, then each kind
// alone.
std::vector<double> transmittances(const std::vector<ColumnKind>& kinds, int channels,
                                   double length_km, const std::vector<double>& mean_densities);

struct ColumnErrors {
    ErrorFigures together;
    std::vector<ErrorFigures> alone;  // of each kind
    // T(a to c) - T(a to b) T(b to c), with b on the path. For tables to the top the first factor
    // is exact.
    ErrorFigures additivity;
    ErrorFigures symmetry;  // T(a to b) - T(b to a): 0 of tables to the top
    int points = 0;
};

// Measures at `points` of the fixed set of places. Colours are pooled, and for the last two figures
// also kinds.
ColumnErrors measure_columns(const std::vector<ColumnKind>& kinds, int channels,
                             const ColumnTable& table, bool to_top, const Level& level,
                             PixelType type, int points);

}  // namespace skybake
