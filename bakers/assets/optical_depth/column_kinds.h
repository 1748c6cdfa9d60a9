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

}  // namespace skybake
