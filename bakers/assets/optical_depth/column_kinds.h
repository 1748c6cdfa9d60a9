// The kinds of particles of a table of columns: layers of an atmosphere, each with density 1 in
// place of its coefficients, so that one table serves all wavelengths:
//
//   transmittance = exp(-sum over kinds of extinction_per_km * column),
//   column = integral of density ds, in km.
#pragma once

#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/optical_depth/column_mapping.h"
#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/field/baked.h"
#include "config/sections/atmosphere.h"

namespace skybake {

struct ColumnKind {
    std::string name;
    Medium unit;                   // one channel, its extinction is the density in 1/km
    Spectrum extinction_per_km{};  // of density 1
    double mean_height_km = 0;     // exponential: the scale height; else vertical column over the
                                   // greatest density
    config::Layer layer;
};

// In the order of `names`, all of them layers of the atmosphere.
std::vector<ColumnKind> make_column_kinds(const config::Atmosphere& atmosphere,
                                          const std::vector<std::string>& names);

// Their shell, with altitudes as fine as the thinnest kind asks for: fine_km is twice its mean
// height, which gave air, dust and fog the least errors among the multiples tried.
ColumnGeometry column_geometry(const std::vector<ColumnKind>& kinds);

double density_of(const ColumnKind& kind, double altitude_km);

// The column of a path over its length; the density where it has none. Relative error about 1e-14.
double mean_density(const ColumnKind& kind, const ColumnPath& path);

// The same by adaptive quadrature of the definition, within 1e-10 of itself.
double reference_mean_density(const ColumnKind& kind, const ColumnPath& path);

// Columns as sums over shells of the air, one density a shell: what a runtime or an earlier baker
// does in place of quadrature, kept to be compared with it. After Ai et al. 2014, who choose shells
// that dim light from straight above equally.
//
// With the mean scale height H = sum_k sigma_k H_k / sum_k sigma_k over the kinds, sigma_k the mean
// extinction over channels, light from above is dimmed through a shell by exp(-(sum_k sigma_k) H
// (e(h_i) - e(h_i+1))), e(h) = exp(-h / H). It is the same in all N shells up to h_N where e(h_i)
// are equally spaced:
//
//   h_i = -H ln(1 - i / N (1 - exp(-h_N / H))).
//
// Uniform shells have h_i = i h_N / N. Along a ray each shell counts with the density at the middle
// of the ray's way through it; where the ray passes its nearest point, on either side.

// H, in km.
double mean_scale_height_km(const std::vector<ColumnKind>& kinds);

// h_0 = 0 .. h_N = max_altitude, ascending.
std::vector<double> equal_attenuation_shells_km(double mean_scale_height_km, double max_altitude_km,
                                                int count);
std::vector<double> uniform_shells_km(double max_altitude_km, int count);

// The column of a path over its length, the air above the last boundary left out; the density where
// it has none.
double sampled_mean_density(const ColumnKind& kind, const std::vector<double>& shells_km,
                            const ColumnPath& path);

// What a table of columns is worth, in transmittance: of each kind alone, and of all together, with
// the layers' own extinction in each colour channel.

// Of the mean densities of each kind, transmittances of a path in this order: all kinds together in
// each of `channels` colours, then each kind alone.
std::vector<double> transmittances(const std::vector<ColumnKind>& kinds, int channels,
                                   double length_km, const std::vector<double>& mean_densities);

// A stored table as a runtime looks it up.
class StoredColumns {
  public:
    // All must outlive it. `channels` is the count of colours.
    StoredColumns(const std::vector<ColumnKind>& kinds, int channels, const ColumnTable& table,
                  const Level& level, config::PixelType type);

    // As transmittances().
    std::vector<double> transmittances_of(const ColumnPath& path) const;
    std::vector<double> exact_transmittances_of(const ColumnPath& path) const;

  private:
    const std::vector<ColumnKind>& kinds_;
    int channels_;
    const ColumnTable& table_;
    const Level& level_;
    config::PixelType type_;
};

struct ColumnErrors {
    ErrorFigures together;
    std::vector<ErrorFigures> alone;  // of each kind
    // T(a to c) - T(a to b) T(b to c), b on the way. Of tables to the top the first factor is
    // exact.
    ErrorFigures additivity;
    ErrorFigures symmetry;  // T(a to b) - T(b to a): 0 of tables to the top
    int points = 0;
};

// At `points` of the fixed set of places, colours and (the last two) kinds pooled.
ColumnErrors measure_columns(const std::vector<ColumnKind>& kinds, int channels,
                             const ColumnTable& table, bool to_top, const Level& level,
                             config::PixelType type, int points);

}  // namespace skybake
