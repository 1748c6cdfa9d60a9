// The altitudes at which light is solved for.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"

namespace skybake {

// Returns the altitudes of a solution, ascending from the ground to the top, with every kink of the
// medium among them but for those of smooth tables. They are closest where densities change and where the air is opaque, so that
// light is nearly linear between neighbours. `scale` multiplies their number.
std::vector<double> solution_levels_km(const Medium& medium, double scale);

struct AltitudeRange {
    double bottom_km = 0;
    double top_km = 0;
};

// Returns the ranges between two kinks in which the air begins or ends abruptly and has a zenith
// optical depth of more than `depth`.
std::vector<AltitudeRange> abrupt_layers_km(const Medium& medium, double depth);

// Returns the altitudes between which the solution tabulates sunlight in one block
// (TransmittanceField): each of those kinks, and every third of the levels. Blocks of single levels would
// have three times as many rows and the same light to five digits.
std::vector<double> sunlight_blocks_km(const Medium& medium, const std::vector<double>& levels_km);

// Returns the transmittance from those blocks to the sun, in tables of `size` each.
TransmittanceField tabulated_sunlight(const Medium& medium, const std::vector<double>& levels_km,
                                      TransmittanceField::Size size, int threads);

}  // namespace skybake
