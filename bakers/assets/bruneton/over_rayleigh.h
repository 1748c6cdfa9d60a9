// Light of a grid as a table of scattering holds it.
#pragma once

#include <vector>

#include "bakers/assets/bruneton/parts_memory.h"
#include "bakers/assets/bruneton/scattering_mapping.h"

namespace skybake {

// Light of all texels, u fastest, in 1/sr, over Rayleigh's phase function at their nu: where there
// is none such, at the nearest that there is, as of iterated_scattering.
HigherOrderParts over_rayleigh(const std::vector<Spectrum>& light,
                               const ScatteringMapping& mapping);

}  // namespace skybake
