// Parts water into vapour and droplets: saturation adjustment.
#pragma once

#include "bakers/convection/sounding.h"

namespace skybake::convection {

struct AirRow {
    const float* heat = nullptr;
    const float* water = nullptr;
    int count = 0;
};

// Writes the condensed water in g/kg: the root of water - root = saturation at the temperature to which the
// root's latent heat warms the air. Below 0 it is what the air lacks to be saturated.
void condensed(const AirRow& air, const Level& level, float* root);

// Writes the buoyancy in m/s2 of air in which droplets float: g times the virtual potential temperature
// less that of the level's own air, over kReference. `own` is from virtual_heat.
void buoyancies(const AirRow& air, const Level& level, float own, float* out);

// The virtual potential temperature of a level's own air less kReference, as buoyancies computes it.
float virtual_heat(const Level& level);

}  // namespace skybake::convection
