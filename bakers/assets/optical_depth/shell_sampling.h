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
#pragma once

#include <vector>

#include "bakers/assets/optical_depth/column_kinds.h"

namespace skybake {

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

}  // namespace skybake
