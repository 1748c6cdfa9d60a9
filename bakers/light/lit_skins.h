// The skins of layers that begin or end abruptly, which a low sun lights: its rays reach centimetres
// into a fog that is a hundred metres deep.
//
// At a depth d below the edge of air with the extinction k sunlight fades as exp(-k d / mu_s), and of a
// sun at the horizontal as exp(-k sqrt(2 r d)). Rays are cut at depths that grow by a constant factor
// from one to the next, so that each piece sees either exponent change by little or hardly any light.
// Tables of sunlight, whose rows are metres apart, are not read there.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/solver/solution_levels.h"

namespace skybake {

struct LitSkins {
    std::vector<double> altitudes_km;   // where rays are cut: quadrature_altitudes_km and the skins
    std::vector<AltitudeRange> layers;  // layers that begin or end abruptly

    bool hold(double altitude_km) const;
};

LitSkins lit_skins(const Medium& medium);

}  // namespace skybake
